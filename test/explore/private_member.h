// A look at a private member of an object under test. The state of an object is what its members hold; what it tells
// of itself is less, and two states taken for one would leave sequences unexplored.
//
//   NORD_EXPLORE_MEMBER(phaseOf, drive::Drive, phase_)   ... in a namespace, then: phaseOf(drive).since
//
// An explicit instantiation may name private members (C++17 17.7.2 [temp.explicit] 12), so no class has to know of it.
#pragma once

namespace nord_driver::explore {

template <typename Tag, auto Member>
struct Reveal {
  friend constexpr auto memberOf(Tag /*tag*/) { return Member; }
};

}  // namespace nord_driver::explore

#define NORD_EXPLORE_MEMBER(function, Class, member)              \
  struct function##Tag {                                          \
    friend constexpr auto memberOf(function##Tag);                \
  };                                                              \
  template struct explore::Reveal<function##Tag, &Class::member>; \
  template <typename Object>                                      \
  auto& function(Object& object) {                                \
    return object.*memberOf(function##Tag{});                     \
  }

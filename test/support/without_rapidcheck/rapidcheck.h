// Stands in for rapidcheck where there is none (Debian bullseye, Ubuntu 20.04): as much of it as our property tests
// say, so that they compile. None of them runs, see rapidcheck/gtest.h.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <tuple>
#include <type_traits>
#include <utility>

#define RC_ASSERT(condition) static_cast<void>(condition)
#define RC_CLASSIFY(...) ::rc::ignore(__VA_ARGS__)

namespace rc {

template <typename T>
class Gen {
 public:
  T operator*() const { std::abort(); }
};

template <typename... Ts>
void ignore(const Ts&...) {}

namespace gen {

template <typename T>
Gen<T> arbitrary() {
  return {};
}

template <typename T>
Gen<T> inRange(T, T) {
  return {};
}

template <typename T>
Gen<std::decay_t<T>> just(T&&) {
  return {};
}

template <typename T, typename... Ts>
Gen<T> element(T, Ts...) {
  return {};
}

template <typename Container>
Gen<typename Container::value_type> elementOf(const Container&) {
  return {};
}

template <typename T, typename... Ts>
Gen<T> oneOf(Gen<T>, Ts...) {
  return {};
}

template <typename T>
Gen<T> weightedElement(std::initializer_list<std::pair<std::size_t, T>>) {
  return {};
}

template <typename T>
Gen<T> weightedOneOf(std::initializer_list<std::pair<std::size_t, Gen<T>>>) {
  return {};
}

template <typename Container, typename T>
Gen<Container> container(Gen<T>) {
  return {};
}

template <typename Container, typename T>
Gen<Container> container(std::size_t, Gen<T>) {
  return {};
}

template <typename... Ts>
Gen<std::tuple<Ts...>> tuple(Gen<Ts>...) {
  return {};
}

template <typename T1, typename T2>
Gen<std::pair<T1, T2>> pair(Gen<T1>, Gen<T2>) {
  return {};
}

template <typename T, typename Function>
Gen<std::decay_t<std::invoke_result_t<Function, T>>> map(Gen<T>, Function) {
  return {};
}

struct Member {};

template <typename T, typename Class>
Member set(T Class::*) {
  return {};
}

template <typename T, typename Class, typename U>
Member set(T Class::*, Gen<U>) {
  return {};
}

template <typename T, typename... Members>
Gen<T> build(Members...) {
  return {};
}

}  // namespace gen
}  // namespace rc

// Which values of an inverter were written to its RAM and not to its EEPROM since: reading them back says nothing about
// what the next power-up will bring.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::drive {

/// Remembers 32 values; beyond them it holds every value to be one, which costs a write that was not needed.
class RamOnlyValues {
 public:
  /// `has_no_sets`: the inverter takes it without one, though it is addressed with one.
  void mark(const profile::ParameterRequest& request, bool has_no_sets) noexcept;
  void unmark(const profile::ParameterRequest& request, bool has_no_sets) noexcept;
  bool holds(const profile::ParameterRequest& request) const noexcept;

 private:
  struct Key {
    std::uint16_t number = 0;
    std::uint8_t set = 0;
    std::uint8_t index = 0;
  };
  static Key keyOf(const profile::ParameterRequest& request, bool has_no_sets) noexcept;
  std::size_t find(const Key& key) const noexcept;

  FixedVector<Key, 32> keys_;
  bool overflow_ = false;
};

}  // namespace nord_driver::drive

// What the value of P700 may be beside a fault's number, which is the printed one times ten (102 = 10.2; 0: no fault).
#pragma once

#include <cstdint>

namespace nord_driver::profile {

/// The fault is there, but its number could not be read.
constexpr std::uint16_t kFaultNumberUnknown = 65535;

/// It names a fault.
constexpr bool isFaultNumber(std::uint16_t raw) noexcept {
  return raw != 0 && raw != kFaultNumberUnknown;
}

}  // namespace nord_driver::profile

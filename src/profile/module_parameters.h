// Which parameters are those of a bus module and not of the inverter behind it.
#pragma once

#include <cstdint>

namespace nord_driver::profile {

/// P150 to P199 (BU 2700 7.1), whichever of the inverters behind it is asked.
constexpr bool isOfModule(std::uint16_t number) noexcept {
  return number >= 150 && number <= 199;
}

}  // namespace nord_driver::profile

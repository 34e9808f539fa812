// The parameters the bus cycle itself reads or speaks of, as it needs them at compile time. Everything else known of
// parameters stands in the files of the catalogue, and a test holds these rows against them.
#pragma once

#include <cstdint>

#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

struct CycleParameter {
  std::uint16_t number;
  std::uint8_t series;  ///< one bit per series, 1 << Series
  const char* name;
  double resolution;  ///< value = raw * resolution; 1 where no manual gives one
  bool is_signed;     ///< how a 16 bit value is read: P513 = FFFFh is -0.1 s
  ParameterShape shape;
  std::uint8_t elements;  ///< of an array; 1 otherwise
};

/// The description of a parameter in a series; nullptr: the series has none, or the cycle does not use it.
const CycleParameter* findCycleParameter(std::uint16_t number, Series series) noexcept;

/// The value in the parameter's unit. A word is read signed or unsigned as the parameter is, whatever came in the high
/// word.
double toValue(const CycleParameter& parameter, std::int32_t raw) noexcept;

/// The request that reads one element of the parameter; `set` 1..4 and `index` (1..) are used as the shape needs them.
ParameterRequest readRequest(const CycleParameter& parameter, std::uint8_t set, std::uint8_t index) noexcept;

}  // namespace nord_driver::profile

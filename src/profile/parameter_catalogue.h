// What is known of the inverters' parameters: name, unit, resolution, shape. Only what a manual says; the rest stays
// raw.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::profile {

struct ParameterInfo {
  std::uint16_t number;
  std::uint8_t series;  ///< one bit per series, 1 << Series
  const char* name;
  const char* unit;   ///< "" : none, or not known
  double resolution;  ///< value = raw * resolution; 1 where no manual gives one
  bool is_signed;     ///< how a 16 bit value is read: P513 = FFFFh is -0.1 s
  ParameterShape shape;
  std::uint8_t elements;  ///< of an array; 1 otherwise
  std::int32_t minimum;   ///< raw; the range of 16 bits where no manual gives one
  std::int32_t maximum;   ///< raw
};

/// The description of a parameter in a series; nullptr: not in the catalogue.
const ParameterInfo* findParameter(std::uint16_t number, Series series) noexcept;

/// The value in the parameter's unit. A word is read signed or unsigned as the parameter is, whatever came in the high
/// word.
double toValue(const ParameterInfo& info, std::int32_t raw) noexcept;

/// The raw value nearest to `value`; none when it is no number or beyond the parameter's range.
std::optional<std::int32_t> toRaw(const ParameterInfo& info, double value) noexcept;

/// The request that reads one element of the parameter; `set` 1..4 and `index` (1..) are used as the shape needs them.
ParameterRequest readRequest(const ParameterInfo& info, std::uint8_t set, std::uint8_t index) noexcept;

}  // namespace nord_driver::profile

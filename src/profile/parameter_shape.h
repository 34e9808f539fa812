// What the index of a parameter is built from.
#pragma once

#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::profile {

constexpr bool hasSets(ParameterShape shape) noexcept {
  return shape == ParameterShape::kPerSet || shape == ParameterShape::kArrayPerSet;
}

constexpr bool isArray(ParameterShape shape) noexcept {
  return shape == ParameterShape::kArray || shape == ParameterShape::kArrayPerSet;
}

}  // namespace nord_driver::profile

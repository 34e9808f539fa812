// Why a DeviceNet device refused a parameter access: what it means to the driver, and what people are told.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver {

/// Of the general code of an error response to this request. An instance that is missing where only the parameter set
/// needed one is kNotIndexed: the parameter has no sets.
profile::ParameterReason reasonOfError(std::uint8_t general, const profile::ParameterRequest& request) noexcept;

/// "DeviceNet error 09h, the value of the attribute is invalid".
Sentence errorSentence(std::uint8_t general, std::uint8_t additional) noexcept;

}  // namespace nord_driver

// Why an SDO server aborted a parameter access: what it means to the driver, and what people are told.
#pragma once

#include <cstdint>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver {

/// Of an abort code (BU 0060 p. 62, BU 0260 p. 56) in the answer to this request. A sub-index that is missing where
/// only the parameter set needed one is kNotIndexed: the parameter has no sets.
profile::ParameterReason reasonOfAbort(std::uint32_t abort_code, const profile::ParameterRequest& request) noexcept;

/// "SDO abort 0609 0031h, the value is above the upper limit".
Sentence abortSentence(std::uint32_t abort_code) noexcept;

}  // namespace nord_driver

// Why an inverter refused a parameter access by PCP: what it means to the driver, and what people are told.
#pragma once

#include "interbus/pcp_blocks.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver {

/// A sub-index that is missing where only the parameter set needed one is kNotIndexed: the parameter has no sets.
profile::ParameterReason reasonOfPcp(const interbus::PcpError& error,
                                     const profile::ParameterRequest& request) noexcept;

/// The connection to the device is not there any more (class 1).
inline bool isLost(const interbus::PcpError& error) noexcept {
  return error.error_class == 1;
}

/// "PCP error 6/7 (additional code 0000h), the inverter has no parameter of this number".
Sentence pcpSentence(const interbus::PcpError& error) noexcept;

}  // namespace nord_driver

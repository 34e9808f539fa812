// Why a bus module refused a record of DP-V1: what it means to the driver, and what people are told.
#pragma once

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/profile/parameter_request.h"
#include "profibus/record.h"

namespace nord_driver {

/// Never kNoSuchParameter or kNotSupported: a record that is refused says nothing of the parameter the order in it names.
profile::ParameterReason reasonOf(const profibus::RecordError& error) noexcept;

/// "DP-V1 error B2, invalid slot (80 B2 00)".
Sentence refusalText(const profibus::RecordError& error) noexcept;

}  // namespace nord_driver

// Why a parameter access was refused, as one number for every bus: PKW error numbers below 1000, and from 1000 on what
// CANopen says beyond them.
#pragma once

#include <cstdint>

#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::profile {

/// The meaning of `ParameterResult::error_number`, as a clause.
const char* parameterErrorText(std::uint16_t number) noexcept;

/// The number of an SDO abort code (BU 0060 p. 62, BU 0260 p. 56) in the answer to this request: the PKW number where
/// one means the same. A sub-index that is missing where only the parameter set needed one counts as "no array": that
/// is how PKW says it.
std::uint16_t errorNumberOfAbort(std::uint32_t abort_code, const ParameterRequest& request) noexcept;

}  // namespace nord_driver::profile

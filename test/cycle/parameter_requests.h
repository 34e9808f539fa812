// Requests of parameter accesses, as a service of the node hands them to the cycle.
#pragma once

#include <cstdint>

#include "cycle/request.h"
#include "nord_driver/profile/parameter_request.h"

namespace nord_driver::test {

/// A write of a parameter that every parameter set has, with its set left to the driver.
inline cycle::Request writeRequest(DriveIndex drive, std::uint16_t number, std::int32_t raw,
                                   profile::ParameterAction action = profile::ParameterAction::kWriteRam) {
  cycle::Request request;
  request.kind = cycle::RequestKind::kWriteParameter;
  request.drive = drive;
  request.parameter.number = number;
  request.parameter.shape = profile::ParameterShape::kPerSet;
  request.parameter.action = action;
  request.parameter.raw = raw;
  return request;
}

}  // namespace nord_driver::test

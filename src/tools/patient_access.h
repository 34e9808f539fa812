// An access that is refused for the moment only, asked again.
#pragma once

#include <functional>

#include "tools/drive_parameters.h"

namespace nord_driver::tools {

/// Carries `access` to `drive` out, and again every quarter of a second while its refusal may pass (ParameterAnswer::passing),
/// five times in all. What is refused so to the end comes back as neither a success nor `refused`: nobody knows then what
/// the drive has, as without an answer.
ParameterAnswer askPatiently(DriveParameters& drive, const std::function<ParameterAnswer()>& access);

}  // namespace nord_driver::tools

// The EDS file a drive's settings name: checked against its module, which takes its identity from it where that was left
// open.
#pragma once

#include <vector>

#include "nord_driver/config/settings.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver {

/// For every module of which a drive says `eds`; the lengths of the assemblies are known. What in a file is not as it
/// should be is added to the warnings. Throws ConfigError when a file cannot be read, is none of DeviceNet, or describes
/// another module than is configured.
void applyEds(DevicenetConfig& config, const std::vector<DriveSettings>& drives);

}  // namespace nord_driver

// What stops a drive when this computer dies, from what is configured and what the drive's parameters say.
#pragma once

#include <string>

#include "nord_driver/cycle/device_data.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::node {

/// True when the drive would run on: P513 = -0.1 makes the inverter ignore every bus error (BU 2700 7.1.1, BU
/// 0020 6.2.2).
bool runsOnWithoutUs(const cycle::DeviceData& device);

/// In words, for device_info and diagnostics.
std::string protectionText(const DriveIdentity& identity, const cycle::DeviceData& device);

}  // namespace nord_driver::node

// What a drive's parameters let its motor do beside the commands of this driver.
#pragma once

#include <string>
#include <vector>

#include "cycle/device_data.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::node {

/// One sentence each: P104 > 0, P543 and P546 of another function than the frequency, P480 by which a bus I/O bit can
/// start the motor, and what of these could not be read. Empty before everything has been asked for.
std::vector<std::string> deviceWarnings(const cycle::DeviceData& device, profile::Series series);

}  // namespace nord_driver::node

// A time-out of the bus that acts, but late.
#pragma once

#include <string>
#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/transport/bus_report.h"

namespace nord_driver::node {

/// A sentence for each way in which drives run on for more than 3 s when this computer dies, as far as their transport
/// knows the time. What the inverters' own time-outs do is not known before they are read.
std::vector<std::string> lateProtection(const Settings& bus, const std::vector<DriveIdentity>& identities);

}  // namespace nord_driver::node

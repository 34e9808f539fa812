// The drives of a node as it knows them: ~<drive>/device_info and ~bus_status.
#pragma once

#include <string>

#include "transport/bus_scanner.h"

namespace nord_driver::tools {

/// `node`: with its leading slash. ros::init() comes before it. Throws Trouble when it has no drives, or does not tell.
ScanReport scanNode(const std::string& node);

}  // namespace nord_driver::tools

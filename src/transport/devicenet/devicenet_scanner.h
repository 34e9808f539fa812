// Who is on a DeviceNet bus.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "transport/bus_scanner.h"

namespace nord_driver {

/// After the duplicate-MAC check of this computer allocates the explicit connection of every MAC id, one after the
/// other answers, reads the identity object, and releases it. No process data are allocated, so that no output of a
/// device changes; a device that another scanner owns refuses, and that is told.
ScanReport scanDevicenet(const Settings& bus,
                         const std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>& make_link,
                         const std::atomic<bool>& end_asked);

/// See BusScanner::quiet().
std::string devicenetScanIsQuiet(const Settings& bus);

}  // namespace nord_driver

// The counters a DeviceNet bus shows to users.
#pragma once

#include "devicenet/scanner.h"
#include "link/can/can_link.h"
#include "nord_driver/transport/bus_counters.h"

namespace nord_driver {

/// Those of the scanner, of its devices and of the interface (`line`).
BusCounters devicenetCounters(const devicenet::Scanner& scanner, const link::CanCounters& line) noexcept;

}  // namespace nord_driver

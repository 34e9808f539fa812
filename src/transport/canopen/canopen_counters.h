// The counters a CANopen bus shows to users.
#pragma once

#include "canopen/master.h"
#include "link/can/can_link.h"
#include "nord_driver/transport/bus_counters.h"

namespace nord_driver {

/// Those of the master, of its nodes and of the interface (`line`).
BusCounters canopenCounters(const canopen::Master& master, const link::CanCounters& line) noexcept;

}  // namespace nord_driver

// What a CAN controller counts, as counters of the bus.
#pragma once

#include "link/can/can_link.h"
#include "nord_driver/transport/bus_counters.h"

namespace nord_driver {

void addLineCounters(const link::CanCounters& line, BusCounters& to) noexcept;

}  // namespace nord_driver

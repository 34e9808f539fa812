// The counters a PROFIBUS segment shows to users.
#pragma once

#include <cstdint>

#include "link/serial/byte_link.h"
#include "nord_driver/transport/bus_counters.h"
#include "profibus/counters.h"

namespace nord_driver {

/// Those of the master and of the line, and the parameter answers that matched no order.
BusCounters profibusCounters(const profibus::Counters& master, const link::LineCounters& line,
                             std::uint64_t stale) noexcept;

}  // namespace nord_driver

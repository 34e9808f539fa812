// The counters an InterBus ring behind a gateway shows to users.
#pragma once

#include <cstdint>

#include "link/modbus/register_link.h"
#include "nord_driver/transport/bus_counters.h"

namespace nord_driver {

/// What the transport counts itself.
struct InterbusCounts {
  std::uint64_t cycles = 0;
  std::uint64_t without_inputs = 0;
  std::uint64_t ring_stops = 0;
};

BusCounters interbusCounters(const InterbusCounts& own, const link::LinkCounters& link) noexcept;

}  // namespace nord_driver

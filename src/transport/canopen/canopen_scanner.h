// Who is on a CANopen bus.
#pragma once

#include <functional>
#include <memory>

#include "link/can/can_link.h"
#include "link/can/can_settings.h"
#include "transport/bus_scanner.h"

namespace nord_driver {

/// Reads device type (1000h), identity (1018h) and name (1008h) of every node id by SDO, and of an inverter P707, P742
/// and P743. Reading changes no node's state; no NMT command is sent.
ScanReport scanCanopen(const Settings& bus,
                       const std::function<std::unique_ptr<link::CanLink>(const link::CanSettings&)>& make_link,
                       const std::atomic<bool>& end_asked);

}  // namespace nord_driver

// Which of a CANopen master's events tell of the bus as a whole.
#pragma once

#include "canopen/canopen_event.h"
#include "transport/can/can_bus_events.h"

namespace nord_driver {

/// `node_id`: of the event's node, when it has one. What one drive's own note tells is left out.
void takeEvent(const canopen::CanopenEvent& event, unsigned node_id, CanBusEvents& events) noexcept;

}  // namespace nord_driver

// Which of a DeviceNet scanner's events tell of the bus as a whole.
#pragma once

#include "devicenet/devicenet_event.h"
#include "transport/can/can_bus_events.h"

namespace nord_driver {

/// `mac`: of the event's device, when it has one. What one drive's own note tells is left out.
void takeEvent(const devicenet::DevicenetEvent& event, unsigned mac, CanBusEvents& events) noexcept;

}  // namespace nord_driver

// What tells a DeviceNet transport that somebody else works with the bus.
#pragma once

#include "transport/can/can_listen_first.h"

namespace nord_driver {

/// A frame that only a master of the predefined connection set sends, or that a slave sends to its master only.
bool showsScanner(const CanFrame& frame) noexcept;

extern const ListenRules kDevicenetListening;

}  // namespace nord_driver

// What tells a CANopen transport that somebody else works with the bus.
#pragma once

#include "transport/can/can_listen_first.h"

namespace nord_driver {

/// Everything but what a node says that nobody works with: its boot-up, a heartbeat that does not say operational, an
/// emergency. An answer to guarding (bit 7 is its toggle bit) is none of these: somebody asks.
bool showsCanopenMaster(const CanFrame& frame) noexcept;

extern const ListenRules kCanopenListening;

/// What only a master sends, an answer to guarding, and a status word "operation enabled": all that keeps a program from
/// setting nodes free that somebody has left operational (`bus/set_free`). Their heartbeats and PDOs do not.
bool showsCanopenMasterOrMotion(const CanFrame& frame) noexcept;

extern const ListenRules kCanopenSetFree;

}  // namespace nord_driver

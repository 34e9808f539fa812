// The few requests of rtnetlink a CAN link needs.
#pragma once

#include "link/can/can_interface.h"

namespace nord_driver::link::netlink {

/// See CanSystem.
int readInterface(const char* name, CanInterface& interface) noexcept;
int restart(int index) noexcept;
int openInterfaceMessages() noexcept;
int readInterfaceMessage(int descriptor, CanInterface& interface) noexcept;

}  // namespace nord_driver::link::netlink

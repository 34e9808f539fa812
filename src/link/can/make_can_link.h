// The CAN link an interface name asks for.
#pragma once

#include <memory>

#include "link/can/can_link.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// On an interface of the kernel all are alike; a virtual bus needs one that makes it.
enum class CanRole : std::uint8_t {
  kMember,  ///< joins the virtual bus: the driver, tools
  kOwner,   ///< makes the virtual bus: the simulator
};

/// "can0": SocketCan; "virtual:NAME": VirtualCan or VirtualCanHub. Closed; what is wrong with the settings open() says.
std::unique_ptr<CanLink> makeCanLink(const CanSettings& settings, CanRole role = CanRole::kMember);

}  // namespace nord_driver::link

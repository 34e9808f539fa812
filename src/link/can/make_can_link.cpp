#include "link/can/make_can_link.h"

#include "link/can/socket_can.h"
#include "link/can/virtual_can.h"
#include "link/can/virtual_can_hub.h"

namespace nord_driver::link {

std::unique_ptr<CanLink> makeCanLink(const CanSettings& settings, CanRole role) {
  if (!isVirtualCan(settings.interface)) return std::make_unique<SocketCan>(settings);
  if (role == CanRole::kOwner) return std::make_unique<VirtualCanHub>(settings);
  return std::make_unique<VirtualCan>(settings);
}

}  // namespace nord_driver::link

#include "devicenet/node_status.h"

namespace nord_driver::devicenet {

const char* toText(NodeState state) noexcept {
  switch (state) {
    case NodeState::kAbsent:
      return "absent";
    case NodeState::kConnecting:
      return "connecting";
    case NodeState::kExchanging:
      return "exchanging";
    case NodeState::kLost:
      return "lost";
    case NodeState::kRefused:
      return "refused";
    case NodeState::kReleased:
      return "released";
  }
  return "unknown";
}

}  // namespace nord_driver::devicenet

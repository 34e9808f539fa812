#include "canopen/node_status.h"

namespace nord_driver::canopen {

const char* toText(NodeState state) noexcept {
  switch (state) {
    case NodeState::kAbsent:
      return "absent";
    case NodeState::kBooting:
      return "booting";
    case NodeState::kOperational:
      return "operational";
    case NodeState::kLost:
      return "lost";
    case NodeState::kRefused:
      return "refused";
    case NodeState::kReleased:
      return "released";
  }
  return "unknown";
}

}  // namespace nord_driver::canopen

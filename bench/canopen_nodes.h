// CANopen nodes of a benchmark: SDO reads of what the master asks, and one TPDO of every node for each SYNC.
#pragma once

#include <cstddef>
#include <vector>

#include "can_responder.h"

namespace nord_driver::bench {

class CanopenNodes {
 public:
  /// Nodes 1 to `nodes`.
  explicit CanopenNodes(std::size_t nodes);
  bool operator()(const can_frame& frame, const CanSay& say) const;

 private:
  std::vector<can_frame> transmit_pdos_;
};

}  // namespace nord_driver::bench

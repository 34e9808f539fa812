// The CANopen nodes at the far end of a pair, on a thread of their own: SDO reads of what the master asks, and one TPDO
// of every node for each SYNC.
#pragma once

#include <thread>
#include <vector>

#include "can_ends.h"

namespace nord_driver::bench {

class CanResponder {
 public:
  /// Nodes 1 to `nodes`; `ends` must outlive them.
  CanResponder(CanEnds& ends, std::size_t nodes, unsigned processor);
  ~CanResponder();
  CanResponder(const CanResponder&) = delete;
  CanResponder& operator=(const CanResponder&) = delete;

 private:
  void run();
  bool answer(const can_frame& frame) const;
  bool send(const can_frame& frame) const;
  static void answerSdo(const can_frame& request, can_frame& response);

  CanEnds& ends_;
  std::vector<can_frame> transmit_pdos_;
  std::thread thread_;
};

}  // namespace nord_driver::bench

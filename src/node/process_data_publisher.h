// ~<drive>/process_data: what was exchanged with each drive, every cycle of the bus, while somebody listens.
#pragma once

#include <ros/ros.h>

#include <cstdint>
#include <string>
#include <vector>

#include "nord_driver/ProcessData.h"
#include "trace/process_data_history.h"

namespace nord_driver::node {

/// Reads what the bus cycle leaves for the trace, so that the cycle does nothing more for it. Whoever listens gets each
/// cycle once; the number in the message tells where one was lost on the way.
class ProcessDataPublisher {
 public:
  /// `private_node`: "~". `history` must outlive it, with the drives in the order of `drives`.
  ProcessDataPublisher(ros::NodeHandle& private_node, const std::vector<std::string>& drives,
                       const trace::ProcessDataHistory& history);

  /// The cycles since the last call. To be called more often than once a second: older ones are gone.
  void publish();

 private:
  const trace::ProcessDataHistory& history_;
  std::uint64_t next_ = 0;  // cycle
  ProcessData message_;
  std::vector<ros::Publisher> publishers_;  // one per drive
};

}  // namespace nord_driver::node

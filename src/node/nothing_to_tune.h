// dynamic_reconfigure of a node without a base: nothing can be changed, and whoever asks is told so.
#pragma once

#include <ros/ros.h>

namespace nord_driver::node {

/// Without a server its clients (dynparam, rqt_reconfigure) wait for one for ever. This one has no parameter: dynparam
/// ends with "don't know parameter".
class NothingToTune {
 public:
  explicit NothingToTune(ros::NodeHandle& private_node);

 private:
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer server_;
};

}  // namespace nord_driver::node

// The simulator in ROS: the truth about robot and drives as topics, the referee as a service.
#pragma once

#include <ros/ros.h>

#include <memory>
#include <vector>

#include "sim/running_bus.h"
#include "sim_node/sim_drive_node.h"

namespace nord_driver::sim_node {

/// Publishes ~truth/odom and ~truth/<drive> at 50 Hz; services ~referee and those of each drive.
class SimNode {
 public:
  /// `bus` must outlive the node.
  SimNode(ros::NodeHandle& private_handle, sim::RunningBus& bus);

 private:
  void publish();

  ros::NodeHandle handle_;
  sim::RunningBus& bus_;
  std::vector<std::unique_ptr<SimDriveNode>> drives_;
  ros::Publisher odom_;
  ros::ServiceServer referee_;
  ros::SteadyTimer timer_;
};

}  // namespace nord_driver::sim_node

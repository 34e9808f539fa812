// The topic wheel_joint_controller_state of diff_drive_controller, where control_msgs was there when this was built.
#pragma once

#include <ros/ros.h>

#include "node/wheel_states.h"

namespace nord_driver::node {

class WheelStatePublisher {
 public:
  /// False: this was built without control_msgs, and nothing is advertised.
  static bool isOffered();

  /// `config` has a base.
  WheelStatePublisher(ros::NodeHandle& node, const cycle::CycleConfig& config);
  void publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp);

 private:
  WheelStates states_;
  ros::Publisher publisher_;
};

}  // namespace nord_driver::node

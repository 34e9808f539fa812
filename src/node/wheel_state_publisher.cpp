#include "node/wheel_state_publisher.h"

#ifdef NORD_DRIVER_HAS_CONTROL_MSGS
#include <control_msgs/JointTrajectoryControllerState.h>
#endif

namespace nord_driver::node {

#ifdef NORD_DRIVER_HAS_CONTROL_MSGS

bool WheelStatePublisher::isOffered() {
  return true;
}

WheelStatePublisher::WheelStatePublisher(ros::NodeHandle& node, const cycle::CycleConfig& config)
    : states_(config),
      publisher_(node.advertise<control_msgs::JointTrajectoryControllerState>("wheel_joint_controller_state", 10)) {}

void WheelStatePublisher::publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp) {
  states_.update(snapshot);
  control_msgs::JointTrajectoryControllerState message;
  message.header.stamp = stamp;
  fill(message, states_);
  publisher_.publish(message);
}

#else

bool WheelStatePublisher::isOffered() {
  return false;
}

WheelStatePublisher::WheelStatePublisher(ros::NodeHandle&, const cycle::CycleConfig& config) : states_(config) {}

void WheelStatePublisher::publish(const cycle::CycleSnapshot&, ros::Time) {}

#endif

}  // namespace nord_driver::node

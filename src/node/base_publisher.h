// Odometry, tf, joint states, the limited command and the wheels' states, from snapshots of the bus cycle.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <optional>

#include "cycle/snapshot.h"
#include "node/node_config.h"
#include "node/wheel_state_publisher.h"

namespace nord_driver::node {

/// `odom` and its tf appear once every drive of the base has answered, enabled or not. Joint positions and velocities
/// are always filled: robot_state_publisher ignores joints without a position.
class BasePublisher {
 public:
  BasePublisher(ros::NodeHandle& node, const NodeConfig& config);
  void publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp);

  /// Any thread: whether tf is published, and how often everything is (Hz; 0: not at all).
  void setOdomTf(bool on) { odom_tf_ = on; }
  void setRate(double rate) { rate_ = rate; }
  double rate() const { return rate_; }

 private:
  void publishOdometry(const cycle::BaseSnapshot& base, ros::Time stamp);
  void publishJoints(const cycle::CycleSnapshot& snapshot, ros::Time stamp);

  PublishConfig config_;
  std::vector<std::size_t> jointed_;       // drives that turn a joint
  std::vector<cycle::DriveSetup> setups_;  // of all drives
  nav_msgs::Odometry odometry_;
  sensor_msgs::JointState joints_;
  bool with_effort_ = false;
  ros::Publisher odometry_publisher_;
  ros::Publisher joints_publisher_;
  ros::Publisher command_publisher_;
  std::optional<WheelStatePublisher> wheel_states_;
  std::optional<tf2_ros::TransformBroadcaster> broadcaster_;  // from the first transform on
  std::atomic<bool> odom_tf_;
  ros::Time transform_stamp_;
  std::atomic<double> rate_;
};

}  // namespace nord_driver::node

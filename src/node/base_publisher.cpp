#include "node/base_publisher.h"

#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>

#include <cmath>

#include "cycle/measured_values.h"

namespace nord_driver::node {

namespace {

geometry_msgs::Quaternion yawQuaternion(double yaw) {
  geometry_msgs::Quaternion quaternion;
  quaternion.z = std::sin(yaw / 2.0);
  quaternion.w = std::cos(yaw / 2.0);
  return quaternion;
}

}  // namespace

BasePublisher::BasePublisher(ros::NodeHandle& node, const NodeConfig& config)
    : config_(config.publish),
      setups_(config.cycle.drives),
      odom_tf_(config.publish.enable_odom_tf),
      rate_(config.publish.publish_rate) {
  for (std::size_t i = 0; i < config.cycle.drives.size(); ++i) {
    if (config.cycle.drives[i].joint.empty()) continue;
    jointed_.push_back(i);
    with_effort_ = with_effort_ || config.cycle.drives[i].words.torque_at_limit.has_value();
  }
  if (!jointed_.empty()) joints_publisher_ = node.advertise<sensor_msgs::JointState>("joint_states", 10);
  if (!config.cycle.base) return;

  odometry_.header.frame_id = config_.odom_frame_id;
  odometry_.child_frame_id = config_.base_frame_id;
  for (std::size_t i = 0; i < 6; ++i) {
    odometry_.pose.covariance[i * 7] = config_.pose_covariance_diagonal[i];
    odometry_.twist.covariance[i * 7] = config_.twist_covariance_diagonal[i];
  }
  odometry_publisher_ = node.advertise<nav_msgs::Odometry>("odom", 10);
  if (config_.publish_cmd) command_publisher_ = node.advertise<geometry_msgs::TwistStamped>("cmd_vel_out", 10);
  if (config_.publish_wheel_states) wheel_states_.emplace(node, config.cycle);
  if (odom_tf_) broadcaster_.emplace();
}

void BasePublisher::publish(const cycle::CycleSnapshot& snapshot, ros::Time stamp) {
  if (!jointed_.empty()) publishJoints(snapshot, stamp);
  if (odometry_publisher_ && snapshot.base.known) publishOdometry(snapshot.base, stamp);
  if (wheel_states_) wheel_states_->publish(snapshot, stamp);
  if (command_publisher_) {
    geometry_msgs::TwistStamped command;
    command.header.stamp = stamp;
    command.header.frame_id = config_.base_frame_id;
    command.twist.linear.x = snapshot.base.command.linear_x;
    command.twist.linear.y = snapshot.base.command.linear_y;
    command.twist.angular.z = snapshot.base.command.angular_z;
    command_publisher_.publish(command);
  }
}

void BasePublisher::publishOdometry(const cycle::BaseSnapshot& base, ros::Time stamp) {
  odometry_.header.stamp = stamp;
  odometry_.pose.pose.position.x = base.pose.x;
  odometry_.pose.pose.position.y = base.pose.y;
  odometry_.pose.pose.orientation = yawQuaternion(base.pose.heading);
  odometry_.twist.twist.linear.x = base.velocity.linear_x;
  odometry_.twist.twist.linear.y = base.velocity.linear_y;
  odometry_.twist.twist.angular.z = base.velocity.angular_z;
  odometry_publisher_.publish(odometry_);
  if (!odom_tf_ || stamp == transform_stamp_) return;  // tf warns of a transform that comes twice
  transform_stamp_ = stamp;
  if (!broadcaster_) broadcaster_.emplace();
  geometry_msgs::TransformStamped transform;
  transform.header = odometry_.header;
  transform.child_frame_id = odometry_.child_frame_id;
  transform.transform.translation.x = base.pose.x;
  transform.transform.translation.y = base.pose.y;
  transform.transform.rotation = odometry_.pose.pose.orientation;
  broadcaster_->sendTransform(transform);
}

void BasePublisher::publishJoints(const cycle::CycleSnapshot& snapshot, ros::Time stamp) {
  joints_.header.stamp = stamp;
  joints_.name.clear();
  joints_.position.clear();
  joints_.velocity.clear();
  joints_.effort.clear();
  for (const std::size_t i : jointed_) {
    const cycle::DriveSnapshot& drive = snapshot.drives[i];
    // One that positions is somewhere, and not at 0, before anybody has heard where.
    if (!drive.joint_known) continue;
    joints_.name.push_back(setups_[i].joint);
    joints_.position.push_back(drive.joint_position);
    joints_.velocity.push_back(drive.velocity);
    if (with_effort_) joints_.effort.push_back(cycle::effortOf(drive, drive.device, setups_[i]));
  }
  if (!joints_.name.empty()) joints_publisher_.publish(joints_);
}

}  // namespace nord_driver::node

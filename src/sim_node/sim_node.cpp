#include "sim_node/sim_node.h"

#include <nav_msgs/Odometry.h>
#include <std_srvs/Trigger.h>

#include <boost/function.hpp>
#include <cmath>

#include "sim/rule_counts.h"

namespace nord_driver::sim_node {

namespace {

constexpr double kTruthPeriod = 0.02;  // s

nav_msgs::Odometry toOdometry(const sim::Body& body, const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.position.x = body.pose().x;
  message.pose.pose.position.y = body.pose().y;
  message.pose.pose.orientation.z = std::sin(0.5 * body.pose().theta);
  message.pose.pose.orientation.w = std::cos(0.5 * body.pose().theta);
  message.twist.twist.linear.x = body.linear();
  message.twist.twist.linear.y = body.lateral();
  message.twist.twist.angular.z = body.angular();
  return message;
}

}  // namespace

SimNode::SimNode(ros::NodeHandle& private_handle, sim::RunningBus& bus) : handle_(private_handle), bus_(bus) {
  const sim::SimConfig config = bus_.withModel([](sim::RobotSim& robot) { return robot.config(); });
  if (config.body) odom_ = handle_.advertise<nav_msgs::Odometry>("truth/odom", 10);
  for (std::size_t i = 0; i < config.drives.size(); ++i) {
    drives_.push_back(std::make_unique<SimDriveNode>(handle_, bus_, i, config.drives[i].name));
  }
  const boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)> referee =
      [this](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
        response.message = bus_.refereeReport();
        response.success = response.message == sim::kNoRuleBroken;
        return true;
      };
  referee_ = handle_.advertiseService("referee", referee);
  timer_ =
      handle_.createSteadyTimer(ros::WallDuration(kTruthPeriod), [this](const ros::SteadyTimerEvent&) { publish(); });
}

void SimNode::publish() {
  // Copied while the models stand still, sent afterwards: the bus does not wait for ROS.
  std::vector<SimDrive> truths;
  truths.reserve(drives_.size());
  nav_msgs::Odometry odometry;
  const ros::Time stamp = ros::Time::now();
  bus_.withModel([&](sim::RobotSim& robot) {
    for (const auto& drive : robot.drives()) truths.push_back(SimDriveNode::truthOf(*drive));
    if (robot.body() != nullptr) odometry = toOdometry(*robot.body(), stamp);
  });
  for (std::size_t i = 0; i < truths.size(); ++i) {
    truths[i].header.stamp = stamp;
    drives_[i]->publish(truths[i]);
  }
  if (odom_) odom_.publish(odometry);
}

}  // namespace nord_driver::sim_node

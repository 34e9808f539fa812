// Every file of config/templates with simulate.launch: enabled, all its drives run, and what they carry moves.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/package.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nord_driver/DriveStatus.h"
#include "nord_driver/SimDrive.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

constexpr double kLinear = 0.2;  // m/s, of a base
constexpr double kJoint = 2.0;   // rad/s, of a drive without one
constexpr double kFar = 2.4;     // m, a target above the lift
constexpr double kReached = 0.9;

/// The robot of one template, in the namespace of the template's name.
class Machine {
 public:
  explicit Machine(const std::string& name) : name_(name), node_("/" + name) {
    XmlRpc::XmlRpcValue drives;
    node_.getParam("nord_driver/drives", drives);
    has_base_ = node_.hasParam("nord_driver/left_wheel") || node_.hasParam("nord_driver/steered");
    if (has_base_) {
      cmd_vel_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
      truth_ = std::make_unique<Topic<nav_msgs::Odometry>>(node_, "nord_sim/truth/odom");
    }
    for (auto& drive : drives) {
      const bool positions = drive.second.hasMember("mode") && drive.second["mode"] == "position";
      drives_.push_back(std::make_unique<Drive>(node_, drive.first, positions));
    }
    timer_ = node_.createSteadyTimer(ros::WallDuration(0.05), [this](const ros::SteadyTimerEvent&) { publish(); });
  }

  const std::string& name() const { return name_; }
  std::size_t size() const { return drives_.size(); }
  Answer enable(bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    return callService("/" + name_ + "/nord_driver/enable", service);
  }
  Answer acknowledge() {
    std_srvs::Trigger service;
    return callService("/" + name_ + "/nord_driver/acknowledge_faults", service);
  }
  Answer referee() {
    std_srvs::Trigger service;
    return callService("/" + name_ + "/nord_sim/referee", service);
  }
  bool runs() {
    for (const auto& drive : drives_) {
      if (!drive->status.waitNext([](const DriveStatus& s) { return s.state == DriveStatus::OPERATION_ENABLED; })) {
        return false;
      }
    }
    return true;
  }
  void command(bool moving) {
    const std::lock_guard<std::mutex> lock(mutex_);
    moving_ = moving;
  }
  /// The body, or without one each joint, as the simulator knows it and not as the driver tells it.
  bool moves() {
    if (has_base_) {
      return truth_->waitNext([](const nav_msgs::Odometry& body) {
        return body.twist.twist.linear.x > kReached * kLinear;
      }) != nullptr;
    }
    for (const auto& drive : drives_) {
      if (!drive->truth.waitNext([](const SimDrive& is) { return is.wheel_velocity > kReached * kJoint; }))
        return false;
    }
    return true;
  }

 private:
  struct Drive {
    Drive(ros::NodeHandle& node, const std::string& name, bool positions)
        : status(node, "nord_driver/" + name + "/status"),
          truth(node, "nord_sim/truth/" + name),
          goes_to_positions(positions),
          command(node.advertise<std_msgs::Float64>(
              "nord_driver/" + name + (positions ? "/position_command" : "/command"), 1)) {}
    Topic<DriveStatus> status;
    Topic<SimDrive> truth;
    bool goes_to_positions;
    ros::Publisher command;
  };

  void publish() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!moving_) return;
    if (has_base_) {
      geometry_msgs::Twist twist;
      twist.linear.x = kLinear;
      cmd_vel_.publish(twist);
      return;
    }
    std_msgs::Float64 velocity;
    velocity.data = kJoint;
    std_msgs::Float64 target;
    target.data = kFar;
    for (const auto& drive : drives_) drive->command.publish(drive->goes_to_positions ? target : velocity);
  }

  std::string name_;
  ros::NodeHandle node_;
  bool has_base_ = false;
  ros::Publisher cmd_vel_;
  std::unique_ptr<Topic<nav_msgs::Odometry>> truth_;
  std::vector<std::unique_ptr<Drive>> drives_;
  std::mutex mutex_;
  bool moving_ = false;
  ros::SteadyTimer timer_;
};

std::vector<std::string> templates() {
  std::vector<std::string> names;
  for (const auto& file :
       std::filesystem::directory_iterator(ros::package::getPath("nord_driver") + "/config/templates")) {
    names.push_back(file.path().stem());
  }
  return names;
}

using Machines = std::vector<std::unique_ptr<Machine>>;

/// Empty, or the machine that does not come to drive, and how far it came.
std::string tryToDrive(const Machines& machines) {
  for (const auto& machine : machines) {
    Answer answer;
    if (!eventually([&] { return (answer = machine->enable(true)).success; })) {
      return machine->name() + ": " + answer.message;
    }
    if (!machine->runs()) return machine->name() + " does not run";
  }
  for (const auto& machine : machines) machine->command(true);
  for (const auto& machine : machines) {
    if (!machine->moves()) return machine->name() + " does not move";
  }
  return "";
}

// Side by side: what takes time, ramps and start-ups, takes it once.
TEST(Templates, EachDrivesInTheSimulator) {
  constexpr Seconds kLongEnoughToLoseADrive{0.5};  // half of drive_timeout in template.launch
  Machines machines;
  for (const std::string& name : templates()) machines.push_back(std::make_unique<Machine>(name));
  ASSERT_GE(machines.size(), 11u);
  for (const auto& machine : machines) {
    EXPECT_GE(machine->size(), 1u) << "rostest_templates.test does not start " << machine->name();
  }
  std::string missing;
  const auto rest = [&] {
    for (const auto& machine : machines) machine->command(false);
    for (const auto& machine : machines) {
      Answer answer;
      ASSERT_TRUE(eventually([&] { return (answer = machine->acknowledge()).success; })) << answer;
    }
  };
  tryAgainOnlyIfStoodStill(
      kLongEnoughToLoseADrive, [&] { missing = tryToDrive(machines); }, [&] { return missing.empty(); }, rest);
  EXPECT_EQ("", missing);
  for (const auto& machine : machines) machine->command(false);
  for (const auto& machine : machines) {
    SCOPED_TRACE(machine->name());
    const Answer disabled = machine->enable(false), referee = machine->referee();
    EXPECT_TRUE(disabled.success) << disabled;
    EXPECT_TRUE(referee.success) << referee;
  }
}

}  // namespace
}  // namespace nord_driver::test

// A base with two steered axles as its user meets it: it drives a circle and comes back, goes sideways, and stops as a
// whole.
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "nord_driver/DriveStatus.h"
#include "nord_driver/SimTrip.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;
constexpr double kBack = 0.02;  // m
constexpr double kSpeed = 0.35, kRadius = 1.0;
constexpr std::array<const char*, 4> kDrives{"front", "rear", "front_steering", "rear_steering"};
constexpr Seconds kLongEnoughToLoseADrive{0.5};  // half of drive_timeout

double headingOf(const nav_msgs::Odometry& odometry) {
  return 2.0 * std::atan2(odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w);
}

double distance(const nav_msgs::Odometry& one, const nav_msgs::Odometry& other) {
  return std::hypot(one.pose.pose.position.x - other.pose.pose.position.x,
                    one.pose.pose.position.y - other.pose.pose.position.y);
}

class Robot {
 public:
  Robot()
      : odom(node_, "odom"),
        truth(node_, "nord_sim/truth/odom"),
        joints(node_, "joint_states"),
        publisher_(node_.advertise<geometry_msgs::Twist>("cmd_vel", 1)) {
    for (const char* drive : kDrives) {
      status[drive] = std::make_unique<Topic<DriveStatus>>(node_, std::string("nord_driver/") + drive + "/status");
    }
    timer_ = node_.createSteadyTimer(ros::WallDuration(0.02), [this](const ros::SteadyTimerEvent&) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (commands_) publisher_.publish(command_);
    });
  }

  Answer enable(bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    return callService("/nord_driver/enable", service);
  }
  Answer acknowledge() { return trigger("/nord_driver/acknowledge_faults"); }
  Answer referee() { return trigger("/nord_sim/referee"); }
  void drive(double forward, double turning, double left) {
    const std::lock_guard<std::mutex> lock(mutex_);
    command_.linear.x = forward;
    command_.angular.z = turning;
    command_.linear.y = left;
    commands_ = true;
  }
  bool allAre(std::uint8_t state) {
    return std::all_of(kDrives.begin(), kDrives.end(), [&](const char* drive) {
      return status[drive]->waitNext([&](const DriveStatus& s) { return s.state == state; }) != nullptr;
    });
  }
  bool stands() {
    return std::all_of(kDrives.begin(), kDrives.end(), [&](const char* drive) {
      return status[drive]->waitNext([](const DriveStatus& s) { return std::fabs(s.frequency) < 0.05; }) != nullptr;
    });
  }

 private:
  Answer trigger(const std::string& name) {
    std_srvs::Trigger service;
    return callService(name, service);
  }

  ros::NodeHandle node_;

 public:
  Topic<nav_msgs::Odometry> odom, truth;
  Topic<sensor_msgs::JointState> joints;
  std::map<std::string, std::unique_ptr<Topic<DriveStatus>>> status;

 private:
  ros::Publisher publisher_;
  std::mutex mutex_;
  geometry_msgs::Twist command_;
  bool commands_ = false;
  ros::SteadyTimer timer_;
};

class Steered : public ::testing::Test {
 protected:
  static Robot& robot() {
    static Robot robot;
    return robot;
  }
  void SetUp() override {
    robot().drive(0.0, 0.0, 0.0);
    enableAtRest();
  }
  void TearDown() override {
    robot().drive(0.0, 0.0, 0.0);
    EXPECT_TRUE(robot().stands());
    robot().enable(false);
    const Answer referee = robot().referee();
    EXPECT_TRUE(referee.success) << referee;
  }
  void enableAtRest() {
    Answer answer;
    ASSERT_TRUE(eventually([&] {
      robot().acknowledge();
      return (answer = robot().enable(true)).success;
    })) << answer;
    ASSERT_TRUE(robot().allAre(DriveStatus::OPERATION_ENABLED));
  }
  /// By odometry; false: the base was stopped on its way.
  bool driveCircle() {
    double turned = 0.0, last = headingOf(*robot().odom.next());
    while (turned < 2.0 * kPi - 0.003) {
      const auto odometry = robot().odom.next();
      if (!odometry) return false;
      const double heading = headingOf(*odometry);
      turned += std::remainder(heading - last, 2.0 * kPi);
      last = heading;
      const double part = std::max(0.05, std::min(1.0, 1.5 * (2.0 * kPi - turned)));
      robot().drive(part * kSpeed, part * kSpeed / kRadius, 0.0);
      if (robot().status["front"]->next()->state != DriveStatus::OPERATION_ENABLED) return false;
    }
    robot().drive(0.0, 0.0, 0.0);
    return robot().stands();
  }
};

// By odometry it turns once about; the truth is back within 2 cm of where it began, and of what odometry says.
TEST_F(Steered, ComesBackFromACircle) {
  boost::shared_ptr<const nav_msgs::Odometry> from, told_from;
  bool closed = false;
  tryAgainOnlyIfStoodStill(
      kLongEnoughToLoseADrive,
      [&] {
        from = robot().truth.next();
        told_from = robot().odom.next();
        closed = driveCircle();
      },
      [&] { return closed; }, [&] { enableAtRest(); });
  ASSERT_TRUE(closed);
  const auto there = robot().truth.next();
  const auto told = robot().odom.next();
  EXPECT_LT(distance(*from, *there), kBack);
  const double moved = distance(*told_from, *told);
  EXPECT_LT(std::fabs(moved - distance(*from, *there)), kBack);
  RecordProperty("off_mm", static_cast<int>(1000.0 * distance(*from, *there)));
  std::printf("the truth is %.1f mm from the start, odometry %.1f mm\n", 1000.0 * distance(*from, *there),
              1000.0 * moved);
}

// To the left: the wheels by a quarter of a turn, told as they are in joint_states.
TEST_F(Steered, GoesSideways) {
  robot().drive(0.0, 0.0, 0.2);
  EXPECT_TRUE(robot().truth.waitNext([](const nav_msgs::Odometry& is) { return is.twist.twist.linear.y > 0.19; }));
  const auto state = robot().joints.next();
  ASSERT_TRUE(state);
  for (const std::string name : {"front_steering_joint", "rear_steering_joint"}) {
    const auto at = std::find(state->name.begin(), state->name.end(), name);
    ASSERT_NE(state->name.end(), at) << name;
    EXPECT_NEAR(kPi / 2.0, std::fabs(state->position[static_cast<std::size_t>(at - state->name.begin())]), 0.05);
  }
}

// A fault at a steering axis: no drive of the base goes on.
TEST_F(Steered, AFaultAtASteeringAxisStopsAllOfIt) {
  robot().drive(0.3, 0.2, 0.0);
  ASSERT_TRUE(robot().truth.waitNext([](const nav_msgs::Odometry& is) { return is.twist.twist.linear.x > 0.28; }));
  SimTrip trip;
  trip.request.number = 30;
  trip.request.cause_stays = false;
  ASSERT_TRUE(callService("/nord_sim/rear_steering/trip", trip).success);
  for (const char* drive : kDrives) {
    EXPECT_TRUE(robot().status[drive]->waitNext([](const DriveStatus& s) {
      return s.state != DriveStatus::OPERATION_ENABLED;
    })) << drive;
  }
  EXPECT_TRUE(robot().truth.waitNext([](const nav_msgs::Odometry& is) {
    return std::hypot(is.twist.twist.linear.x, is.twist.twist.linear.y) < 0.001;
  }));
}

}  // namespace
}  // namespace nord_driver::test

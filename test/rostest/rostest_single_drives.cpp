// Drives that belong to no base: each with its own command, its own enable and its own stop.
#include <dynamic_reconfigure/ConfigDescription.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kVelocity = 3.0;   // rad/s
constexpr double kLeftLimit = 4.0;  // rad/s
const std::string kRosHome = ::testing::TempDir() + "ros_home_" + std::to_string(::getpid());

bool isIdle(const DriveStatus& status) {
  return status.control_word == 0x047E;
}

class SingleDrives : public RobotTest {
 protected:
  SingleDrives()
      : left_command_(node_.advertise<std_msgs::Float64>("/nord_driver/left/command", 1)),
        right_command_(node_.advertise<std_msgs::Float64>("/nord_driver/right/command", 1)) {
    timer_ = node_.createSteadyTimer(ros::WallDuration(0.02), [this](const ros::SteadyTimerEvent&) { publish(); });
  }
  /// The same robot, but for the driver two drives that know nothing of each other.
  static void SetUpTestSuite() {
    for (const char* key : {"left_wheel", "right_wheel"}) ros::param::del(std::string("/nord_driver/") + key);
    ros::param::set("/nord_driver/drives/left/max_velocity", kLeftLimit);
    ros::param::set("/nord_driver/drives/left/max_acceleration", 20.0);
    ASSERT_EQ(0, ::setenv("ROS_HOME", kRosHome.c_str(), 1));
    shared_driver = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
  }
  static void TearDownTestSuite() {
    shared_driver->signal(SIGTERM);
    EXPECT_TRUE(shared_driver->waitEnd(kPatience));
    shared_driver.reset();
  }
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(eventually([] { return enable("left", true).success; }));
    ASSERT_TRUE(eventually([] { return enable("right", true).success; }));
  }
  void TearDown() override {
    timer_.stop();
    enable("left", false);
    enable("right", false);
    EXPECT_TRUE(robot().waitForRest());
    RobotTest::TearDown();
  }
  static Answer enable(const std::string& drive, bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    return callService("nord_driver/" + drive + "/enable", service);
  }
  /// From now on 50 times a second; nothing: no more commands.
  void command(std::optional<double> left, std::optional<double> right) {
    const std::lock_guard<std::mutex> lock(mutex_);
    left_ = left;
    right_ = right;
  }
  /// When those that are not nothing went out last.
  ros::Time lastCommand() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_command_;
  }
  static bool turns(DriveTopics& drive, double velocity) {
    return drive.status.waitNext([velocity](const DriveStatus& status) {
      return std::fabs(status.velocity_command - velocity) < 0.01 && std::fabs(status.velocity - velocity) < 0.05;
    }) != nullptr;
  }

  static std::unique_ptr<NodeProcess> shared_driver;

 private:
  void publish() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std_msgs::Float64 message;
    last_command_ = ros::Time::now();
    if (left_) {
      message.data = *left_;
      left_command_.publish(message);
    }
    if (right_) {
      message.data = *right_;
      right_command_.publish(message);
    }
  }

  ros::NodeHandle node_;
  ros::Publisher left_command_, right_command_;
  ros::SteadyTimer timer_;
  std::mutex mutex_;
  std::optional<double> left_, right_;
  ros::Time last_command_;
};
std::unique_ptr<NodeProcess> SingleDrives::shared_driver;

TEST_F(SingleDrives, FollowTheirOwnCommandsAndTimeThemOut) {
  command(kVelocity, -kVelocity);
  EXPECT_TRUE(turns(robot().left, kVelocity));
  EXPECT_TRUE(turns(robot().right, -kVelocity));
  command(std::nullopt, -kVelocity);
  EXPECT_TRUE(turns(robot().left, 0.0)) << "its command is too old";
  const auto left = robot().left.status.next();
  EXPECT_EQ(left->control_word, 0x047F) << "the time-out leaves it enabled";
  EXPECT_NEAR(robot().right.status.next()->velocity_command, -kVelocity, 0.01) << "the other one has its own";
  EXPECT_EQ(robot().odom.mark(), 0u) << "there is no base";
}

TEST_F(SingleDrives, StopOneByOneAndAllTogether) {
  command(kVelocity, kVelocity);
  ASSERT_TRUE(turns(robot().left, kVelocity));
  ASSERT_TRUE(turns(robot().right, kVelocity));
  Answer answer = robot().trigger("left/quick_stop");
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_TRUE(robot().left.status.waitNext(isIdle));
  EXPECT_TRUE(turns(robot().right, kVelocity)) << "the other one turns on";
  answer = askUnderCommand([this] { return lastCommand(); }, [] { return enable("left", true); },
                           [] { enable("left", false); });
  EXPECT_FALSE(answer.success) << "under a command that moves";
  EXPECT_THAT(answer.message, HasSubstr("is not zero"));
  answer = robot().trigger("quick_stop");
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_TRUE(robot().right.status.waitNext(isIdle));
}

TEST_F(SingleDrives, AFaultOfOneLeavesTheOtherAlone) {
  command(kVelocity, kVelocity);
  ASSERT_TRUE(turns(robot().right, kVelocity));
  ASSERT_TRUE(robot().trip("left", 21, false).success);
  ASSERT_TRUE(robot().left.status.waitNext(isIdle));
  EXPECT_TRUE(turns(robot().right, kVelocity));
  EXPECT_NE(robot().waitForDiagnostics(
                "drive left",
                [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; }),
            "");
  ASSERT_TRUE(robot().trigger("left/acknowledge_fault").success);
  const std::size_t from = robot().left.status.mark();
  ASSERT_TRUE(eventually([&] { return robot().left.status.mark() >= from + 25; }));
  for (const auto& status : robot().left.status.since(from)) EXPECT_EQ(status->control_word, 0x047E);
}

TEST_F(SingleDrives, EachHasItsOwnLimits) {
  command(2.0 * kLeftLimit, 1.5 * kLeftLimit);
  EXPECT_TRUE(turns(robot().right, 1.5 * kLeftLimit)) << "it has none";
  EXPECT_TRUE(turns(robot().left, kLeftLimit));
}

// No command at all: the one before counts until it is too old.
TEST_F(SingleDrives, WhatIsNoNumberIsIgnored) {
  command(kVelocity, 0.0);
  ASSERT_TRUE(turns(robot().left, kVelocity));
  const std::size_t from = robot().left.status.mark();
  command(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(turns(robot().left, 0.0));
  for (const auto& status : robot().left.status.since(from)) {
    EXPECT_GE(status->velocity_command, 0.0);
    EXPECT_LE(status->velocity_command, kVelocity + 0.01);
  }
  EXPECT_EQ(robot().right.status.next()->velocity_command, 0.0);
}

// Who asks by hand gets a trace, though none is configured.
TEST_F(SingleDrives, ATraceAskedForByHandIsWrittenToTheHomeOfRos) {
  const Answer answer = robot().trigger("write_trace");
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_THAT(answer.message, StartsWith(kRosHome + "/nord_driver_"));
  EXPECT_TRUE(std::filesystem::exists(answer.message));
  std::filesystem::remove_all(kRosHome);
}

// A client of dynamic_reconfigure finds a server that knows no parameter, instead of waiting for one for ever.
TEST_F(SingleDrives, WithoutABaseThereIsNothingToTune) {
  ros::NodeHandle node;
  Topic<dynamic_reconfigure::ConfigDescription> description(node, "/nord_driver/parameter_descriptions");
  const auto told = description.waitFrom(0, [](const auto&) { return true; });
  ASSERT_TRUE(told);
  ASSERT_EQ(told->groups.size(), 1u);
  EXPECT_TRUE(told->groups[0].parameters.empty());
  EXPECT_TRUE(ros::service::exists("/nord_driver/set_parameters", false));
}

}  // namespace
}  // namespace nord_driver::test

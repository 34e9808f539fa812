// From power-on to a base that drives: what a user finds before, while and after it is enabled.
#include <gmock/gmock.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>

#include "nord_driver/DeviceInfo.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class StartUp : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  /// From rest forward until odometry says `way`, and no more commands: x of odometry and truth, y of the truth, in m.
  void driveAndStop(double way, double& seen, double& is, double& aside) {
    const auto told = robot().odom.next(), truth = robot().true_odom.next();
    ASSERT_TRUE(told && truth);
    const geometry_msgs::Point from = told->pose.pose.position, true_from = truth->pose.pose.position;
    robot().drive(0.3);
    ASSERT_TRUE(robot().odom.waitNext(
        [&](const nav_msgs::Odometry& odometry) { return odometry.pose.pose.position.x - from.x > way; }));
    robot().silence();
    ASSERT_TRUE(robot().waitForStandstill());
    const auto told_end = robot().odom.waitNext(
        [](const nav_msgs::Odometry& odometry) { return std::fabs(odometry.twist.twist.linear.x) < 1e-3; });
    const auto true_end = robot().true_odom.next();
    ASSERT_TRUE(told_end && true_end);
    seen = told_end->pose.pose.position.x - from.x;
    is = true_end->pose.pose.position.x - true_from.x;
    aside = true_end->pose.pose.position.y - true_from.y;
  }
};

// Everything is there before anything is enabled.
TEST_F(StartUp, EveryTopicAndServiceIsAdvertised) {
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  std::map<std::string, std::string> types;
  for (const auto& topic : topics) types[topic.name] = topic.datatype;
  EXPECT_EQ(types["/odom"], "nav_msgs/Odometry");
  EXPECT_EQ(types["/tf"], "tf2_msgs/TFMessage");
  EXPECT_EQ(types["/joint_states"], "sensor_msgs/JointState");
  EXPECT_EQ(types["/diagnostics"], "diagnostic_msgs/DiagnosticArray");
  EXPECT_EQ(types["/nord_driver/bus_status"], "nord_driver/BusStatus");
  for (const std::string drive : {"left", "right"}) {
    EXPECT_EQ(types["/nord_driver/" + drive + "/status"], "nord_driver/DriveStatus");
    EXPECT_EQ(types["/nord_driver/" + drive + "/device_info"], "nord_driver/DeviceInfo");
  }
  for (const char* service : {"enable", "quick_stop", "reset_odometry", "left/enable", "left/quick_stop",
                              "left/read_parameter", "right/enable", "right/quick_stop", "right/read_parameter"}) {
    EXPECT_TRUE(ros::service::exists(std::string("/nord_driver/") + service, false)) << service;
  }
}

// Odometry, its tf and the joints are published from the first answer of all drives on, enabled or not.
TEST_F(StartUp, OdometryTfAndJointsArePublishedWhileDisabled) {
  const auto odom = robot().odom.next();
  ASSERT_TRUE(odom);
  EXPECT_EQ(odom->header.frame_id, "odom");
  EXPECT_EQ(odom->child_frame_id, "base_link");
  EXPECT_NEAR(odom->pose.pose.position.x, 0.0, 1e-6);
  EXPECT_NEAR(odom->pose.pose.position.y, 0.0, 1e-6);

  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  EXPECT_TRUE(buffer.canTransform("odom", "base_link", ros::Time(0), ros::Duration(kPatience.count())));

  const auto joints = robot().joint_states.next();
  ASSERT_TRUE(joints);
  EXPECT_THAT(joints->name, UnorderedElementsAre("left_wheel_joint", "right_wheel_joint"));
  EXPECT_EQ(joints->position.size(), 2u);
  EXPECT_THAT(joints->velocity, ElementsAre(0.0, 0.0));
  EXPECT_EQ(robot().left.truth.next()->operation_enabled, 0);
}

// A late subscriber learns what a drive is: device_info is latched and ends with P105 of all sets.
TEST_F(StartUp, DeviceInfoIsLatched) {
  ros::NodeHandle node;
  for (const std::string drive : {"left", "right"}) {
    Topic<DeviceInfo> topic(node, "nord_driver/" + drive + "/device_info");
    const auto known = [](const DeviceInfo& device) {
      return device.max_frequency.size() == 4 && std::isfinite(device.max_frequency[3]);
    };
    const auto info = topic.waitFrom(0, known);
    ASSERT_TRUE(info) << drive;
    EXPECT_EQ(info->name, drive);
    EXPECT_EQ(info->address, bus().first_address + (drive == "left" ? 0 : 1));
    EXPECT_THAT(info->max_frequency, ElementsAre(50.0, 50.0, 25.0, 50.0));
    EXPECT_EQ(info->ident, bus().ident) << "vendor and product, or the module's ident number";
    EXPECT_EQ(info->parameter_channel, bus().parameter_channel);
    EXPECT_THAT(info->protected_by, HasSubstr(bus().protection));
  }
}

TEST_F(StartUp, BusStatusNamesTheDrivesThatAnswer) {
  const auto all = [](const BusStatus& status) { return status.connected && status.online.size() == 2; };
  const auto status = robot().bus_status.waitNext(all);
  ASSERT_TRUE(status);
  EXPECT_THAT(status->online, UnorderedElementsAre("left", "right"));
  EXPECT_THAT(status->offline, IsEmpty());
  EXPECT_GT(status->cycles, 0u);
  EXPECT_THAT(status->text, Not(IsEmpty()));
}

TEST_F(StartUp, DiagnosticsHaveATaskForTheBusTheBaseAndEachDrive) {
  for (const char* task : {"bus", "base", "drive left", "drive right"}) {
    const auto fine = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::OK; };
    EXPECT_NE(robot().waitForDiagnostics(task, fine), "") << task;
  }
}

// From disabled over "operation enabled" and a way forward, which odometry and truth agree on, back to "ready".
TEST_F(StartUp, EnabledItFollowsCommandsAndDisabledItRests) {
  ASSERT_TRUE(robot().waitForRest());
  Answer answer;
  ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
  const auto enabled = [](const DriveStatus& status) {
    return status.state == DriveStatus::OPERATION_ENABLED && status.control_word == 0x047F;
  };
  ASSERT_TRUE(robot().left.status.waitNext(enabled));
  ASSERT_TRUE(robot().right.status.waitNext(enabled));
  EXPECT_TRUE(robot().left.truth.next()->operation_enabled);
  EXPECT_TRUE(robot().right.truth.next()->operation_enabled);

  // What a speed did between two samples is not seen: a hold-up can hide a way.
  constexpr Seconds kHidesWay{0.2};
  // m: the motors slip, and at the moments of speeding up and braking a cycle is a cycle
  constexpr double kFits = 0.03;
  double seen = 0.0, is = 0.0, aside = 0.0;
  tryAgainOnlyIfStoodStill(
      kHidesWay, [&] { driveAndStop(0.2, seen, is, aside); }, [&] { return std::fabs(is - seen) < kFits; });
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_GT(is, 0.2);
  EXPECT_NEAR(is, seen, kFits);
  EXPECT_NEAR(aside, 0.0, 0.03);

  answer = robot().enable(false);
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_TRUE(robot().waitForRest());
  EXPECT_FALSE(robot().left.truth.next()->operation_enabled);
}

}  // namespace
}  // namespace nord_driver::test

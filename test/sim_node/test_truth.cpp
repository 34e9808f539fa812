#include <nav_msgs/Odometry.h>

#include "sim/profibus/conversation.h"
#include "sim_node/sim_node_fixture.h"

namespace nord_driver::sim_node {
namespace {

class Truth : public SimNodeTest {};

// 25 Hz with two pole pairs and 20:1 are 3.927 rad/s at the wheel, less by the slip; the robot drives straight on.
TEST_F(Truth, FollowsTheDrive) {
  bus->startUp();
  bus->pzdUntil("047E 0000", "0B 31 00 00");
  bus->pzdUntil("047F 2000", "0B 37 20 00");
  EXPECT_TRUE(eventually([](const SimDrive& drive) { return drive.wheel_velocity > 3.8; }));
  const SimDrive drive = truth();
  EXPECT_LT(drive.wheel_velocity, 3.927);
  EXPECT_NEAR(20.0, drive.shaft_velocity / drive.wheel_velocity, 1e-6);
  EXPECT_EQ(25.0, drive.frequency);
  EXPECT_EQ(0x0B37, drive.status_word);
  EXPECT_EQ(0x047F, drive.control_word);
  EXPECT_EQ(8192, drive.setpoint_1);
  EXPECT_EQ(1, drive.parameter_set);
  EXPECT_TRUE(drive.in_data_exchange && drive.operation_enabled);

  const auto odometry = ros::topic::waitForMessage<nav_msgs::Odometry>("/nord_sim/truth/odom", ros::Duration(10.0));
  ASSERT_TRUE(odometry != nullptr);
  EXPECT_EQ("odom", odometry->header.frame_id);
  EXPECT_GT(odometry->twist.twist.linear.x, 0.38);
  EXPECT_EQ(0.0, odometry->twist.twist.angular.z);
  EXPECT_GT(odometry->pose.pose.position.x, 0.1);
}

// The referee has nothing to say until a rule of the bus is broken; then it names rule and count.
TEST_F(Truth, RefereeNamesBrokenRules) {
  bus->startUp();
  bus->pzd("047E 0000");
  EXPECT_EQ("yes, no rule broken", trigger("referee"));
  bus->pzd("0000 0000");
  const std::string report = trigger("referee");
  EXPECT_THAT(report, testing::StartsWith("no, "));
  EXPECT_THAT(report, testing::HasSubstr("bit 10"));
}

}  // namespace
}  // namespace nord_driver::sim_node

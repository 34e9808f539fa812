// The whole way of a command, as doc/follow_a_cmd_vel.md tells it: from a twist to the bytes of the manual, and from
// the bytes of the answer to odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// 50 % of P105 (25 Hz) is 3.92699 rad/s at the joint and 0.392699 m/s.

TEST(FollowACmdVel, FromATwistToTheManualsBytesAndBackToOdometry) {
  SimulatedRobot::Options options;
  options.slip = 0.001;  // IW1 is the output frequency: (nearly) without slip the wheel turns as it says
  SimulatedRobot robot{options};
  robot.link().record(true);
  ASSERT_TRUE(robot.bringUp());

  // Idle: 047E with setpoint 0, answered by "ready to switch on" (BU 2700 6.6.1). PPO 1: PKW is 8 bytes before it.
  robot.link().record(true);
  robot.run(std::chrono::milliseconds{100});
  EXPECT_THAT(robot.link().lastExchange(3).first, HasSubstr(" 04 7E 00 00 "));
  EXPECT_THAT(robot.link().lastExchange(3).second, HasSubstr(" 0B 31 00 00 "));

  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});

  // BU 2700 6.6.2 (which prints 047E for 047F): 50 % forward. The right motor is mounted the other way round: -50 %.
  robot.link().record(true);
  robot.drive(kHalfSpeed, 0.0, std::chrono::milliseconds{50});
  const auto left = robot.link().lastExchange(3);
  EXPECT_THAT(left.first, StartsWith("68 0F 0F 68 03 01 "));
  EXPECT_THAT(left.first, HasSubstr(" 00 00 00 00 00 00 00 00 04 7F 20 00 "));
  EXPECT_THAT(left.first, EndsWith(" 16"));
  EXPECT_THAT(left.second, StartsWith("68 0F 0F 68 01 03 08 "));
  EXPECT_THAT(left.second, HasSubstr(" 0B 37 20 00 "));
  const auto right = robot.link().lastExchange(4);
  EXPECT_THAT(right.first, HasSubstr(" 04 7F E0 00 "));
  EXPECT_THAT(right.second, HasSubstr(" 13 37 E0 00 "));

  // And back: IW1 = 2000h is 25 Hz, 3.927 rad/s and 0.3927 m/s.
  const cycle::CycleSnapshot& seen = robot.snapshot();
  EXPECT_DOUBLE_EQ(25.0, seen.drives[0].frequency);
  EXPECT_DOUBLE_EQ(-25.0, seen.drives[1].frequency);
  EXPECT_NEAR(3.92699, seen.drives[0].velocity, 1e-5);
  EXPECT_NEAR(3.92699, seen.drives[1].velocity, 1e-5);
  EXPECT_NEAR(kHalfSpeed, seen.base.velocity.linear_x, 1e-9);
  EXPECT_NEAR(0.0, seen.base.velocity.angular_z, 1e-9);

  // At rest the pose agrees with what the wheels truly turned.
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  const double way = robot.unit(0).wheelAngle() * 0.1;
  EXPECT_GT(way, 1.0);
  EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01);
  EXPECT_NEAR(0.0, robot.snapshot().base.pose.y, 1e-6);
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

TEST(FollowACmdVel, SlipMakesTheWheelSlowerThanItsField) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
  EXPECT_LT(robot.unit(0).wheelAngle() * 0.1, robot.snapshot().base.pose.x);
}

}  // namespace
}  // namespace nord_driver::test

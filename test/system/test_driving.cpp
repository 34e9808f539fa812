// A base that drives: paths that do not bend, a pose that does not jump.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;

constexpr double kFullSpeed = 0.7853981633974483;  // 50 Hz

// More than 100 % of P105 on the outer wheel: the whole base is scaled, so that the radius stays.
TEST(Driving, BeyondFullSpeedTheWholeBaseIsScaled) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  // Twice too fast: outer wheel 200 %, inner wheel 100 %.
  const double linear = 1.5 * kFullSpeed, angular = kFullSpeed / 0.5;
  robot.drive(linear, angular, std::chrono::seconds{8});
  EXPECT_EQ(0x2000, robot.setpoint(0));
  EXPECT_EQ(-0x4000, robot.setpoint(1));
  const robot::Twist2d velocity = robot.snapshot().base.velocity;
  EXPECT_NEAR(linear / angular, velocity.linear_x / velocity.angular_z, 1e-3) << "the radius";
  EXPECT_NEAR(linear / 2, robot.snapshot().base.command.linear_x, 1e-6) << "cmd_vel_out tells what is really driven";
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

// At most 1 cm in 1 m, with slip, ramps and friction; the odometry's velocity is the output frequency's
// (BU 2700 6.4.4).
TEST(Driving, TheWayIsTrueToACentimetreInAMetre) {
  for (const int wheels_a_side : {1, 2}) {
    SimulatedRobot::Options options;
    options.wheels_a_side = wheels_a_side;
    options.node = {{"linear/x/has_acceleration_limits", true}, {"linear/x/max_acceleration", 0.5}};
    SimulatedRobot robot{options};
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.drive(0.4, 0.0, std::chrono::seconds{3});
    robot.drive(0.0, 0.0, std::chrono::seconds{3});
    double way = 0.0;
    for (std::size_t i = 0; i < robot.driveCount(); ++i) {
      way += 0.1 * robot.unit(i).wheelAngle() / static_cast<double>(robot.driveCount());
    }
    EXPECT_GT(way, 0.8);
    EXPECT_NEAR(way, robot.snapshot().base.pose.x, 0.01 * way);
  }
}

struct Loss {
  const char* name;
  void (*take)(SimulatedRobot&);
  void (*give)(SimulatedRobot&);
};

class PoseOverALoss : public ::testing::TestWithParam<Loss> {};

// A drive or the bus comes back: the pose goes on from where it was, never faster than the wheels can turn.
TEST_P(PoseOverALoss, DoesNotJump) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kFullSpeed, 0.2, std::chrono::seconds{3});
  const double largest_step = 1.2 * kFullSpeed * 0.01;  // one cycle at full speed
  robot::Pose2d before = robot.snapshot().base.pose;
  double position = robot.snapshot().drives[1].joint_position;
  ASSERT_GT(before.x, 0.5);
  for (int cycle = 0; cycle < 600; ++cycle) {
    if (cycle == 20) GetParam().take(robot);
    if (cycle == 320) GetParam().give(robot);
    robot.step();
    const robot::Pose2d pose = robot.snapshot().base.pose;
    ASSERT_LE(std::hypot(pose.x - before.x, pose.y - before.y), largest_step) << "cycle " << cycle;
    ASSERT_LE(std::abs(robot.snapshot().drives[1].joint_position - position), largest_step / 0.1) << "cycle " << cycle;
    before = pose;
    position = robot.snapshot().drives[1].joint_position;
  }
  EXPECT_TRUE(robot.snapshot().drives[0].online);
  EXPECT_TRUE(robot.snapshot().drives[1].online);
  EXPECT_GT(before.x, 0.5) << "the pose is continued, not begun anew";
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

INSTANTIATE_TEST_SUITE_P(
    All, PoseOverALoss,
    ::testing::Values(Loss{"Unplugged", [](SimulatedRobot& robot) { robot.unit(1).setPlugged(false); },
                           [](SimulatedRobot& robot) { robot.unit(1).setPlugged(true); }},
                      Loss{"InverterOff", [](SimulatedRobot& robot) { robot.unit(1).setInverterPower(false); },
                           [](SimulatedRobot& robot) { robot.unit(1).setInverterPower(true); }},
                      Loss{"Mute", [](SimulatedRobot& robot) { robot.unit(1).setMute(true); },
                           [](SimulatedRobot& robot) { robot.unit(1).setMute(false); }},
                      Loss{"BusDevice", [](SimulatedRobot& robot) { robot.segment().setDevicePresent(false); },
                           [](SimulatedRobot& robot) { robot.segment().setDevicePresent(true); }}),
    [](const auto& test) { return std::string{test.param.name}; });

// Before every drive has answered once there is no pose to publish; afterwards there is, enabled or not.
TEST(Driving, ThePoseIsKnownOnceAllDrivesHaveAnswered) {
  SimulatedRobot robot;
  robot.unit(1).setPlugged(false);
  robot.run(std::chrono::seconds{1});
  EXPECT_FALSE(robot.snapshot().base.known);
  robot.unit(1).setPlugged(true);
  EXPECT_TRUE(robot.runUntil([&] { return robot.snapshot().base.known; }, std::chrono::seconds{2}));
  EXPECT_FALSE(robot.snapshot().base.enabled);
}

}  // namespace
}  // namespace nord_driver::test

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cycle/base_motion.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;

constexpr Duration kCycle = milliseconds{10};
constexpr Duration kTimeout = milliseconds{500};
const robot::WheelSpeeds kFastWheels{100.0, 100.0};

BaseConfig configWithDeceleration(double deceleration) {
  BaseConfig config;
  config.left = {0};
  config.right = {1};
  config.geometry.wheel_separation = 0.5;
  config.geometry.left_wheel_radius = 0.1;
  config.geometry.right_wheel_radius = 0.1;
  if (deceleration > 0.0) {
    config.limits.linear_x.has_acceleration_limits = true;
    config.limits.linear_x.max_acceleration = 1000.0;
    config.limits.linear_x.min_acceleration = -deceleration;
  }
  return config;
}

class BaseMotionTest : public ::testing::Test {
 protected:
  void command(double linear, double angular = 0.0) { command_ = {{linear, angular}, now_, true}; }
  robot::WheelSpeeds poll(bool driving = true, bool follow = true, const robot::WheelSpeeds& max = kFastWheels) {
    now_ += kCycle;
    return motion_.pollWheels(command_, driving, follow, max, now_, kCycle);
  }

  BaseMotion motion_{configWithDeceleration(0.0), kTimeout};
  Instant now_{std::chrono::hours{1}};
  TwistCommand command_;
};

TEST_F(BaseMotionTest, TurnsTheCommandIntoWheelSpeeds) {
  command(0.3);
  EXPECT_NEAR(3.0, poll()[0], 1e-12);  // 0.3 m/s on a wheel of 0.1 m
  command(0.0, 1.0);
  EXPECT_NEAR(2.5, poll()[1], 1e-12);  // 0.25 m/s at half the separation
  EXPECT_NEAR(-2.5, poll()[0], 1e-12);
}

TEST_F(BaseMotionTest, ACommandOlderThanItsTimeoutIsZero) {
  command(0.3);
  now_ += kTimeout - kCycle;
  EXPECT_NEAR(3.0, poll()[0], 1e-12);
  EXPECT_EQ(0.0, poll()[0]);
}

TEST_F(BaseMotionTest, ATimeoutOfZeroNeverEnds) {
  BaseMotion patient{configWithDeceleration(0.0), Duration::zero()};
  command(0.3);
  now_ += std::chrono::hours{1};
  EXPECT_NEAR(3.0, patient.pollWheels(command_, true, true, kFastWheels, now_, kCycle)[0], 1e-12);
}

TEST_F(BaseMotionTest, NothingMovesBeforeTheFirstCommand) {
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), poll());
}

TEST_F(BaseMotionTest, BrakesAlongTheDecelerationLimitWhenTheCommandMayNotBeFollowed) {
  motion_ = BaseMotion{configWithDeceleration(1.0), kTimeout};
  command(0.3);
  ASSERT_NEAR(3.0, poll()[0], 1e-9);
  // 1 m/s^2 for 10 ms is 0.01 m/s, 0.1 rad/s at the wheel.
  EXPECT_NEAR(2.9, poll(true, false)[0], 1e-9);
  EXPECT_NEAR(2.8, poll(true, false)[0], 1e-9);
}

// Within the jerk limit the base would go on gaining speed for half a second.
TEST_F(BaseMotionTest, AStopSlowsDownFromItsFirstStepOnWithAJerkLimit) {
  BaseConfig config = configWithDeceleration(1.0);
  config.limits.linear_x.max_acceleration = 1.0;
  config.limits.linear_x.has_jerk_limits = true;
  config.limits.linear_x.max_jerk = 2.0;
  for (const bool by_age : {false, true}) {
    motion_ = BaseMotion{config, kTimeout};
    for (int i = 0; i < 80; ++i) {
      command(3.0);
      poll();
    }
    double before = poll()[0];
    ASSERT_GT(poll()[0], before);
    before = poll()[0];
    if (by_age) now_ += kTimeout;
    for (int i = 0; i < 5; ++i) {
      const double now = poll(true, by_age)[0];
      EXPECT_LT(now, before) << i;
      before = now;
    }
  }
}

// More than one commands: nobody knows whom to follow.
TEST_F(BaseMotionTest, ACommandThatIsHeldBrakes) {
  motion_ = BaseMotion{configWithDeceleration(1.0), kTimeout};
  command(0.3);
  ASSERT_NEAR(3.0, poll()[0], 1e-9);
  command_.held = true;
  EXPECT_NEAR(2.9, poll()[0], 1e-9);
}

// Multipliers taken over under way would be a step of the wheels' speeds: they wait until the base is to stand.
TEST_F(BaseMotionTest, IsTunedWhenItStands) {
  command(0.3);
  poll();
  BaseTuning tuning;
  tuning.left_wheel_radius_multiplier = 0.5;
  tuning.given = true;
  motion_.tune(tuning);
  EXPECT_NEAR(3.0, poll()[0], 1e-12);
  command(0.0);
  poll();
  motion_.tune(tuning);
  command(0.3);
  EXPECT_NEAR(6.0, poll()[0], 1e-12);
  EXPECT_NEAR(3.0, poll()[1], 1e-12);
}

TEST_F(BaseMotionTest, IsNotTunedByWhatCannotBe) {
  for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    BaseTuning tuning;
    tuning.wheel_separation_multiplier = wrong;
    tuning.given = true;
    motion_.tune(tuning);
    command(0.0, 1.0);
    EXPECT_NEAR(2.5, poll()[1], 1e-12) << wrong;
    command(0.0);
    poll();
  }
}

// After a stop the base must begin from standstill, not from the velocity it had before.
TEST_F(BaseMotionTest, ForgetsItsVelocityWhileItIsNotDriving) {
  motion_ = BaseMotion{configWithDeceleration(1.0), kTimeout};
  command(0.3);
  ASSERT_NEAR(3.0, poll()[0], 1e-9);
  EXPECT_EQ(0.0, poll(false)[0]);
  EXPECT_EQ(0.0, motion_.limited().linear_x);
  EXPECT_EQ(0.0, poll(true, false)[0]);
}

TEST_F(BaseMotionTest, ScalesTheWholeBaseWhenOneWheelCannotTurnThatFast) {
  command(1.0, 1.0);  // left 7.5, right 12.5 rad/s
  const robot::WheelSpeeds wheels = poll(true, true, {10.0, 10.0});
  EXPECT_NEAR(10.0, wheels[1], 1e-9);
  EXPECT_NEAR(6.0, wheels[0], 1e-9);
  EXPECT_NEAR(0.8, motion_.limited().linear_x, 1e-9);
  EXPECT_NEAR(0.8, motion_.limited().angular_z, 1e-9);
  EXPECT_TRUE(motion_.beyondFull());
  poll(true, false, {10.0, 10.0});
  EXPECT_FALSE(motion_.beyondFull()) << "it brakes";
}

// A rest of rounding on an axis that may not reverse would be beyond its limit, and scale the whole base to zero.
TEST_F(BaseMotionTest, ABaseThatMayNotReverseTurnsAsFastAsItsWheelsCan) {
  BaseConfig config = configWithDeceleration(0.0);
  config.geometry.right_wheel_radius_multiplier = 1.01;
  config.limits.linear_x.has_velocity_limits = true;
  config.limits.linear_x.max_velocity = 1.0;
  config.limits.linear_x.min_velocity = 0.0;
  motion_ = BaseMotion{config, kTimeout};
  command(0.0, 2.5);  // left -6.25, right 6.19 rad/s
  for (int i = 0; i < 3; ++i) {
    const robot::WheelSpeeds wheels = poll(true, true, {6.0, 6.0});
    EXPECT_NEAR(-6.0, wheels[0], 1e-9);
    EXPECT_NEAR(2.4, motion_.limited().angular_z, 1e-9);
    EXPECT_EQ(0.0, motion_.limited().linear_x);
  }
}

// The velocity limit of a joint in the URDF counts like the drive's 100 %.
TEST_F(BaseMotionTest, ScalesTheWholeBaseIntoTheLimitsOfTheJoints) {
  BaseConfig config = configWithDeceleration(0.0);
  config.joint_velocity_limits = {std::numeric_limits<double>::infinity(), 5.0};
  motion_ = BaseMotion{config, kTimeout};
  command(1.0, 1.0);  // left 7.5, right 12.5 rad/s
  const robot::WheelSpeeds wheels = poll();
  EXPECT_NEAR(5.0, wheels[1], 1e-9);
  EXPECT_NEAR(3.0, wheels[0], 1e-9);
  EXPECT_FALSE(motion_.beyondFull()) << "the drives could";
}

// A command far beyond what the drives can turn must not delay the stop: the first cycle of braking is slower.
TEST_F(BaseMotionTest, BrakesAtOnceFromACommandBeyondTheDrives) {
  motion_ = BaseMotion{configWithDeceleration(1.0), kTimeout};
  const robot::WheelSpeeds max{10.0, 10.0};
  command(5.0);
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(10.0, poll(true, true, max)[0], 1e-9);
  EXPECT_NEAR(1.0, motion_.limited().linear_x, 1e-9);
  EXPECT_NEAR(9.9, poll(true, false, max)[0], 1e-9);
  EXPECT_NEAR(9.8, poll(true, false, max)[0], 1e-9);
}

// A base that cannot go sideways ignores that part of a command, and what it drives is told as such.
TEST_F(BaseMotionTest, SidewaysIsIgnoredWhereItCannotBeDone) {
  command_ = {{0.3, 0.0, 0.4}, now_, true};
  EXPECT_NEAR(3.0, poll()[0], 1e-12);
  EXPECT_EQ(0.0, motion_.limited().linear_y);
}

TEST_F(BaseMotionTest, MecanumGoesSideways) {
  BaseConfig config = configWithDeceleration(0.0);
  config.kind = robot::BaseKind::kMecanum;
  config.left = {0, 1};
  config.right = {2, 3};
  config.geometry.wheel_base = 0.6;
  motion_ = BaseMotion{config, kTimeout};
  command_ = {{0.0, 0.0, 0.3}, now_, true};
  const robot::WheelSpeeds wheels = poll(true, true, {100.0, 100.0, 100.0, 100.0});
  ASSERT_EQ(4u, wheels.size());
  EXPECT_NEAR(-3.0, wheels[0], 1e-12);
  EXPECT_NEAR(3.0, wheels[1], 1e-12);
  EXPECT_NEAR(0.3, motion_.limited().linear_y, 1e-12);
  for (int i = 0; i <= 100; ++i) motion_.handleWheels(wheels, kCycle);
  EXPECT_NEAR(0.3, motion_.odometry().pose().y, 1e-9);
}

TEST_F(BaseMotionTest, WhatIsNotANumberNeverReachesAWheel) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    command(bad, 0.0);
    EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), poll());
    command(0.0, bad);
    EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), poll());
  }
}

TEST_F(BaseMotionTest, MeasuredWheelsMoveThePose) {
  for (int i = 0; i <= 100; ++i) motion_.handleWheels({3.0, 3.0}, kCycle);
  EXPECT_NEAR(0.3, motion_.odometry().pose().x, 1e-9);
}

// open_loop, as diff_drive_controller has it: the pose follows what is commanded, not what is measured.
TEST_F(BaseMotionTest, OpenLoopBelievesTheCommand) {
  BaseConfig config = configWithDeceleration(0.0);
  config.open_loop = true;
  motion_ = BaseMotion{config, kTimeout};
  for (int i = 0; i <= 100; ++i) {
    command(0.2);
    poll();
    motion_.handleWheels({3.0, 3.0}, kCycle);
  }
  EXPECT_NEAR(0.2, motion_.odometry().pose().x, 1e-9);
  // A base that does not drive is commanded nothing.
  for (int i = 0; i <= 100; ++i) {
    poll(false);
    motion_.handleWheels({3.0, 3.0}, kCycle);
  }
  EXPECT_NEAR(0.0, motion_.odometry().velocity().linear_x, 1e-9);
  EXPECT_NEAR(0.201, motion_.odometry().pose().x, 1e-9);  // half a cycle on the way down
}

TEST_F(BaseMotionTest, AGapDoesNotMoveThePose) {
  for (int i = 0; i <= 100; ++i) motion_.handleWheels({3.0, 3.0}, kCycle);
  motion_.handleGap();
  motion_.handleWheels({3.0, 3.0}, std::chrono::seconds{10});
  EXPECT_NEAR(0.3, motion_.odometry().pose().x, 1e-9);
  motion_.resetOdometry();
  EXPECT_EQ(0.0, motion_.odometry().pose().x);
}

}  // namespace
}  // namespace nord_driver::cycle

// The base's acceleration limits against the ramps in the drive.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/ramp_check.h"

namespace nord_driver::node {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kTwoPi = 6.283185307179586;

/// Wheels of 0.1 m, 0.5 m apart, gear ratio 2 pi and two pole pairs: 1 m/s^2 is 10 rad/s^2 at the wheel and 20 Hz/s,
/// 1 rad/s^2 about z is 5 Hz/s.
cycle::CycleConfig robot() {
  cycle::CycleConfig config;
  config.drives.resize(3);
  for (cycle::DriveSetup& drive : config.drives) {
    drive.drive.joint.gear_ratio = kTwoPi;
    drive.drive.joint.pole_pairs = 2;
  }
  config.drives[1].drive.joint.inverted = true;
  config.base.emplace();
  config.base->left = {0};
  config.base->right = {1};
  config.base->geometry.wheel_separation = 0.5;
  config.base->geometry.left_wheel_radius = config.base->geometry.right_wheel_radius = 0.1;
  config.base->limits.linear_x.has_acceleration_limits = true;
  config.base->limits.linear_x.max_acceleration = 1.0;
  return config;
}

cycle::DeviceData ramps(std::optional<double> up, std::optional<double> down, std::optional<double> p105 = 50.0) {
  cycle::DeviceData device;
  device.max_frequency[1] = p105;
  device.acceleration_time[1] = up;
  device.deceleration_time[1] = down;
  return device;
}

std::string assess(const cycle::CycleConfig& config, const cycle::DeviceData& device, DriveIndex drive = 0) {
  return RampCheck{config, drive}.assess(device, 2);
}

// 10 rad/s^2 at the joint are 20 Hz/s there, too.
TEST(RampCheck, ADriveOfNoBaseIsComparedWithItsOwnLimits) {
  cycle::CycleConfig config = robot();
  EXPECT_EQ("", assess(config, ramps(60.0, 60.0), 2)) << "it has none";
  config.drives[2].limits.has_acceleration_limits = true;
  config.drives[2].limits.max_acceleration = 10.0;
  config.drives[2].limits.min_acceleration = -5.0;
  EXPECT_EQ("", assess(config, ramps(2.5, 2.5), 2));
  EXPECT_THAT(assess(config, ramps(5.0, 2.5), 2),
              AllOf(HasSubstr("slower than its joint's limits: P102 of set 2 is 5.00 s"),
                    HasSubstr("the drive's limits ask for up to 20.0 Hz/s: 2.50 s"), Not(HasSubstr("base"))));
}

// 50 Hz in 2.5 s are 20 Hz/s; 0.01 s is the resolution of P102.
TEST(RampCheck, ARampAsFastAsTheLimitsIsFine) {
  EXPECT_EQ("", assess(robot(), ramps(2.5, 2.5)));
  EXPECT_EQ("", assess(robot(), ramps(2.5, 2.5), 1)) << "mounted the other way round";
  EXPECT_EQ("", assess(robot(), ramps(0.0, 0.0))) << "0 s: no ramp at all";
}

TEST(RampCheck, ASlowerRampIsSaidWithWhatItWouldHaveToBe) {
  const std::string up = assess(robot(), ramps(5.0, 2.5));
  EXPECT_THAT(up, AllOf(HasSubstr("P102 of set 2 is 5.00 s"), HasSubstr("10.0 Hz/s"), HasSubstr("20.0 Hz/s"),
                        HasSubstr("2.50 s"), Not(HasSubstr("P103"))));
  const std::string down = assess(robot(), ramps(2.5, 2.51));
  EXPECT_THAT(down, AllOf(HasSubstr("P103 of set 2 is 2.51 s"), Not(HasSubstr("P102"))));
  EXPECT_THAT(assess(robot(), ramps(3.0, 4.0), 1), AllOf(HasSubstr("P102"), HasSubstr("P103 of set 2 is 4.00 s")));
}

// A turn while it speeds up asks the outer wheel for both.
TEST(RampCheck, TheAxesAddUp) {
  cycle::CycleConfig config = robot();
  config.base->limits.angular_z.has_acceleration_limits = true;
  config.base->limits.angular_z.max_acceleration = 1.0;
  EXPECT_EQ("", assess(config, ramps(2.0, 2.0)));
  EXPECT_THAT(assess(config, ramps(2.5, 2.0)), HasSubstr("25.0 Hz/s"));
}

// min_acceleration brakes forward and speeds up backward: it counts for both ramps, unless the base does not reverse.
TEST(RampCheck, MinAccelerationIsForBothWaysOfABaseThatReverses) {
  cycle::CycleConfig config = robot();
  robot::SpeedLimits& limits = config.base->limits.linear_x;
  limits.min_acceleration = -2.0;
  EXPECT_THAT(assess(config, ramps(2.5, 1.25)), AllOf(HasSubstr("P102"), HasSubstr("40.0 Hz/s")));
  limits.has_velocity_limits = true;
  limits.max_velocity = 1.0;
  limits.min_velocity = 0.0;
  EXPECT_EQ("", assess(config, ramps(2.5, 1.25)));
  EXPECT_THAT(assess(config, ramps(2.5, 2.5)), AllOf(HasSubstr("P103"), HasSubstr("40.0 Hz/s")));
}

// Without limits the drives' ramps are the only ones, and what was not read cannot be compared.
TEST(RampCheck, SaysNothingWithoutLimitsOrWithoutTheParameters) {
  cycle::CycleConfig config = robot();
  EXPECT_EQ("", assess(config, ramps(9.0, 9.0), 2)) << "a drive of no base";
  EXPECT_EQ("", assess(config, ramps(std::nullopt, std::nullopt)));
  EXPECT_EQ("", assess(config, ramps(9.0, 9.0, std::nullopt)));
  config.drives[0].typed_max_frequency = 50.0;
  EXPECT_THAT(assess(config, ramps(9.0, 9.0, std::nullopt)), HasSubstr("P102")) << "typed in instead of read";
  EXPECT_EQ("", RampCheck(config, 0).assess(ramps(9.0, 9.0), 0)) << "the set in force is not known yet";
  config.base->limits.linear_x.has_acceleration_limits = false;
  EXPECT_EQ("", assess(config, ramps(9.0, 9.0)));
  config.base.reset();
  EXPECT_EQ("", assess(config, ramps(9.0, 9.0)));
}

TEST(RampCheck, SidewaysCountsForAMecanumBase) {
  cycle::CycleConfig config = robot();
  config.drives.resize(4, config.drives[0]);
  config.base->kind = robot::BaseKind::kMecanum;
  config.base->left = {0, 1};
  config.base->right = {2, 3};
  config.base->geometry.wheel_base = 0.5;
  config.base->limits.linear_y.has_acceleration_limits = true;
  config.base->limits.linear_y.max_acceleration = 0.5;
  EXPECT_THAT(assess(config, ramps(2.5, 1.0), 3), HasSubstr("30.0 Hz/s"));
}

}  // namespace
}  // namespace nord_driver::node

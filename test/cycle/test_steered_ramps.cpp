// A steered base under way: its ramps, and how the path changes with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cycle/steered_bench.h"

namespace nord_driver::cycle {
namespace {

using namespace steered_bench;

BaseConfig withJerk() {
  BaseConfig jerky = config();
  jerky.limits.linear_x.has_jerk_limits = true;
  jerky.limits.linear_x.max_jerk = 2.0;
  return jerky;
}

TEST(SteeredRamps, GainAccelerationWithAJerkLimitAndLoseItInAStop) {
  for (const bool by_age : {false, true}) {
    Base base{withJerk()};
    base.command(1.0);
    double before = 0.0, change = 0.0;
    for (int i = 0; i < 20; ++i) {
      base.poll();
      EXPECT_GT(base.motion.limited().linear_x - before, change) << i;
      change = base.motion.limited().linear_x - before;
      before = base.motion.limited().linear_x;
    }
    base.follow = by_age;
    if (by_age) {
      base.keeps_commanding = false;
      base.newest.received = base.now - kTimeout;
    }
    for (int i = 0; i < 5; ++i) {
      base.poll();
      EXPECT_LT(base.motion.limited().linear_x, before) << "a stop slows down from its first step on";
      before = base.motion.limited().linear_x;
    }
  }
}

// The axes come to zero at different times along their own jerk limits: what is left of the motion would turn the wheels on
// after the base has come to rest.
TEST(SteeredRamps, KeepTheAnglesInAStopWithJerkLimits) {
  BaseConfig jerky = withJerk();
  jerky.limits.angular_z.has_jerk_limits = true;
  jerky.limits.angular_z.max_jerk = 8.0;
  enum class Stop { kDisabled, kTooOld, kZero };
  for (const Stop stop : {Stop::kDisabled, Stop::kTooOld, Stop::kZero}) {
    for (const double seconds_on_the_curve : {1.5, 2.2, 3.0}) {
      Base base{jerky};
      base.command(1.0);
      base.run(1.0);
      base.command(1.0, 0.6);
      base.run(seconds_on_the_curve);
      ASSERT_GT(base.setpoint.angles[0], 0.01);
      const robot::SteeringAngles held = base.setpoint.angles;
      base.follow = stop != Stop::kDisabled;
      base.keeps_commanding = stop != Stop::kTooOld;
      base.newest.received = base.now - kTimeout;
      if (stop == Stop::kZero) base.command(0.0);
      for (int i = 0; i < 400; ++i) {
        base.poll();
        ASSERT_EQ(0.0, robot::largestDifference(held, base.setpoint.angles)) << seconds_on_the_curve << ", " << i;
      }
      EXPECT_EQ(robot::Twist2d{}, base.motion.limited());
    }
  }
}

// P105 of another parameter set, say: the wheels cannot turn as fast any more.
TEST(SteeredRamps, GoOnFromWhatTheWheelsCan) {
  Base base;
  base.command(1.0);
  base.run(2.0);
  base.full_speed = 5.0;
  for (const double wheel : base.poll().wheels) EXPECT_NEAR(5.0, wheel, 1e-9);
  EXPECT_NEAR(0.5, base.motion.limited().linear_x, 1e-9) << "what is told is what it drives";
  base.command(0.0);
  EXPECT_NEAR(4.9, base.poll().wheels[0], 1e-9) << "braking begins at once";
}

// 0.01 m/s sideways in the first cycle: at 0.5 m/s that is 0.02 rad, at 0.3 m/s 0.033 rad, more than half the tolerance.
TEST(SteeredRamps, ATurnOfMoreThanHalfTheToleranceAtOnceIsNotDriven) {
  for (const bool slow : {false, true}) {
    const double speed = slow ? 0.3 : 0.5;
    Base base;
    base.command(speed);
    base.run(1.0);
    base.command(speed, 0.0, 0.4);
    base.poll();
    EXPECT_NEAR(slow ? 0.0 : 0.01, base.motion.limited().linear_y, 1e-9);
    EXPECT_NEAR(slow ? speed - 0.01 : speed, base.motion.limited().linear_x, 1e-9);
  }
}

// What is left of the tolerance is for how exactly the axes come to their angles.
TEST(SteeredRamps, AStepMayLeadTheWheelsByThreeQuartersOfTheTolerance) {
  BaseConfig exact = config();
  exact.steered->angle_tolerance = 0.0625;
  const auto sideways = [&exact](double off, double lead) {
    Base base{exact};
    base.command(0.5);
    base.run(1.0);
    base.command(0.5, 0.0, 0.4);
    base.drives.angles = {off - lead, off - lead};
    base.poll();
    return base;
  };
  const double wanted = sideways(0.0, 0.0).setpoint.angles[0];
  ASSERT_NEAR(0.02, wanted, 1e-4);
  EXPECT_NEAR(0.01, sideways(wanted, 0.75 * 0.0625).motion.limited().linear_y, 1e-9);
  EXPECT_EQ(0.0, sideways(wanted, 0.76 * 0.0625).motion.limited().linear_y) << "it waits for them";
}

// The axes do not follow into a curve: it goes on as it is for half a second, and then gets slower.
TEST(SteeredRamps, APathIsHeldForHalfASecond) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.steering_rate = 0.0;
  base.command(0.5, 0.5);
  int held = 0;
  for (int i = 0; i < 200; ++i) {
    const robot::Twist2d before = base.motion.limited();
    base.poll();
    if (base.motion.waitsFor() == SteeredWait::kAngles) break;
    if (base.motion.limited() == before) ++held;
  }
  EXPECT_EQ(50, held);
  const double before = base.motion.limited().linear_x;
  base.poll();
  EXPECT_LT(base.motion.limited().linear_x, before);
}

// Beside the straight line between two velocities a wheel may have to turn back: of a drive without a reverse that would be
// a rest of the whole base, at once.
TEST(SteeredRamps, ADriveWithoutAReverseMakesNoWheelLeap) {
  BaseConfig jerky = withJerk();
  for (robot::SpeedLimits* axis : {&jerky.limits.angular_z, &jerky.limits.linear_y}) {
    axis->has_jerk_limits = true;
    axis->max_jerk = 2.0;
  }
  Base base{jerky};
  base.drives.minimum = {{0.0, 0.0}, false, {1.0, 1.0}};
  std::mt19937 random{5};
  std::uniform_real_distribution<double> any{-1.0, 1.0};
  std::uniform_int_distribution<int> cycles{1, 300};
  robot::WheelSpeeds before{0.0, 0.0};
  double fastest = 0.0;
  for (int command = 0; command < 600; ++command) {
    base.command(0.9 * std::abs(any(random)), 0.8 * any(random), command % 3 == 0 ? 0.3 * any(random) : 0.0);
    for (int i = cycles(random); i > 0; --i) {
      base.poll();
      for (const std::size_t wheel : {0, 1}) {
        // 1 m/s^2, and 1 rad/s^2 half a metre from the middle, on wheels of 0.1 m; more by the turning of the axes.
        ASSERT_NEAR(before[wheel], base.setpoint.wheels[wheel], 0.2) << "command " << command;
      }
      before = base.setpoint.wheels;
      fastest = std::max(fastest, before[0]);
    }
  }
  EXPECT_GT(fastest, 5.0) << "it was driven";
}

}  // namespace
}  // namespace nord_driver::cycle

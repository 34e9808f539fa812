#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "robot/generators.h"
#include "robot/speed_limiter.h"

namespace nord_driver::robot {
namespace {

const Duration kCycle = seconds(0.01);

SpeedLimits acceleration(double max, double min) {
  SpeedLimits limits;
  limits.has_acceleration_limits = true;
  limits.max_acceleration = max;
  limits.min_acceleration = min;
  return limits;
}

// Nothing limited: the target is the result.
TEST(SpeedLimiter, WithoutLimitsTheTargetPasses) {
  SpeedLimiter limiter{SpeedLimits{}, "linear/x"};
  EXPECT_EQ(7.5, limiter.limit(7.5, kCycle));
  EXPECT_EQ(-7.5, limiter.limit(-7.5, kCycle));
}

// The velocity is cut at max_ forward and at min_ backward.
TEST(SpeedLimiter, CutsTheVelocity) {
  SpeedLimits limits;
  limits.has_velocity_limits = true;
  limits.max_velocity = 1.0;
  limits.min_velocity = -0.5;
  SpeedLimiter limiter{limits, "linear/x"};
  EXPECT_EQ(1.0, limiter.limit(3.0, kCycle));
  EXPECT_EQ(-0.5, limiter.limit(-3.0, kCycle));
}

// Braking is following zero: 1 m/s along 2 m/s^2 takes half a second, and ends in exactly zero.
TEST(SpeedLimiter, BrakesAlongTheDecelerationLimit) {
  SpeedLimiter limiter{acceleration(1.0, -2.0), "linear/x"};
  limiter.reset(1.0);
  for (int i = 1; i < 50; ++i) ASSERT_NEAR(1.0 - 0.02 * i, limiter.limit(0.0, kCycle), 1e-12);
  EXPECT_NEAR(0.0, limiter.limit(0.0, kCycle), 1e-12);
  EXPECT_EQ(0.0, limiter.limit(0.0, kCycle));
}

// diff_drive_controller's meaning: max_acceleration bounds what is added, also while braking from backward.
TEST(SpeedLimiter, BackwardBrakingIsBoundedByMaxAcceleration) {
  SpeedLimiter limiter{acceleration(1.0, -2.0), "linear/x"};
  limiter.reset(-1.0);
  EXPECT_NEAR(-0.99, limiter.limit(0.0, kCycle), 1e-12);
}

// A target that is not finite is a stop along the limit, not a value.
TEST(SpeedLimiter, BrakesForWhatIsNotFinite) {
  SpeedLimiter limiter{acceleration(1.0, -2.0), "linear/x"};
  limiter.reset(1.0);
  EXPECT_NEAR(0.98, limiter.limit(std::numeric_limits<double>::quiet_NaN(), kCycle), 1e-12);
  EXPECT_NEAR(0.96, limiter.limit(std::numeric_limits<double>::infinity(), kCycle), 1e-12);
  EXPECT_NEAR(0.94, limiter.limit(-std::numeric_limits<double>::infinity(), kCycle), 1e-12);
  limiter.reset(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(0.0, limiter.velocity());
}

// No time, no change.
TEST(SpeedLimiter, NoTimeNoChange) {
  SpeedLimiter limiter{SpeedLimits{}, "linear/x"};
  limiter.reset(0.5);
  EXPECT_EQ(0.5, limiter.limit(1.0, Duration{0}));
  EXPECT_EQ(0.5, limiter.limit(1.0, -kCycle));
}

// A velocity found outside the limits comes back along the acceleration limit, not in a jump.
TEST(SpeedLimiter, ComesBackFromOutsideTheVelocityLimit) {
  SpeedLimits limits = acceleration(1.0, -1.0);
  limits.has_velocity_limits = true;
  limits.max_velocity = 0.5;
  SpeedLimiter limiter{limits, "linear/x"};
  limiter.reset(1.0);
  EXPECT_NEAR(0.99, limiter.limit(2.0, kCycle), 1e-12);
  for (int i = 0; i < 60; ++i) limiter.limit(2.0, kCycle);
  EXPECT_NEAR(0.5, limiter.velocity(), 1e-12);
}

// A stop commanded while the axis swings towards the other direction does not carry it through zero.
TEST(SpeedLimiter, JerkLimitDoesNotCarryAStopThroughZero) {
  SpeedLimits limits = acceleration(1.0, -1.0);
  limits.has_jerk_limits = true;
  limits.max_jerk = 1.0;
  SpeedLimiter limiter{limits, "linear/x"};
  limiter.reset(1.0);
  for (int i = 0; limiter.velocity() > 0.2; ++i) {
    ASSERT_LT(i, 1000) << "it does not brake: " << limiter.velocity() << " m/s";
    limiter.limit(-1.0, kCycle);
  }
  for (int i = 0; i < 300; ++i) ASSERT_GE(limiter.limit(0.0, kCycle), 0.0) << i;
  EXPECT_NEAR(0.0, limiter.velocity(), 1e-9);
}

// Limits that cannot be are refused by key.
TEST(SpeedLimiter, RefusesImpossibleLimits) {
  try {
    SpeedLimiter{acceleration(-1.0, -1.0), "linear/x"};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("linear/x/max_acceleration is -1"));
  }
}

// Whatever is commanded: never outside the limits of velocity, acceleration and jerk.
RC_GTEST_PROP(SpeedLimiterProperty, NeverExceedsALimit, (bool with_jerk)) {
  const SpeedLimits limits = anyLimits(with_jerk);
  const double dt = *number(0.001, 0.1);
  SpeedLimiter limiter{limits, "linear/x"};
  const auto targets = *rc::gen::container<std::vector<double>>(
      rc::gen::oneOf(number(-5.0, 5.0), rc::gen::just(0.0), rc::gen::arbitrary<double>()));
  double velocity = 0.0;
  double acceleration = 0.0;
  for (const double target : targets) {
    for (int i = 0; i < 20; ++i) {
      const double next = limiter.limit(target, seconds(dt));
      const double now = (next - velocity) / dt;
      RC_ASSERT(std::isfinite(next));
      RC_ASSERT(next <= limits.max_velocity);
      RC_ASSERT(next >= limits.minVelocity());
      RC_ASSERT(now <= limits.max_acceleration + 1e-6);
      RC_ASSERT(now >= limits.minAcceleration() - 1e-6);
      const bool at_a_stop = next == 0.0 || next == limits.max_velocity || next == limits.minVelocity();
      if (with_jerk && !at_a_stop) {
        RC_ASSERT((now - acceleration) / dt <= limits.max_jerk + 1e-4);
        RC_ASSERT((now - acceleration) / dt >= limits.minJerk() - 1e-4);
      }
      velocity = next;
      acceleration = now;
    }
  }
}

// From anywhere, a target inside the limits is reached and kept.
RC_GTEST_PROP(SpeedLimiterProperty, ReachesTheTarget, (bool with_jerk)) {
  const SpeedLimits limits = anyLimits(with_jerk);
  SpeedLimiter limiter{limits, "linear/x"};
  const double first = *number(-3.0, 3.0);
  const int steps = *rc::gen::inRange(0, 300);
  for (int i = 0; i < steps; ++i) limiter.limit(first, kCycle);
  const double target = *number(limits.minVelocity(), limits.max_velocity);
  // The slowest: 6 m/s at 0.2 m/s^2 and winding up and down at 0.5 m/s^3, with room.
  for (int i = 0; i < 6000; ++i) limiter.limit(target, kCycle);
  RC_ASSERT(std::abs(limiter.velocity() - target) < 1e-9);
}

// Ramping from rest never passes the target: no swing about it.
RC_GTEST_PROP(SpeedLimiterProperty, DoesNotOvershootFromRest, (bool with_jerk)) {
  const SpeedLimits limits = anyLimits(with_jerk);
  SpeedLimiter limiter{limits, "linear/x"};
  const double target = *number(0.0, limits.max_velocity);
  double before = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double velocity = limiter.limit(target, kCycle);
    RC_ASSERT(velocity <= target + 1e-9);
    RC_ASSERT(velocity >= before - 1e-9);
    before = velocity;
  }
}

// Cycles are late, and the ones after them early: what a long step has planned is still kept in short ones.
RC_GTEST_PROP(SpeedLimiterProperty, DoesNotOvershootInUnevenCycles, (bool with_jerk)) {
  const SpeedLimits limits = anyLimits(with_jerk);
  SpeedLimiter limiter{limits, "linear/x"};
  const double target = *number(0.0, limits.max_velocity);
  for (int i = 0; i < 300; ++i) {
    const double dt = *rc::gen::element(0.001, 0.005, 0.01, 0.02, 0.035, 0.1);
    RC_ASSERT(limiter.limit(target, seconds(dt)) <= target + 1e-9);
  }
}

}  // namespace
}  // namespace nord_driver::robot

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "robot/generators.h"
#include "robot/twist_limiter.h"

namespace nord_driver::robot {
namespace {

const Duration kCycle = seconds(0.01);
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// 1 m/s and 2 rad/s at most; 0.5 m/s^2 and 4 rad/s^2.
TwistLimits limits() {
  TwistLimits limits;
  limits.linear_x.has_velocity_limits = true;
  limits.linear_x.max_velocity = 1.0;
  limits.linear_x.has_acceleration_limits = true;
  limits.linear_x.max_acceleration = 0.5;
  limits.angular_z.has_velocity_limits = true;
  limits.angular_z.max_velocity = 2.0;
  limits.angular_z.has_acceleration_limits = true;
  limits.angular_z.max_acceleration = 4.0;
  return limits;
}

TwistLimits anyTwistLimits(bool with_jerk) {
  TwistLimits limits;
  limits.linear_x = anyLimits(with_jerk);
  limits.angular_z = anyLimits(with_jerk);
  limits.linear_y = anyLimits(with_jerk);
  return limits;
}

double sizeOf(const Twist2d& twist) {
  return std::hypot(twist.linear_x, twist.angular_z, twist.linear_y);
}

/// How far `twist` lies beside the straight line through zero and `path`, as the sine of the angle between them.
double besideThePath(const Twist2d& twist, const Twist2d& path) {
  const double size = sizeOf(twist) * sizeOf(path);
  if (size == 0.0) return 0.0;
  return std::hypot(twist.linear_x * path.angular_z - twist.angular_z * path.linear_x,
                    twist.angular_z * path.linear_y - twist.linear_y * path.angular_z,
                    twist.linear_y * path.linear_x - twist.linear_x * path.linear_y) /
         size;
}

// As far as the jerk limit lets it go in one step, to the last bit: rounding does not make two steps of it.
TEST(TwistLimiter, GoesInOneStepWhereTheJerkLimitAllowsIt) {
  TwistLimits smooth = limits();
  smooth.linear_x.has_jerk_limits = true;
  smooth.linear_x.max_jerk = 3.0;
  for (const double target : {0.0003, -0.0003}) {
    TwistLimiter limiter{smooth};
    EXPECT_EQ(target, limiter.limit({target, 0.0, 0.0}, kCycle).linear_x);
  }
}

// To the left as to the right: limits that are equal both ways make equal ways, to the last bit.
TEST(TwistLimiter, GoesOneWayAsTheOther) {
  for (const double jerk : {0.7, 3.0, 50.0}) {
    TwistLimits smooth = limits();
    for (SpeedLimits* axis : {&smooth.linear_x, &smooth.angular_z}) {
      axis->has_jerk_limits = true;
      axis->max_jerk = jerk;
    }
    TwistLimiter one{smooth}, other{smooth};
    for (int i = 0; i < 3000; ++i) {
      const int leg = i / 250 % 6;
      const Twist2d target{0.13 * leg, 0.29 * (3 - leg), 0.0};
      const Twist2d there = one.limit(target, kCycle);
      const Twist2d back = other.limit({-target.linear_x, -target.angular_z, 0.0}, kCycle);
      ASSERT_EQ(there.linear_x, -back.linear_x) << i;
      ASSERT_EQ(there.angular_z, -back.angular_z) << i;
    }
  }
}

// A command beyond the velocity limit of one axis is scaled as a whole: same circle, slower.
TEST(TwistLimiter, ScalesBothAxesIntoTheVelocityLimits) {
  TwistLimits fast = limits();
  fast.linear_x.has_acceleration_limits = fast.angular_z.has_acceleration_limits = false;
  TwistLimiter limiter{fast};
  const Twist2d slowed = limiter.limit({2.0, 2.0}, kCycle);
  EXPECT_DOUBLE_EQ(1.0, slowed.linear_x);
  EXPECT_DOUBLE_EQ(1.0, slowed.angular_z);
  const Twist2d turning = limiter.limit({1.0, -8.0}, kCycle);
  EXPECT_DOUBLE_EQ(0.25, turning.linear_x);
  EXPECT_DOUBLE_EQ(-2.0, turning.angular_z);
}

// A base that can go sideways: the limit of linear/y slows forward motion and turning too, and the path stays.
TEST(TwistLimiter, ScalesAllThreeAxes) {
  TwistLimits mecanum = limits();
  mecanum.linear_x.has_acceleration_limits = mecanum.angular_z.has_acceleration_limits = false;
  mecanum.linear_y.has_velocity_limits = true;
  mecanum.linear_y.max_velocity = 0.25;
  TwistLimiter limiter{mecanum};
  const Twist2d slowed = limiter.limit({0.5, 1.0, -0.5}, kCycle);
  EXPECT_DOUBLE_EQ(0.25, slowed.linear_x);
  EXPECT_DOUBLE_EQ(0.5, slowed.angular_z);
  EXPECT_DOUBLE_EQ(-0.25, slowed.linear_y);
}

// The acceleration limit of linear/y sets the pace of all: 0.2 m/s^2 for half a second.
TEST(TwistLimiter, SidewaysSetsThePace) {
  TwistLimits mecanum = limits();
  mecanum.linear_y.has_acceleration_limits = true;
  mecanum.linear_y.max_acceleration = 0.2;
  TwistLimiter limiter{mecanum};
  for (int i = 0; i < 50; ++i) limiter.limit({0.5, -1.0, 0.5}, kCycle);
  EXPECT_NEAR(0.1, limiter.twist().linear_x, 1e-12);
  EXPECT_NEAR(-0.2, limiter.twist().angular_z, 1e-12);
  EXPECT_NEAR(0.1, limiter.twist().linear_y, 1e-12);
}

// Speeding up, the axis that could be faster waits: after half a second at 0.5 m/s^2 on a circle of 1 m.
TEST(TwistLimiter, TheSlowerAxisSetsThePace) {
  TwistLimiter limiter{limits()};
  for (int i = 0; i < 50; ++i) limiter.limit({1.0, 1.0}, kCycle);
  EXPECT_NEAR(0.25, limiter.twist().linear_x, 1e-12);
  EXPECT_NEAR(0.25, limiter.twist().angular_z, 1e-12);
}

// Braking to zero stays on the path and ends when the slower axis ends.
TEST(TwistLimiter, BrakesOnThePath) {
  TwistLimiter limiter{limits()};
  limiter.reset({0.5, 1.0});
  for (int i = 0; i < 99; ++i) {
    const Twist2d twist = limiter.limit({}, kCycle);
    ASSERT_NEAR(2.0, twist.angular_z / twist.linear_x, 1e-9) << i;
  }
  limiter.limit({}, kCycle);
  limiter.limit({}, kCycle);
  EXPECT_EQ((Twist2d{}), limiter.twist());
}

// With the option each axis is limited for itself, as diff_drive_controller does.
TEST(TwistLimiter, IndependentAxesByOption) {
  TwistLimits independent = limits();
  independent.limit_axes_independently = true;
  TwistLimiter limiter{independent};
  for (int i = 0; i < 50; ++i) limiter.limit({5.0, 1.0}, kCycle);
  EXPECT_NEAR(0.25, limiter.twist().linear_x, 1e-12);
  EXPECT_NEAR(1.0, limiter.twist().angular_z, 1e-12);
}

// NaN or infinity on either axis is no command for that axis or the other: both brake.
TEST(TwistLimiter, BrakesForWhatIsNotFinite) {
  for (const bool independent : {false, true}) {
    TwistLimits both = limits();
    both.limit_axes_independently = independent;
    for (const Twist2d& bad :
         {Twist2d{kNan, 1.0}, Twist2d{1.0, std::numeric_limits<double>::infinity()}, Twist2d{0.5, 0.5, kNan}}) {
      TwistLimiter limiter{both};
      limiter.reset({0.5, 0.5});
      const Twist2d twist = limiter.limit(bad, kCycle);
      EXPECT_LT(twist.linear_x, 0.5);
      EXPECT_LT(twist.angular_z, 0.5);
      for (int i = 0; i < 110; ++i) limiter.limit(bad, kCycle);
      EXPECT_EQ((Twist2d{}), limiter.twist());
    }
  }
}

// No time, no change; and a reset to nonsense is a reset to zero.
TEST(TwistLimiter, NoTimeNoChange) {
  TwistLimiter limiter{TwistLimits{}};
  limiter.reset({0.5, kNan});
  EXPECT_EQ((Twist2d{0.5, 0.0}), limiter.limit({1.0, 1.0}, Duration{0}));
}

// Limits that cannot be are refused with the key of their axis.
TEST(TwistLimiter, RefusesImpossibleLimits) {
  TwistLimits wrong = limits();
  wrong.angular_z.max_velocity = -2.0;
  try {
    TwistLimiter{wrong};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("angular/z/max_velocity is -2"));
  }
  wrong = limits();
  wrong.linear_y.has_velocity_limits = true;
  wrong.linear_y.max_velocity = -0.5;
  try {
    TwistLimiter{wrong};
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("linear/y/max_velocity is -0.5"));
  }
}

// From standstill and back to standstill the curvature never changes, with any limits.
RC_GTEST_PROP(TwistLimiterProperty, KeepsTheCurvature, (bool with_jerk)) {
  TwistLimiter limiter{anyTwistLimits(with_jerk)};
  const Twist2d target = *twistWithin(5.0, 5.0, 5.0);
  const double dt = *number(0.001, 0.05);
  const int steps = *rc::gen::inRange(1, 400);
  for (int i = 0; i < steps; ++i) {
    RC_ASSERT(besideThePath(limiter.limit(target, seconds(dt)), target) < 1e-9);
  }
  for (int i = 0; i < 200; ++i) {
    const Twist2d twist = limiter.limit({}, seconds(dt));
    // Where the base all but stands, the direction of what is left is rounding.
    if (sizeOf(twist) < 1e-6) break;
    RC_ASSERT(besideThePath(twist, target) < 1e-9);
  }
}

// Cycles are late, and the ones after them early: no axis passes its target, and there it stays.
RC_GTEST_PROP(TwistLimiterProperty, DoesNotOvershootInUnevenCycles, (bool x_jerk, bool z_jerk, bool independently)) {
  TwistLimits limits = anyTwistLimits(true);
  limits.linear_x.has_jerk_limits = x_jerk;
  limits.angular_z.has_jerk_limits = z_jerk;
  limits.limit_axes_independently = independently;
  TwistLimiter limiter{limits};
  const Twist2d target{*number(0.0, 3.0), *number(0.0, 3.0), *number(0.0, 3.0)};
  for (int i = 0; i < 300; ++i) {
    const Twist2d twist = limiter.limit(target, seconds(*rc::gen::element(0.001, 0.005, 0.01, 0.02, 0.035, 0.1)));
    RC_ASSERT(twist.linear_x <= target.linear_x + 1e-9);
    RC_ASSERT(twist.angular_z <= target.angular_z + 1e-9);
    RC_ASSERT(twist.linear_y <= target.linear_y + 1e-9);
  }
}

// Whatever is commanded: each axis inside its own limits, and finite.
RC_GTEST_PROP(TwistLimiterProperty, NeverExceedsALimit, (bool with_jerk, bool independently)) {
  TwistLimits any = anyTwistLimits(with_jerk);
  any.limit_axes_independently = independently;
  TwistLimiter limiter{any};
  const double dt = *number(0.001, 0.1);
  const auto targets = *rc::gen::container<std::vector<Twist2d>>(twistWithin(6.0, 6.0, 6.0));
  Twist2d before;
  const auto check = [dt](double now, double last, const SpeedLimits& axis) {
    RC_ASSERT(now <= axis.max_velocity && now >= axis.minVelocity());
    RC_ASSERT((now - last) / dt <= axis.max_acceleration + 1e-6);
    RC_ASSERT((now - last) / dt >= axis.minAcceleration() - 1e-6);
  };
  for (const Twist2d& target : targets) {
    for (int i = 0; i < 20; ++i) {
      const Twist2d twist = limiter.limit(target, seconds(dt));
      RC_ASSERT(isFinite(twist));
      check(twist.linear_x, before.linear_x, any.linear_x);
      check(twist.angular_z, before.angular_z, any.angular_z);
      check(twist.linear_y, before.linear_y, any.linear_y);
      before = twist;
    }
  }
}

// Any sequence of doubles, NaN and infinities among them, gives finite twists.
RC_GTEST_PROP(TwistLimiterProperty, IsAlwaysFinite, (std::vector<std::tuple<double, double, double>> targets)) {
  TwistLimits some;
  some.linear_x.has_jerk_limits = *rc::gen::arbitrary<bool>();
  some.linear_x.max_jerk = 1.0;
  some.angular_z.has_acceleration_limits = *rc::gen::arbitrary<bool>();
  some.angular_z.max_acceleration = 1.0;
  TwistLimiter limiter{some};
  constexpr double kMax = std::numeric_limits<double>::max();
  targets.emplace_back(kMax, -kMax, kMax);
  targets.emplace_back(kNan, kNan, kNan);
  targets.emplace_back(-kMax, kMax, -kMax);
  for (const auto& [x, z, y] : targets) RC_ASSERT(isFinite(limiter.limit({x, z, y}, kCycle)));
}

// From any motion, a new path is reached and kept, and a stop ends in standstill.
RC_GTEST_PROP(TwistLimiterProperty, ReachesTheTarget, (bool with_jerk)) {
  const TwistLimits any = anyTwistLimits(with_jerk);
  TwistLimiter limiter{any};
  const Twist2d first = *twistWithin(3.0, 3.0, 3.0);
  const int steps = *rc::gen::inRange(0, 300);
  for (int i = 0; i < steps; ++i) limiter.limit(first, kCycle);
  const Twist2d target{*number(any.linear_x.minVelocity(), any.linear_x.max_velocity),
                       *number(any.angular_z.minVelocity(), any.angular_z.max_velocity),
                       *number(any.linear_y.minVelocity(), any.linear_y.max_velocity)};
  for (int i = 0; i < 6000; ++i) limiter.limit(target, kCycle);
  RC_ASSERT(std::abs(limiter.twist().linear_x - target.linear_x) < 1e-9);
  RC_ASSERT(std::abs(limiter.twist().angular_z - target.angular_z) < 1e-9);
  RC_ASSERT(std::abs(limiter.twist().linear_y - target.linear_y) < 1e-9);
  for (int i = 0; i < 6000; ++i) limiter.limit({}, kCycle);
  RC_ASSERT(std::abs(limiter.twist().linear_x) < 1e-9);
  RC_ASSERT(std::abs(limiter.twist().angular_z) < 1e-9);
  RC_ASSERT(std::abs(limiter.twist().linear_y) < 1e-9);
}

/// Steps until the target is reached; 3000 when it is not.
int stepsTo(const Twist2d& target, TwistLimiter limiter) {
  int steps = 0;
  for (; steps < 3000; ++steps) {
    const Twist2d twist = limiter.limit(target, kCycle);
    if (sizeOf({twist.linear_x - target.linear_x, twist.angular_z - target.angular_z,
                twist.linear_y - target.linear_y}) < 1e-6) {
      break;
    }
  }
  return steps;
}

// Keeping the path costs little time, whichever of the axes have jerk limits; a stop least of all.
RC_GTEST_PROP(TwistLimiterProperty, TakesLittleLongerThanTheAxesAlone, (bool x_jerk, bool z_jerk, bool y_jerk)) {
  TwistLimits any;
  any.linear_x = anyLimits(x_jerk);
  any.angular_z = anyLimits(z_jerk);
  any.linear_y = anyLimits(y_jerk);
  const auto inside = [&any] {
    return Twist2d{*number(any.linear_x.minVelocity(), any.linear_x.max_velocity),
                   *number(any.angular_z.minVelocity(), any.angular_z.max_velocity),
                   *number(any.linear_y.minVelocity(), any.linear_y.max_velocity)};
  };
  TwistLimiter together{any};
  any.limit_axes_independently = true;
  TwistLimiter alone{any};
  const Twist2d from = inside();
  together.reset(from);
  alone.reset(from);
  const Twist2d to = inside();
  RC_ASSERT(stepsTo(to, together) <= 2 * stepsTo(to, alone) + 20);
  RC_ASSERT(stepsTo({}, together) <= 2 * stepsTo({}, alone) + 20);
}

// A stop ends in time from any moment of speeding up: 1 s of braking, and what the acceleration takes to wind down.
RC_GTEST_PROP(TwistLimiterProperty, StopsInTimeFromUnderWay, (bool x_jerk, bool z_jerk, bool y_jerk)) {
  const auto axis = [](bool with_jerk) {
    SpeedLimits limits;
    limits.has_velocity_limits = limits.has_acceleration_limits = true;
    limits.max_velocity = limits.max_acceleration = *number(0.2, 3.0);
    limits.has_jerk_limits = with_jerk;
    limits.max_jerk = 5.0 * limits.max_acceleration;
    return limits;
  };
  TwistLimits any;
  any.linear_x = axis(x_jerk);
  any.angular_z = axis(z_jerk);
  any.linear_y = axis(y_jerk);
  TwistLimiter limiter{any};
  for (int target = 0; target < 3; ++target) {
    const Twist2d to = *twistWithin(3.0, 3.0, 3.0);
    const int steps = *rc::gen::inRange(0, 100);
    for (int i = 0; i < steps; ++i) limiter.limit(to, kCycle);
  }
  RC_ASSERT(stepsTo({}, limiter) <= 200);
}

// Speeding up in one direction, and told another: what it gains speed by can only be wound down, so that for this step each
// axis goes its own shortest way, and the one that is asked for waits for none.
TEST(TwistLimiter, AnAccelerationThatPointsElsewhereHoldsNoAxisBack) {
  TwistLimits jerky = limits();
  jerky.linear_x.has_jerk_limits = jerky.angular_z.has_jerk_limits = true;
  jerky.linear_x.max_jerk = 4.0;
  jerky.angular_z.max_jerk = 40.0;
  for (const double forward : {0.8, -0.8}) {
    TwistLimits apart = jerky;
    apart.limit_axes_independently = true;
    TwistLimiter together{jerky};
    TwistLimiter alone{apart};
    for (int i = 0; i < 5; ++i) {
      together.limit({forward, 0.0}, kCycle);
      alone.limit({forward, 0.0}, kCycle);
    }
    const Twist2d under_way = together.limit({0.0, 1.5}, kCycle);
    alone.limit({0.0, 1.5}, kCycle);
    EXPECT_NEAR(alone.twist().linear_x, under_way.linear_x, 1e-12);
    EXPECT_NEAR(alone.twist().angular_z, under_way.angular_z, 1e-12);
    EXPECT_NEAR(0.004, under_way.angular_z, 1e-12) << "40 rad/s^3 for 10 ms, twice";
  }
}

// A jerk limit on one axis alone must not hold the other one back, nor a stop.
TEST(TwistLimiter, AJerkLimitOnOneAxisAloneStillStopsInTime) {
  TwistLimits mixed = limits();
  mixed.linear_x.has_jerk_limits = true;
  mixed.linear_x.max_jerk = 4.0;
  TwistLimiter limiter{mixed};
  limiter.reset({0.4, 1.6});
  // 0.4 m/s at 0.5 m/s^2 and 4 m/s^3: 0.8 s and 0.125 s.
  EXPECT_LE(stepsTo({}, limiter), 95);
}

}  // namespace
}  // namespace nord_driver::robot

#include <gtest/gtest.h>

#include "robot/ramp.h"

namespace nord_driver::robot {
namespace {

constexpr double kDt = 0.01;

// Without limits the target is reached in one step.
TEST(Ramp, NoLimitsReachesAtOnce) {
  EXPECT_DOUBLE_EQ(100.0, nextAcceleration(1.0, 0.0, {}, kDt));
}

// Up is bounded by max_, down by min_ acceleration.
TEST(Ramp, AccelerationIsBoundedBySign) {
  RampLimits limits;
  limits.min_acceleration = -3.0;
  limits.max_acceleration = 2.0;
  EXPECT_DOUBLE_EQ(2.0, nextAcceleration(1.0, 0.0, limits, kDt));
  EXPECT_DOUBLE_EQ(-3.0, nextAcceleration(-1.0, 0.0, limits, kDt));
  // The last step is as small as it has to be.
  EXPECT_DOUBLE_EQ(1.0, nextAcceleration(0.01, 0.0, limits, kDt));
}

// The acceleration itself grows no faster than the jerk limit, up by max_jerk and down by min_jerk.
TEST(Ramp, JerkBoundsTheChangeOfAcceleration) {
  RampLimits limits;
  limits.min_jerk = -20.0;
  limits.max_jerk = 10.0;
  EXPECT_DOUBLE_EQ(0.1, nextAcceleration(5.0, 0.0, limits, kDt));
  EXPECT_DOUBLE_EQ(1.1, nextAcceleration(5.0, 1.0, limits, kDt));
  EXPECT_DOUBLE_EQ(0.8, nextAcceleration(-5.0, 1.0, limits, kDt));
}

// Looks ahead: the target is met with the acceleration wound down, without passing it.
TEST(Ramp, WindsDownBeforeTheTarget) {
  RampLimits limits;
  limits.min_acceleration = -1.0;
  limits.max_acceleration = 1.0;
  limits.min_jerk = -5.0;
  limits.max_jerk = 5.0;
  double velocity = 0.0;
  double acceleration = 0.0;
  int steps = 0, near_steps = 0;
  while (velocity != 1.0 && steps < 1000) {
    const double next = nextAcceleration(1.0 - velocity, acceleration, limits, kDt);
    ASSERT_LE(next, 1.0);
    ASSERT_LE(next - acceleration, 0.05 + 1e-12) << steps;
    ASSERT_GE(next - acceleration, -0.05 - 1e-9) << steps;
    velocity += next * kDt;
    acceleration = next;
    ASSERT_LE(velocity, 1.0 + 1e-12);
    if (1.0 - velocity < 1e-13) velocity = 1.0;
    if (1.0 - velocity > 1e-4) ++near_steps;
    ++steps;
  }
  // 0.2 s to 1 m/s^2 (0.1 m/s), 0.8 m/s at 1 m/s^2, 0.2 s back: 1.2 s. The last tenth of a millimetre per second takes
  // a few steps, each much smaller than the one before.
  EXPECT_NEAR(120, near_steps, 3);
  EXPECT_LE(steps, near_steps + 5);
}

// At the target with acceleration left (the target has moved here), the jerk limit is kept and the target passed.
TEST(Ramp, KeepsTheJerkLimitWhereTheTargetMustBePassed) {
  RampLimits limits;
  limits.min_jerk = -5.0;
  limits.max_jerk = 5.0;
  EXPECT_DOUBLE_EQ(0.95, nextAcceleration(0.0, 1.0, limits, kDt));
  EXPECT_DOUBLE_EQ(-0.95, nextAcceleration(0.0, -1.0, limits, kDt));
}

}  // namespace
}  // namespace nord_driver::robot

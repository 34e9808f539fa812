// A step on the straight line to the target, whatever the limiter is set to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robot/twist_limiter.h"

namespace nord_driver::robot {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds{10};

struct Mode {
  const char* name;
  bool independent;
  bool jerk;
};

/// 0.5 m/s^2 and 4 rad/s^2.
TwistLimits limitsOf(const Mode& mode) {
  TwistLimits limits;
  limits.linear_x.has_acceleration_limits = limits.angular_z.has_acceleration_limits = true;
  limits.linear_x.max_acceleration = 0.5;
  limits.angular_z.max_acceleration = 4.0;
  limits.linear_x.has_jerk_limits = limits.angular_z.has_jerk_limits = mode.jerk;
  limits.linear_x.max_jerk = 2.0;
  limits.angular_z.max_jerk = 16.0;
  limits.limit_axes_independently = mode.independent;
  return limits;
}

class OnLine : public ::testing::TestWithParam<Mode> {
 protected:
  OnLine() {
    for (int i = 0; i < 20; ++i) limiter_.limit({1.0, 3.0}, kCycle);  // it gains speed on another path
    from_ = limiter_.twist();
  }

  TwistLimiter limiter_{limitsOf(GetParam())};
  const Twist2d to_{0.6, -1.0};
  Twist2d from_;
};

TEST_P(OnLine, EachStepIsOnTheLineAndInsideTheAccelerationLimits) {
  Twist2d before = from_;
  int steps = 0;
  for (; limiter_.twist() != to_ && steps < 400; ++steps) {
    const Twist2d now = limiter_.limitOnLine(to_, kCycle);
    EXPECT_NEAR((now.linear_x - from_.linear_x) * (to_.angular_z - from_.angular_z),
                (now.angular_z - from_.angular_z) * (to_.linear_x - from_.linear_x), 1e-9);
    EXPECT_LE(std::abs(now.linear_x - before.linear_x), 0.005 + 1e-12);
    EXPECT_LE(std::abs(now.angular_z - before.angular_z), 0.04 + 1e-12);
    before = now;
  }
  EXPECT_EQ(to_, limiter_.twist());
  const double longest = std::max((to_.linear_x - from_.linear_x) / 0.5, (from_.angular_z - to_.angular_z) / 4.0);
  const double wound_up_and_down = GetParam().jerk ? 0.25 + 0.25 : 0.0;  // s, 0.5 m/s^2 at 2 m/s^3
  EXPECT_NEAR(longest + wound_up_and_down, 0.01 * steps, GetParam().jerk ? 0.26 : 0.01)
      << "at the pace of the axis that needs longer";
}

// Beside a target that is near, what is left of the acceleration would lead beyond it.
TEST_P(OnLine, TheTargetIsNeverPassed) {
  const Twist2d near{from_.linear_x + 0.01, from_.angular_z + 0.1};
  for (int i = 0; i < 100; ++i) {
    const Twist2d now = limiter_.limitOnLine(near, kCycle);
    EXPECT_LE(now.linear_x, near.linear_x + 1e-3);
    EXPECT_LE(now.angular_z, near.angular_z + 1e-2);
  }
  EXPECT_EQ(near, limiter_.twist());
}

// Along the line the jerk limit holds.
TEST(OnLineWithJerk, TheAccelerationGrowsAlongIt) {
  for (const bool independent : {false, true}) {
    TwistLimiter limiter{limitsOf({"", independent, true})};
    Twist2d before = limiter.twist(), change;
    for (int i = 0; i < 20; ++i) {
      const Twist2d now = limiter.limitOnLine({0.6, -1.0}, kCycle);
      EXPECT_LE(std::abs(now.linear_x - before.linear_x - change.linear_x), 0.0002 + 1e-12);
      EXPECT_LE(std::abs(now.angular_z - before.angular_z - change.angular_z), 0.0016 + 1e-12);
      change = {now.linear_x - before.linear_x, now.angular_z - before.angular_z};
      before = now;
    }
    EXPECT_NEAR(0.04, before.linear_x, 0.005) << "2 m/s^3 for 0.2 s";
  }
}

TEST_P(OnLine, NoTimeNoChange) {
  EXPECT_EQ(from_, limiter_.limitOnLine(to_, Duration::zero()));
  EXPECT_EQ(from_, limiter_.limitOnLine(to_, -kCycle));
}

INSTANTIATE_TEST_SUITE_P(OfTheLimiter, OnLine,
                         ::testing::Values(Mode{"together", false, false}, Mode{"together_with_jerk", false, true},
                                           Mode{"independent", true, false}, Mode{"independent_with_jerk", true, true}),
                         [](const auto& mode) { return mode.param.name; });

// limit(): what an axis cannot do in one step because of its jerk limit is not begun by the other one either.
TEST(OnLineWithJerk, ASmallLimitHoldsTheOtherAxisBack) {
  TwistLimits smooth = limitsOf({"", false, true});
  smooth.linear_x.max_jerk = 0.001;
  smooth.angular_z.max_jerk = 5.0;
  TwistLimiter limiter{smooth};
  const Twist2d target{1e-5, 2e-4};
  for (int i = 0; i < 200; ++i) {
    const Twist2d twist = limiter.limit(target, kCycle);
    ASSERT_LE(twist.linear_x, target.linear_x) << i;
    ASSERT_LE(twist.angular_z, target.angular_z) << i;
    ASSERT_NEAR(twist.linear_x * target.angular_z, twist.angular_z * target.linear_x, 1e-18) << i;
  }
  EXPECT_EQ(target, limiter.twist());
}

}  // namespace
}  // namespace nord_driver::robot

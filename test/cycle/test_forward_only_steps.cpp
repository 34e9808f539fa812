// A wheel without a reverse, or with a minimum frequency, makes no other wheel leap: whatever the limiter is set to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cycle/base_motion.h"

namespace nord_driver::cycle {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds{10};
constexpr double kRadius = 0.1, kHalf = 0.265;                           // m, of a wheel, and half the separation
constexpr double kLinear = 0.5, kAngular = 3.0;                          // m/s^2, rad/s^2
constexpr double kStep = (kLinear + kAngular * kHalf) / kRadius * 0.01;  // rad/s of a wheel, in a cycle

struct Mode {
  const char* name;
  bool independent;
  bool jerk;
};

BaseConfig configOf(const Mode& mode) {
  BaseConfig config;
  config.left = {0};
  config.right = {1};
  config.geometry.wheel_separation = 2.0 * kHalf;
  config.geometry.left_wheel_radius = config.geometry.right_wheel_radius = kRadius;
  robot::SpeedLimits& linear = config.limits.linear_x;
  robot::SpeedLimits& angular = config.limits.angular_z;
  linear.has_acceleration_limits = angular.has_acceleration_limits = true;
  linear.max_acceleration = kLinear;
  angular.max_acceleration = kAngular;
  linear.has_jerk_limits = angular.has_jerk_limits = mode.jerk;
  linear.max_jerk = 2.0 * kLinear;
  angular.max_jerk = 2.0 * kAngular;
  config.limits.limit_axes_independently = mode.independent;
  return config;
}

class Steps : public ::testing::TestWithParam<Mode> {
 protected:
  /// The greatest step of a wheel meanwhile, rad/s.
  double greatestStep(const robot::Twist2d& twist, int cycles) {
    double greatest = 0.0;
    for (int i = 0; i < cycles; ++i) {
      now_ += kCycle;
      const robot::WheelSpeeds wheels =
          motion_.pollWheels({twist, now_, true}, true, true, {100.0, 100.0}, now_, kCycle, minimum_);
      for (std::size_t wheel = 0; wheel < wheels.size(); ++wheel) {
        EXPECT_GE(wheels[wheel], -1e-9) << "it has no reverse";
        greatest = std::max(greatest, std::abs(wheels[wheel] - last_[wheel]));
      }
      last_ = wheels;
    }
    return greatest;
  }

  MinimumSpeeds minimum_{{0.0, 0.0}, false, {1.0, 1.0}};
  BaseMotion motion_{configOf(GetParam()), std::chrono::milliseconds{500}};
  Instant now_{std::chrono::hours{1}};
  robot::WheelSpeeds last_{0.0, 0.0};
};

// angular/z is there first: the inner wheel would have to reverse until linear/x has followed.
TEST_P(Steps, ACurveIsBegunAlongTheLimits) {
  EXPECT_LE(greatestStep({1.0, 1.5}, 400), kStep * 1.001);
  EXPECT_DOUBLE_EQ(1.0, motion_.limited().linear_x);
  EXPECT_DOUBLE_EQ(1.5, motion_.limited().angular_z);
}

// What is left of the acceleration on the first path leads beside the way to the second one.
TEST_P(Steps, AnotherPathIsTakenAlongTheLimits) {
  EXPECT_LE(greatestStep({2.0, 5.0}, 60), kStep * 1.001);
  EXPECT_LE(greatestStep({0.85, -1.21}, 400), kStep * 1.001);
  EXPECT_DOUBLE_EQ(-1.21, motion_.limited().angular_z);
  EXPECT_LE(greatestStep({}, 600), kStep * 1.001);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), last_);
}

TEST_P(Steps, NothingThatIsCommandedIsALeap) {
  std::mt19937 random{GetParam().jerk ? 7U : 8U};
  std::uniform_real_distribution<double> any{-1.0, 1.0};
  std::uniform_int_distribution<int> cycles{1, 150};
  double fastest = 0.0;
  for (int command = 0; command < 2000; ++command) {
    const robot::Twist2d twist{2.0 * any(random), 6.0 * any(random)};
    ASSERT_LE(greatestStep(twist, cycles(random)), kStep * 1.001)
        << "command " << command << ": " << twist.linear_x << " m/s, " << twist.angular_z << " rad/s";
    fastest = std::max(fastest, last_[0]);
  }
  EXPECT_GT(fastest, 10.0) << "they were driven";
}

// With a P104 the slower wheel begins with it, and the faster one in the proportion of the curve: no faster.
TEST_P(Steps, AWheelWithAMinimumBeginsTheCurveWhereThatIs) {
  minimum_ = {{2.0, 2.0}};
  const double ratio = (1.0 + 1.5 * kHalf) / (1.0 - 1.5 * kHalf);
  EXPECT_LE(greatestStep({1.0, 1.5}, 400), 2.0 * ratio + kStep);
  EXPECT_DOUBLE_EQ(1.5, motion_.limited().angular_z);
}

// Neither on the way to a first command nor between two of them is a velocity faster than both.
TEST_P(Steps, NoVelocityIsBeyondTheOneThatIsCommanded) {
  for (const MinimumSpeeds& minimum : {MinimumSpeeds{{1.0, 1.0}}, MinimumSpeeds{{0.0, 0.0}, false, {1.0, 1.0}}}) {
    minimum_ = minimum;
    for (const robot::Twist2d& twist : {robot::Twist2d{0.12, 0.0}, {0.3, 0.3}, {0.12, 0.0}, {1.0, 1.5}, {0.3, 0.3}}) {
      const robot::Twist2d before = motion_.limited();
      for (int i = 0; i < 400; ++i) {
        greatestStep(twist, 1);
        EXPECT_LE(motion_.limited().linear_x, std::max(before.linear_x, twist.linear_x) + 1e-3);
        EXPECT_LE(motion_.limited().angular_z, std::max(before.angular_z, twist.angular_z) + 1e-2);
      }
      EXPECT_DOUBLE_EQ(twist.linear_x, motion_.limited().linear_x);
    }
    greatestStep({}, 400);
  }
}

// Below P104 the ramp runs on alone: what it has come to is not begun with by a stop.
TEST_P(Steps, AStopBeforeTheWheelsTurnTurnsNone) {
  minimum_ = {{1.0, 1.0}};
  for (int stop = 1; stop < 300; ++stop) {
    BaseMotion motion{configOf(GetParam()), std::chrono::milliseconds{500}};
    bool turned = false;
    for (int i = 0; i < 200 && !turned; ++i) {
      now_ += kCycle;
      const robot::Twist2d twist = i < stop ? robot::Twist2d{0.6, 1.5} : robot::Twist2d{};
      const bool turns = motion.pollWheels({twist, now_, true}, true, true, {100.0, 100.0}, now_, kCycle, minimum_) !=
                         robot::WheelSpeeds{0.0, 0.0};
      EXPECT_FALSE(turns && i >= stop) << "in cycle " << i << ", stopped in " << stop;
      turned = turns;
    }
    if (turned) return;  // from here on it is a stop of wheels that turn
  }
  FAIL() << "it never drove";
}

// A jerk limit without a limit of acceleration is a configuration, too.
TEST(StepsWithJerkAlone, TheBaseIsNoFasterThanItsCommand) {
  BaseConfig config = configOf({"", false, true});
  config.limits.linear_x.has_acceleration_limits = config.limits.angular_z.has_acceleration_limits = false;
  for (const bool independent : {false, true}) {
    config.limits.limit_axes_independently = independent;
    for (const MinimumSpeeds& minimum : {MinimumSpeeds{{1.0, 1.0}}, MinimumSpeeds{{0.0, 0.0}, false, {1.0, 1.0}}}) {
      BaseMotion motion{config, std::chrono::milliseconds{500}};
      Instant now{std::chrono::hours{1}};
      double fastest = 0.0;
      for (int i = 0; i < 600; ++i) {
        now += kCycle;
        motion.pollWheels({{0.3, 0.45}, now, true}, true, true, {100.0, 100.0}, now, kCycle, minimum);
        fastest = std::max(fastest, motion.limited().linear_x);
      }
      EXPECT_NEAR(0.3, fastest, 1e-3);
      EXPECT_DOUBLE_EQ(0.3, motion.limited().linear_x);
      EXPECT_DOUBLE_EQ(0.45, motion.limited().angular_z);
    }
  }
}

/// The cycles in which it drove, and how often it began to.
struct Ride {
  int cycles = 0;
  int starts = 0;
  robot::Twist2d end;
  bool below_minimum = false;
};

Ride rideOf(const BaseConfig& config, const MinimumSpeeds& minimum, const robot::Twist2d& twist) {
  BaseMotion motion{config, std::chrono::milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  Ride ride;
  bool drove = false;
  for (int i = 0; i < 1000; ++i) {
    now += kCycle;
    motion.pollWheels({twist, now, true}, true, true, {100.0, 100.0}, now, kCycle, minimum);
    const bool drives = motion.limited() != robot::Twist2d{};
    if (drives) ++ride.cycles;
    if (drives && !drove) ++ride.starts;
    drove = drives;
  }
  ride.end = motion.limited();
  ride.below_minimum = motion.belowMinimum();
  return ride;
}

// Each axis is cut for itself then: the line leads to that velocity, and it is that one which has to be possible.
TEST(StepsOfIndependentAxes, TheLineLeadsWhereTheVelocityLimitsLeadTo) {
  for (const bool jerk : {false, true}) {
    BaseConfig config = configOf({"", true, jerk});
    config.limits.angular_z.has_velocity_limits = true;
    config.limits.angular_z.max_velocity = 1.0;
    for (const double linear : {0.5, 0.45}) {
      const Ride ride = rideOf(config, {{1.0, 1.0}}, {linear, 3.0});
      EXPECT_EQ(1, ride.starts);
      EXPECT_DOUBLE_EQ(linear, ride.end.linear_x);
      EXPECT_DOUBLE_EQ(1.0, ride.end.angular_z);
    }
    config.limits.angular_z.has_velocity_limits = false;
    config.limits.linear_x.has_velocity_limits = true;
    config.limits.linear_x.max_velocity = 0.5;
    const Ride ride = rideOf(config, {{0.0, 0.0}, false, {1.0, 1.0}}, {2.0, 4.0});
    EXPECT_EQ(0, ride.cycles) << "0.5 m/s and 4 rad/s would turn a wheel back";
    EXPECT_TRUE(ride.below_minimum);
  }
}

// Without a limit angular/z is there at once, and would turn the inner wheel back until linear/x has followed.
TEST(StepsOfIndependentAxes, NoWheelIsTurnedAgainstItsWay) {
  for (const bool jerk : {false, true}) {
    BaseConfig config = configOf({"", true, jerk});
    config.limits.angular_z = {};
    const Ride ride = rideOf(config, {{1.0, 1.0}}, {1.0, 2.0});
    EXPECT_EQ(1, ride.starts);
    EXPECT_DOUBLE_EQ(1.0, ride.end.linear_x);
    EXPECT_DOUBLE_EQ(2.0, ride.end.angular_z);
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheLimiter, Steps,
                         ::testing::Values(Mode{"together", false, false}, Mode{"together_with_jerk", false, true},
                                           Mode{"independent", true, false}, Mode{"independent_with_jerk", true, true}),
                         [](const auto& mode) { return mode.param.name; });

}  // namespace
}  // namespace nord_driver::cycle

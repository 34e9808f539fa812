// The ramps of a base between rest and its least speed (P104), within limits that become tighter, and its multipliers.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/base_motion.h"

namespace nord_driver::cycle {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds{10};
constexpr Duration kTimeout = std::chrono::milliseconds{500};

/// Wheels of 0.1 m, half a metre apart; 1 m/s^2 both ways is 0.1 rad/s of a wheel in a cycle.
BaseConfig config(double jerk = 0.0) {
  BaseConfig config;
  config.left = {0};
  config.right = {1};
  config.geometry.wheel_separation = 0.5;
  config.geometry.left_wheel_radius = config.geometry.right_wheel_radius = 0.1;
  config.limits.linear_x.has_acceleration_limits = true;
  config.limits.linear_x.max_acceleration = 1.0;
  config.limits.linear_x.has_jerk_limits = jerk > 0.0;
  config.limits.linear_x.max_jerk = jerk;
  return config;
}

class BaseRamps : public ::testing::Test {
 protected:
  robot::WheelSpeeds poll(double linear, double angular = 0.0, bool driving = true) {
    now_ += kCycle;
    return motion_.pollWheels({{linear, angular}, now_, true}, driving, true, max_, now_, kCycle, minimum_);
  }
  void run(double linear, int cycles) {
    for (int i = 0; i < cycles; ++i) poll(linear);
  }
  /// Cycles of rest before the wheels turn.
  int cyclesUntilItTurns(double linear) {
    for (int i = 0; i < 1000; ++i) {
      if (poll(linear)[0] != 0.0) return i;
    }
    return -1;
  }

  BaseMotion motion_{config(), kTimeout};
  robot::WheelSpeeds max_{100.0, 100.0};
  MinimumSpeeds minimum_{{1.95, 1.95}, false};  // 0.195 m/s
  Instant now_{std::chrono::hours{1}};
};

TEST_F(BaseRamps, BeginAtTheLeastSpeedWhenTheyHaveComeToIt) {
  EXPECT_EQ(19, cyclesUntilItTurns(0.5));
  run(0.5, 100);
  EXPECT_TRUE(motion_.obeys());
}

TEST_F(BaseRamps, BeginAnewBehindARest) {
  run(0.5, 100);
  while (poll(0.0)[0] != 0.0) EXPECT_GE(motion_.limited().linear_x, 0.195);
  EXPECT_EQ(19, cyclesUntilItTurns(0.5)) << "from standstill";
}

// It is told as resting although a velocity is commanded, whether it is on its way up or asked for less than it can.
TEST_F(BaseRamps, TellThatItRestsForItsLeastSpeed) {
  poll(0.5);
  EXPECT_TRUE(motion_.belowMinimum());
  run(0.5, 100);
  EXPECT_FALSE(motion_.belowMinimum());
  poll(0.1);
  EXPECT_NEAR(0.49, motion_.limited().linear_x, 1e-9) << "left along the limits";
  EXPECT_TRUE(motion_.belowMinimum());
  EXPECT_FALSE(motion_.obeys());
  run(0.1, 100);
  EXPECT_EQ(0.0, motion_.limited().linear_x);
  EXPECT_TRUE(motion_.belowMinimum());
  EXPECT_EQ(19, cyclesUntilItTurns(0.5)) << "what it was too slow for was no part of its ramp";
  while (poll(0.0)[0] != 0.0) continue;
  EXPECT_FALSE(motion_.belowMinimum()) << "nothing is commanded";
}

TEST_F(BaseRamps, TellNothingOfABaseThatDoesNotDrive) {
  poll(0.5, 0.0, false);
  EXPECT_FALSE(motion_.obeys());
  EXPECT_FALSE(motion_.belowMinimum());
  EXPECT_FALSE(motion_.beyondFull());
}

// P105 of another parameter set, say: the wheels cannot turn as fast any more.
TEST_F(BaseRamps, GoOnFromWhatTheWheelsCan) {
  run(1.0, 200);
  max_ = {5.0, 5.0};
  for (const double wheel : poll(1.0)) EXPECT_NEAR(5.0, wheel, 1e-9);
  EXPECT_NEAR(0.5, motion_.limited().linear_x, 1e-9) << "what is told is what it drives";
  EXPECT_NEAR(4.9, poll(0.0)[0], 1e-9) << "braking begins at once";
}

TEST_F(BaseRamps, GainAccelerationWithAJerkLimit) {
  motion_ = BaseMotion{config(2.0), kTimeout};
  minimum_ = {};
  double before = 0.0, change = 0.0;
  for (int i = 0; i < 10; ++i) {
    const double now = poll(1.0)[0];
    EXPECT_GT(now - before, change) << i;
    change = now - before;
    before = now;
  }
}

BaseConfig turning(bool independently) {
  BaseConfig turning = config(2.0);
  turning.geometry.wheel_separation = 0.53;
  turning.geometry.left_wheel_radius = turning.geometry.right_wheel_radius = 0.11;
  turning.limits.angular_z = turning.limits.linear_x;
  turning.limits.angular_z.max_acceleration = 2.0;
  turning.limits.angular_z.max_jerk = 40.0;
  turning.limits.limit_axes_independently = independently;
  return turning;
}

/// Cycles until a base that drives at `from` has come to `to`.
int cyclesToTurnIn(const BaseConfig& config, const robot::Twist2d& from, const robot::Twist2d& to, double full_speed) {
  BaseMotion motion{config, kTimeout};
  Instant now{std::chrono::hours{1}};
  const auto poll = [&](const robot::Twist2d& twist) {
    now += kCycle;
    const robot::WheelSpeeds wheels =
        motion.pollWheels({twist, now, true}, true, true, {full_speed, full_speed}, now, kCycle);
    for (const double wheel : wheels) EXPECT_LE(std::abs(wheel), full_speed * (1.0 + 1e-12));
    return motion.limited();
  };
  for (int i = 0; i < 1000; ++i) poll(from);
  int cycles = 0, arrived = 0;
  for (robot::Twist2d before = motion.limited(); cycles < 2000; ++cycles) {
    const robot::Twist2d next = poll(to);
    if (std::abs(next.linear_x - before.linear_x) + std::abs(next.angular_z - before.angular_z) > 1e-7) {
      arrived = cycles;
    }
    before = next;
  }
  return arrived;
}

// The faster wheel stays at 100 %. Scaled for a rest of rounding, the base would begin to gain acceleration in each cycle.
TEST(BaseAtFullSpeed, TurnsInAsFastAsItsLimitsAllow) {
  for (const bool independently : {false, true}) {
    for (const double full_speed : {10.0, 7.3, 9.7}) {
      for (const double turn : {0.5, 1.0, 3.0, -2.0}) {
        const double fastest = 0.11 * full_speed;
        const double part = fastest / (fastest + 0.265 * std::abs(turn));
        const robot::Twist2d end{part * fastest, part * turn};
        const int free = cyclesToTurnIn(turning(independently), {fastest, 0.0}, end, 100.0);
        const int bound = cyclesToTurnIn(turning(independently), {fastest, 0.0}, {fastest, turn}, full_speed);
        EXPECT_LE(bound, free + free / 10) << independently << ", " << full_speed << ", " << turn;
      }
    }
  }
}

// Each axis cut at a limit of its own, the left wheel would be asked for more than before that: -5.4 rad/s.
TEST(BaseAtFullSpeed, TheRampOfIndependentAxesEndsInsideTheLimitsOfTheWheels) {
  BaseConfig slow = config(2.0);
  slow.limits.angular_z = slow.limits.linear_x;
  slow.limits.linear_x.has_velocity_limits = true;
  slow.limits.linear_x.max_velocity = 0.2;
  slow.limits.limit_axes_independently = true;
  BaseMotion motion{slow, kTimeout};
  Instant now{std::chrono::hours{1}};
  robot::Twist2d before, change;
  for (int i = 0; i < 500; ++i) {
    now += kCycle;
    const robot::WheelSpeeds wheels = motion.pollWheels({{1.0, 3.0}, now, true}, true, true, {5.0, 100.0}, now, kCycle);
    ASSERT_GE(wheels[0], -5.0 - 1e-12);
    const robot::Twist2d next = motion.limited();
    ASSERT_NEAR(change.angular_z, next.angular_z - before.angular_z, 2.0 * 0.01 * 0.01 + 1e-9) << "jerk, cycle " << i;
    change.angular_z = next.angular_z - before.angular_z;
    before = next;
  }
  EXPECT_NEAR(0.0, change.angular_z, 1e-9);
  EXPECT_GT(before.angular_z, 2.7);
}

/// Of a base that stands, without limits.
class BaseTunings : public ::testing::Test {
 protected:
  /// On the spot at 1 rad/s, after a rest in which it was tuned.
  robot::WheelSpeeds turn(double separation, double left, double right) {
    poll(0.0);
    motion_.tune({separation, left, right, true});
    return poll(1.0);
  }
  robot::WheelSpeeds poll(double angular) {
    now_ += kCycle;
    return motion_.pollWheels({{0.0, angular}, now_, true}, true, true, {100.0, 100.0}, now_, kCycle);
  }
  static BaseConfig free() {
    BaseConfig free = config();
    free.limits = {};
    return free;
  }

  BaseMotion motion_{free(), kTimeout};
  Instant now_{std::chrono::hours{1}};
};

TEST_F(BaseTunings, AreOfTheSeparationAndOfEachSide) {
  const auto expect = [](const robot::WheelSpeeds& wheels, double left, double right) {
    EXPECT_NEAR(left, wheels[0], 1e-9);
    EXPECT_NEAR(right, wheels[1], 1e-9);
  };
  expect(turn(1.0, 1.0, 1.0), -2.5, 2.5);
  expect(turn(2.0, 1.0, 1.0), -5.0, 5.0);
  expect(turn(2.0, 1.0, 0.5), -5.0, 10.0);
  expect(turn(2.0, 0.5, 0.5), -10.0, 10.0);
  expect(turn(1.0, 1.0, 1.0), -2.5, 2.5);
}

}  // namespace
}  // namespace nord_driver::cycle

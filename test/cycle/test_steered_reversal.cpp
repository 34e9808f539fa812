// A steered base under way that has to turn a wheel about: it comes to a stop for that, whatever its limits.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "cycle/steered_bench.h"

namespace nord_driver::cycle {
namespace {

using namespace steered_bench;
using robot::Twist2d;

constexpr Twist2d kForward{0.5, 0.2, 0.0};
constexpr Twist2d kBack{-0.2, 0.3, 0.0};

/// angular/z has a jerk limit; linear/x none, and an acceleration limit where one is given.
BaseConfig jerkOfYaw(double jerk, std::optional<double> forward = 0.5, double range = kQuarter) {
  BaseConfig limited = config(range);
  limited.limits.linear_x.has_acceleration_limits = forward.has_value();
  limited.limits.linear_x.max_acceleration = forward.value_or(0.0);
  limited.limits.angular_z.has_jerk_limits = true;
  limited.limits.angular_z.max_jerk = jerk;
  return limited;
}

struct Reversing : Base {
  explicit Reversing(const BaseConfig& config, const Twist2d& from = kForward, double rate = 5.0) : Base(config) {
    steering_rate = rate;
    order(from);
    run(8.0);
  }
  void order(const Twist2d& twist) { command(twist.linear_x, twist.angular_z, twist.linear_y); }
  bool stands() const { return motion.limited() == Twist2d{}; }
  bool waits() const { return motion.waitsFor() == SteeredWait::kAngles; }
  /// It brakes for a wheel that is to be turned about, and has not come to its stop yet.
  bool comesToItsStop() {
    for (int i = 0; i < 500 && !waits(); ++i) poll();
    return waits() && !stands();
  }
};

bool isNear(const Twist2d& a, const Twist2d& b, double distance) {
  return std::abs(a.linear_x - b.linear_x) < distance && std::abs(a.angular_z - b.angular_z) < distance &&
         std::abs(a.linear_y - b.linear_y) < distance;
}

// An axis without a jerk limit is at zero long before one that has it: the base would turn on the spot for minutes.
TEST(SteeredReversal, ArrivesWithAJerkLimitOfOneAxisAlone) {
  const std::vector<std::pair<Twist2d, Twist2d>> pairs{
      {kForward, kBack}, {kBack, kForward}, {{-0.5, 0.4, 0.0}, {0.3, 0.4, 0.0}}, {{0.3, -0.2, 0.0}, {-0.1, -0.4, 0.0}}};
  for (const double jerk : {0.5, 1.0, 4.0}) {
    for (const std::optional<double> forward : {std::optional<double>{}, std::optional{0.5}, std::optional{2.0}}) {
      for (const double range : {1.2, kQuarter, 1.6}) {
        for (const auto& [from, to] : pairs) {
          const BaseConfig limited = jerkOfYaw(jerk, forward, range);
          Reversing base{limited, from, 1.5};
          base.order(to);
          base.run(10.0);
          const Twist2d possible = robot::SteeredKinematics{limited.steered->axles}.possible(to);
          EXPECT_TRUE(isNear(possible, base.motion.limited(), 1e-6))
              << "jerk " << jerk << ", forward " << forward.value_or(0.0) << ", range " << range << ", to "
              << to.linear_x << ' ' << to.angular_z << ": " << base.motion.limited().linear_x << ' '
              << base.motion.limited().angular_z;
        }
      }
    }
  }
}

// From then on until it drives off it says what it waits for: the 5 s after which that is told are not begun anew.
TEST(SteeredReversal, OnceItBrakesItGoesOnToItsStop) {
  Reversing base{jerkOfYaw(0.5)};
  base.order(kBack);
  ASSERT_TRUE(base.comesToItsStop());
  int cycles = 0;
  for (; !base.stands() && cycles < 200; ++cycles) {
    base.poll();
    ASSERT_TRUE(base.waits()) << cycles;
  }
  EXPECT_LT(cycles, 200) << "0.3 rad/s with 0.5 rad/s^3 take 1.55 s";
}

// A joystick, or a planner that commands another velocity in each cycle.
TEST(SteeredReversal, ACommandThatVariesALittleDoesNotKeepItFromItsStop) {
  for (const double size : {0.001, 0.02}) {
    std::mt19937 random{7};
    std::uniform_real_distribution<double> some{-size, size};
    Reversing base{jerkOfYaw(0.5)};
    for (int i = 0; i < 1000; ++i) {
      base.order({kBack.linear_x + some(random), kBack.angular_z + some(random), 0.0});
      base.poll();
    }
    EXPECT_TRUE(isNear(kBack, base.motion.limited(), 2.0 * size)) << size;
  }
}

TEST(SteeredReversal, EndsWhenNoWheelHasToBeTurnedAboutAnyMore) {
  Reversing base{jerkOfYaw(0.5)};
  base.order(kBack);
  ASSERT_TRUE(base.comesToItsStop());
  base.order({0.2, 0.3, 0.0});
  for (int i = 0; i < 600; ++i) {
    base.poll();
    ASSERT_FALSE(base.stands()) << i;
  }
  EXPECT_TRUE(isNear({0.2, 0.3, 0.0}, base.motion.limited(), 1e-6));
}

// Too much at once for the wheels, which go on the same way round: gets slower for as long as that is so.
TEST(SteeredReversal, ATurnTooLargeForOneStepIsNoStop) {
  Reversing base{config(), {0.3, 0.0, 0.0}};
  base.order({0.3, 0.0, 0.4});
  base.poll();
  EXPECT_NEAR(0.29, base.motion.limited().linear_x, 1e-9);
  base.order({0.4, 0.0, 0.0});
  base.poll();
  EXPECT_NEAR(0.30, base.motion.limited().linear_x, 1e-9);
  EXPECT_FALSE(base.waits());
}

// Sideways and a little back is a way through the curves between, although from standstill a wheel would reverse for it.
TEST(SteeredReversal, AWheelThatIsOffForAMomentIsNoStop) {
  BaseConfig slow = config(3.0);
  for (robot::SpeedLimits* axis : {&slow.limits.linear_x, &slow.limits.linear_y}) axis->max_acceleration = 0.5;
  for (const bool off : {false, true}) {
    Reversing base{slow, {0.8, 0.0, 0.0}};
    base.order({-0.2, 0.0, 0.7});
    base.run(0.1);
    ASSERT_FALSE(base.waits());
    if (off) base.drives.angles[0] += 2.0 * kTolerance;
    base.poll();
    EXPECT_EQ(off, base.waits());
    for (int i = 0; i < 600; ++i) {
      base.poll();
      ASSERT_FALSE(base.stands()) << i;
    }
    EXPECT_TRUE(isNear({-0.2, 0.0, 0.7}, base.motion.limited(), 1e-6));
  }
}

// A stop that is commanded meanwhile is as short as any.
TEST(SteeredReversal, IsNotInTheWayOfAStop) {
  Reversing base{jerkOfYaw(0.5)};
  base.order(kBack);
  ASSERT_TRUE(base.comesToItsStop());
  base.run(0.1);
  const double turns = base.motion.limited().angular_z;
  base.order({});
  int cycles = 0;
  for (; !base.stands() && cycles < 1000; ++cycles) base.poll();
  EXPECT_LE(cycles * toSeconds(kCycle), 2.0 * std::sqrt(turns / 0.5) + 0.05);
}

}  // namespace
}  // namespace nord_driver::cycle

// A steered base at rest: what its wheels and angles do, from when on it drives, and what it tells of that.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cycle/steered_bench.h"

namespace nord_driver::cycle {
namespace {

using namespace steered_bench;

constexpr robot::Twist2d kRest{};

/// Cycles of rest before the wheels turn; -1: they do not.
int cyclesUntilItTurns(Base& base) {
  for (int i = 0; i < 1000; ++i) {
    if (base.poll().wheels[0] != 0.0) return i;
  }
  return -1;
}

TEST(SteeredRest, TellsNothingOfABaseThatDoesNotDrive) {
  Base base;
  base.driving = false;
  base.command(0.5);
  base.poll();
  EXPECT_FALSE(base.motion.obeys());
  EXPECT_FALSE(base.motion.belowMinimum());
  EXPECT_FALSE(base.motion.beyondFull());
  EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor());
}

TEST(SteeredRest, BeginsFromStandstillAfterAStop) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.driving = false;
  base.poll();
  EXPECT_EQ(kRest, base.motion.limited());
  base.driving = true;
  base.poll();
  EXPECT_NEAR(0.01, base.motion.limited().linear_x, 1e-9);
}

TEST(SteeredRest, WaitsForNothingAnyMoreOnceItDrives) {
  Base base;
  base.command(0.0, 0.0, 0.4);
  base.poll();
  ASSERT_EQ(SteeredWait::kAngles, base.motion.waitsFor());
  base.run(4.0);
  EXPECT_NEAR(0.4, base.motion.limited().linear_y, 1e-9);
  EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor());
}

// Of a command that is followed, and be it zero; not while it is steered first, nor without one.
TEST(SteeredRest, TellsWhetherItObeys) {
  Base base;
  base.command(0.0, 0.0, 0.4);
  base.poll();
  EXPECT_FALSE(base.motion.obeys()) << "it steers";
  base.command(0.0);
  base.poll();
  EXPECT_TRUE(base.motion.obeys());
  base.follow = false;
  base.poll();
  EXPECT_FALSE(base.motion.obeys());
  base.follow = true;
  base.keeps_commanding = false;
  base.run(1.0);
  EXPECT_FALSE(base.motion.obeys()) << "grown old";
}

TEST(SteeredRest, WhatIsNoNumberIsNoMotion) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Base base;
    base.command(0.5, bad);
    base.poll();
    EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
    EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor()) << "no angle is asked for";
  }
}

// Its setpoint stays: it does not give way, whatever there was before.
TEST(SteeredRest, HoldsAnAxisThatIsPushedAway) {
  const auto expectHeld = [](Base& base, const char* why) {
    base.command(0.0);
    base.steering_rate = 0.0;
    const robot::SteeringAngles before = base.setpoint.angles;
    base.drives.angles[1] += 0.2;
    for (int i = 0; i < 3; ++i) {
      base.poll();
      EXPECT_EQ(before, base.setpoint.angles) << why;
      EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor()) << why;
    }
  };
  Base rests;
  rests.command(0.0);
  rests.run(0.1);
  expectHeld(rests, "at rest");
  Base blind;
  blind.drives.angles[1] = std::numeric_limits<double>::quiet_NaN();
  blind.command(0.0);
  blind.poll();
  blind.drives.angles[1] = 0.3;
  blind.run(0.1);
  expectHeld(blind, "its angle was not known for a while");
  Base enabled;
  enabled.driving = false;
  enabled.poll();
  enabled.driving = true;
  enabled.drives.wheels_turn = true;
  enabled.drives.wheel_speed = 0.01;
  enabled.command(0.0, 0.0, 0.4);
  enabled.poll();
  ASSERT_EQ(SteeredWait::kAngles, enabled.motion.waitsFor());
  expectHeld(enabled, "it was enabled while its wheels rolled");
}

// What is within the tolerance has arrived, the tolerance itself too.
TEST(SteeredRest, AWheelAtItsToleranceIsNearEnough) {
  for (const bool turns : {false, true}) {
    Base base;
    base.steering_rate = 0.0;
    base.drives.angles = {kTolerance, 0.0};
    base.drives.wheels_turn = turns;
    base.drives.wheel_speed = 0.01;
    base.command(0.5);
    EXPECT_EQ(0, cyclesUntilItTurns(base)) << turns;
    EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor());
    EXPECT_NEAR(0.01, base.motion.limited().linear_x, 1e-9);
  }
}

TEST(SteeredRest, AWheelThatHasArrivedKeepsItsAngle) {
  Base base;
  base.steering_rate = 0.0;
  base.driving = false;
  base.drives.angles = {0.3, 0.3};
  base.poll();
  base.driving = true;
  base.command(0.5);
  base.poll();
  ASSERT_EQ((robot::SteeringAngles{0.0, 0.0}), base.setpoint.angles);
  base.drives.angles = {kTolerance, kTolerance};
  base.command(0.0);
  base.poll();
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), base.setpoint.angles);
}

/// Sideways, while the wheels still roll without being commanded to.
class SteeredRolling : public ::testing::Test {
 protected:
  SteeredRolling() {
    base_.drives.wheels_turn = true;
    base_.drives.wheel_speed = 0.2;
    base_.command(0.0, 0.0, 0.4);
  }
  /// Cycles in which its wheels are not steered; each time they have become slower by `per_second`.
  int cyclesUntilItSteers(double per_second = 0.0) {
    for (int i = 0; i < 1000; ++i) {
      if (std::abs(base_.poll().angles[0]) > 1.0) return i;
      base_.drives.wheel_speed -= per_second * toSeconds(kCycle);
    }
    return -1;
  }

  Base base_;
};

// Down a ramp of 900 s.
TEST_F(SteeredRolling, WaitsWhileTheyGetSlower) {
  EXPECT_EQ(-1, cyclesUntilItSteers(1.0 / 900.0));
}

TEST_F(SteeredRolling, WaitsASecondForWheelsThatGetNoSlower) {
  EXPECT_EQ(100, cyclesUntilItSteers());
}

// They have stood between: that second begins anew.
TEST_F(SteeredRolling, WaitsAnewForWheelsThatTurnAgain) {
  base_.run(0.6);
  base_.command(0.0);
  base_.drives.wheels_turn = false;
  base_.poll();
  base_.drives.wheels_turn = true;
  base_.command(0.0, 0.0, 0.4);
  EXPECT_EQ(100, cyclesUntilItSteers());
}

// How they rolled before says nothing of how they roll now: pushed, or on a slope, while it was disabled.
TEST_F(SteeredRolling, WaitsAnewAfterItWasDisabled) {
  base_.command(0.0);
  base_.run(1.5);
  base_.driving = false;
  base_.poll();
  base_.driving = true;
  base_.command(0.0, 0.0, 0.4);
  EXPECT_EQ(100, cyclesUntilItSteers());
}

TEST_F(SteeredRolling, WaitsAnewWhereAnAngleWasNotKnown) {
  base_.command(0.0);
  base_.run(1.5);
  base_.drives.angles[1] = std::numeric_limits<double>::quiet_NaN();
  base_.poll();
  base_.drives.angles[1] = 0.0;
  base_.command(0.0, 0.0, 0.4);
  EXPECT_EQ(100, cyclesUntilItSteers());
}

// What the wheels did while the bus cycle stood still nobody has seen: of that the second has what a ramp has.
TEST_F(SteeredRolling, WaitsOnBehindACycleThatCameLate) {
  base_.run(0.5);
  base_.now += std::chrono::seconds{2};
  EXPECT_EQ(50, cyclesUntilItSteers());
}

/// P104: the wheels turn at 1.95 rad/s or not at all, 0.195 m/s.
class SteeredMinimum : public ::testing::Test {
 protected:
  SteeredMinimum() { base_.drives.minimum.wheels = {1.95, 1.95}; }
  Base base_;
};

TEST_F(SteeredMinimum, BeginsTheRampAtStandstill) {
  base_.command(0.5);
  EXPECT_EQ(19, cyclesUntilItTurns(base_));
  base_.run(1.0);
  base_.command(0.0);
  while (base_.poll().wheels[0] != 0.0) EXPECT_GE(base_.motion.limited().linear_x, 0.195);
  base_.command(0.5);
  EXPECT_EQ(19, cyclesUntilItTurns(base_)) << "behind a rest";
}

TEST_F(SteeredMinimum, BeginsAnewWhenItWasToStandOnItsWayUp) {
  base_.command(0.5);
  base_.run(0.15);
  base_.command(0.0);
  base_.poll();
  base_.command(0.5);
  EXPECT_EQ(19, cyclesUntilItTurns(base_));
}

TEST_F(SteeredMinimum, TellsThatItRestsForIt) {
  base_.command(0.5);
  base_.poll();
  EXPECT_TRUE(base_.motion.belowMinimum()) << "on its way up";
  base_.run(1.0);
  EXPECT_FALSE(base_.motion.belowMinimum());
  base_.command(0.1);
  base_.poll();
  EXPECT_NEAR(0.49, base_.motion.limited().linear_x, 1e-9) << "left along the limits";
  EXPECT_TRUE(base_.motion.belowMinimum());
  EXPECT_FALSE(base_.motion.obeys());
  base_.run(1.0);
  EXPECT_EQ(kRest, base_.motion.limited());
  EXPECT_TRUE(base_.motion.belowMinimum());
  base_.command(0.5);
  EXPECT_EQ(19, cyclesUntilItTurns(base_)) << "what it was too slow for was no part of its ramp";
  base_.run(1.0);
  base_.command(0.0);
  while (base_.poll().wheels[0] != 0.0) continue;
  EXPECT_FALSE(base_.motion.belowMinimum()) << "nothing is commanded";
}

// Without a P104 as well: the rear wheel would stand, and the front one go on alone.
TEST(SteeredForwardOnly, RestsAsAWholeWhereAWheelCannotReverse) {
  Base base;
  base.drives.minimum = {{0.0, 0.0}, false, {0.0, 1.0}};
  base.command(0.5);
  base.run(2.0);
  EXPECT_GT(base.poll().wheels[1], 0.0);
  EXPECT_FALSE(base.motion.belowMinimum());
  base.command(-0.5);
  base.poll();
  EXPECT_NEAR(0.49, base.motion.limited().linear_x, 1e-9) << "left along the limits";
  base.run(2.0);
  EXPECT_TRUE(base.motion.belowMinimum());
  for (const double speed : base.poll().wheels) EXPECT_EQ(0.0, speed);
  EXPECT_EQ(kRest, base.motion.limited());
}

}  // namespace
}  // namespace nord_driver::cycle

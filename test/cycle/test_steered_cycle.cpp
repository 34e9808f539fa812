// A steered base in the bus cycle: what it waits for is told, and not with every command.
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/steered_cycle_bench.h"

namespace nord_driver::cycle {
namespace {

/// steeredBase() with limits of 1 m/s^2 and 1 rad/s^2.
BaseConfig rampedBase() {
  BaseConfig config = steeredBase();
  for (robot::SpeedLimits* axis : {&config.limits.linear_x, &config.limits.angular_z, &config.limits.linear_y}) {
    axis->has_acceleration_limits = true;
    axis->max_acceleration = 1.0;
  }
  return config;
}

class SteeredCycle : public ::testing::Test, protected SteeredBench {
 protected:
  explicit SteeredCycle(std::size_t velocity_window = 10) : SteeredBench{velocity_window} {}
  explicit SteeredCycle(const CycleConfig& config) : SteeredBench{config} {}
};

// It passes as soon as the wheels are steered, so that it is told after 5 s of waiting, and every 5 s then.
TEST_F(SteeredCycle, WaitingForItsAnglesIsAWarningAfterATime) {
  const Completion enabled = ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  events();
  driveSideways(500);
  EXPECT_EQ("the base waits until its wheels are steered", snapshot().base.waits.str());
  EXPECT_EQ(std::vector<std::string>{}, events());
  driveSideways(1);
  EXPECT_EQ(std::vector<std::string>{"warning: the base waits until its wheels are steered"}, events());
  driveSideways(499);
  EXPECT_EQ(std::vector<std::string>{}, events());
  driveSideways(1);
  EXPECT_EQ(std::vector<std::string>{"warning: the base waits until its wheels are steered"}, events());
}

// One wheel whose angle nobody knows: what the others measured is no motion of the base.
TEST_F(SteeredCycle, StandsStillInItsOdometryWhileAnAngleIsUnknown) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  const auto driveOn = [this](int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandBase(0.2);
      step();
    }
  };
  driveOn(100);
  const double before = snapshot().base.pose.x;
  EXPECT_GT(before, 0.05);
  EXPECT_NEAR(0.2, snapshot().base.velocity.linear_x, 0.02);
  transport.inverters[2].silent = true;
  step();
  for (int i = 0; i < 10 && snapshot().drives[2].online; ++i) step();
  const double lost = snapshot().base.pose.x;
  run(3);
  EXPECT_EQ(lost, snapshot().base.pose.x);
  EXPECT_EQ(0.0, snapshot().base.velocity.linear_x);
}

/// Axes that may leave their place by 0.05 rad, 5000 steps, before their first target; from -1.6 to 1.6 rad.
class SteeredCycleWithLimits : public SteeredCycle {
 protected:
  SteeredCycleWithLimits() : SteeredCycle{limited()} {}
  static CycleConfig limited() {
    CycleConfig config = SteeredBench::config();
    for (const std::size_t steering : {2, 3}) {
      drive::PositionConfig& axis = *config.drives[steering].drive.position;
      axis.stray = 0.05;
      axis.lower = -1.6;
      axis.upper = 1.6;
    }
    return config;
  }
};

// Nobody has asked for an angle: an axis that turns all the same is not told where it is now, but stopped.
TEST_F(SteeredCycleWithLimits, AnAxisThatLeavesItsPlaceUnaskedIsStopped) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  for (int i = 0; i < 60; ++i) {
    commandBase(0.0);
    transport.inverters[2].second = static_cast<std::int16_t>(transport.inverters[2].second + 100);
    step();
  }
  run(10);
  EXPECT_EQ(drive::StopCause::kStrayed, snapshot().drives[2].stop_cause);
  EXPECT_FALSE(snapshot().base.enabled);
  EXPECT_EQ(0x047E, controlWord(2));
  EXPECT_EQ(0x047E, controlWord(3));
}

// With a motion the angles are targets, on the way to which an axis is where it is.
TEST_F(SteeredCycleWithLimits, OneThatWasGivenAnAngleMayTurn) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  driveSideways(2);
  for (int i = 0; i < 60; ++i) {
    transport.inverters[2].second = static_cast<std::int16_t>(transport.inverters[2].second + 100);
    driveSideways(1);
  }
  EXPECT_TRUE(snapshot().base.enabled) << snapshot().base.text.c_str();
}

// It rests a step beyond the end of its range, where its rounded target was.
TEST_F(SteeredCycleWithLimits, AnAxisAtTheEndOfItsRangeIsToldNoAngleNobodyAskedFor) {
  const std::int32_t steps = -160'001;
  transport.inverters[2].second = toSigned(static_cast<Word>(static_cast<std::uint32_t>(steps) & 0xFFFF));
  transport.inverters[2].third = toSigned(static_cast<Word>(static_cast<std::uint32_t>(steps) >> 16));
  run(50);
  ASSERT_NEAR(-1.6, snapshot().drives[2].joint_position, 1e-4);
  const Completion enabled = ask(RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  events();
  run(600);
  EXPECT_EQ(std::vector<std::string>{}, events());
  EXPECT_EQ("", snapshot().base.waits.str());
}

class SteeredCycleOfALongWindow : public SteeredCycle {
 protected:
  SteeredCycleOfALongWindow() : SteeredCycle{1000} {}
};

// The mean of a window that reaches back to when it drove would be told, fresh, for as long as the run lasts.
TEST_F(SteeredCycleOfALongWindow, StandsStillInItsOdometryDuringAReferenceRun) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  for (int i = 0; i < 100; ++i) {
    commandBase(0.2);
    step();
  }
  for (int i = 0; i < 100; ++i) {
    commandBase(0.0);
    step();
  }
  ASSERT_GT(snapshot().base.velocity.linear_x, 0.01) << "the mean of all that";
  const std::uint32_t home = submit(RequestKind::kHome, 2);
  run(3);
  ASSERT_EQ(0u, completions.count(home)) << completions[home].message.c_str();
  EXPECT_EQ(0.0, snapshot().base.velocity.linear_x);
}

/// The motion of a steered base by itself: wheels at 0 rad that can turn with 10 rad/s, and a new command in each cycle.
struct SteeredRun {
  explicit SteeredRun(const BaseConfig& base = steeredBase()) : motion{base, std::chrono::milliseconds{500}} {}

  robot::SteeredSetpoint poll(double linear_x, double linear_y = 0.0) {
    now += CycleBench::kCycle;
    TwistCommand command{{}, now, true};
    command.twist.linear_x = linear_x;
    command.twist.linear_y = linear_y;
    return motion.poll(command, true, true, drives, now, CycleBench::kCycle);
  }

  SteeredMotion motion;
  SteeredDrives drives{{10.0, 10.0}, {0.0, 0.0}, {}};
  Instant now{std::chrono::hours{1}};
};

// What stands still in the setpoint may roll in fact; what goes on at the same angles need not stand.
TEST(SteeredTurn, WaitsForTheWheelsToStand) {
  SteeredRun run;
  run.drives.wheels_turn = true;
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), run.poll(0.0, 0.5).angles);
  EXPECT_EQ(SteeredWait::kAngles, run.motion.waitsFor());
  EXPECT_NEAR(5.0, run.poll(0.5, 0.0).wheels[0], 1e-9);
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), run.poll(0.0, 0.5).angles);
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), run.poll(0.0, 0.5).angles);
  run.drives.wheel_speed = 1.0;
  for (double way = 0.0; way < 1.5; way += 0.01) {
    run.drives.wheel_speed -= 0.005;
    EXPECT_NEAR(0.0, run.poll(0.5 * std::cos(way), 0.5 * std::sin(way)).angles[0], 0.05) << "nor in small steps";
  }
  run.poll(0.0, 0.0);
  run.drives.wheels_turn = false;
  EXPECT_NEAR(kQuarter, std::abs(run.poll(0.0, 0.5).angles[0]), 1e-9);
}

// On a slope a wheel may be told to turn all the time: what gets no slower for a second is not waited for any longer.
TEST(SteeredTurn, WaitsForNoWheelThatGetsNoSlower) {
  SteeredRun run;
  run.drives.wheels_turn = true;
  run.drives.wheel_speed = 0.5;
  const auto angle = [&run] { return std::abs(run.poll(0.0, 0.5).angles[0]); };
  for (; run.drives.wheel_speed > 0.02; run.drives.wheel_speed -= 0.002)
    EXPECT_EQ(0.0, angle()) << run.drives.wheel_speed;
  for (int i = 0; i < 90; ++i) EXPECT_EQ(0.0, angle()) << i;
  for (int i = 0; i < 20; ++i) angle();
  EXPECT_NEAR(kQuarter, angle(), 1e-9);
}

// A long P103: 125 s from 100 % down.
TEST(SteeredTurn, WaitsForTheWheelsAlsoDownALongRamp) {
  SteeredRun run;
  run.drives.wheels_turn = true;
  run.drives.wheel_speed = 1.0;
  for (int i = 0; i < 300; ++i, run.drives.wheel_speed -= 0.00008) {
    ASSERT_EQ(0.0, run.poll(0.0, 0.5).angles[0]) << i;
  }
}

// Wheels that stand near the edge of their tolerance hold back a curve that leads further off, and nothing else.
TEST(SteeredTurn, GoesFasterAlongTheSamePathWithWheelsThatAreALittleOff) {
  SteeredRun run;
  const auto wheel = [&run](double linear_x) { return run.poll(linear_x).wheels[0]; };
  EXPECT_NEAR(3.0, wheel(0.3), 1e-9);
  run.drives.angles = {0.045, 0.045};
  EXPECT_NEAR(5.0, wheel(0.5), 0.01);
}

// It is scaled into what its wheels can turn, and tells it.
TEST(SteeredTurn, TellsThatItIsTooFastForItsWheels) {
  SteeredRun run;
  const auto wheel = [&run](double linear_x) { return run.poll(linear_x).wheels[0]; };
  EXPECT_NEAR(10.0, wheel(2.0), 1e-9);
  EXPECT_TRUE(run.motion.beyondFull());
  EXPECT_NEAR(9.0, wheel(0.9), 1e-9);
  EXPECT_FALSE(run.motion.beyondFull());
}

// Slow, the way to another direction is a wide turn of the wheels: from its first step on the base slows down for it, and
// does not drive on first.
TEST(SteeredTurn, AWideOneIsBrakedForAtOnce) {
  SteeredRun run{rampedBase()};
  for (int i = 0; i < 50; ++i) run.poll(0.05, 0.0);
  ASSERT_NEAR(0.05, run.motion.limited().linear_x, 1e-9);
  run.poll(0.0, 0.05);
  EXPECT_NEAR(0.04, run.motion.limited().linear_x, 1e-9) << "1 m/s^2 for 10 ms";
  EXPECT_EQ(0.0, run.motion.limited().linear_y);
  EXPECT_EQ(SteeredWait::kAngles, run.motion.waitsFor());
}

// P104 > 0, from forward to backward: where it is too slow it rests, and gets faster the other way from there on. The rest of
// the ramp down is not waited for.
TEST(SteeredTurn, TheWayBackBeginsWhereItRests) {
  SteeredRun run{rampedBase()};
  run.drives.minimum.wheels = {2.0, 2.0};
  const auto wheel = [&run](double linear_x) { return run.poll(linear_x).wheels[0]; };
  for (int i = 0; i < 60; ++i) wheel(0.5);
  ASSERT_NEAR(0.5, run.motion.limited().linear_x, 1e-9);
  int at_rest = 0;
  for (int i = 0; i < 200; ++i) at_rest += wheel(-0.5) == 0.0 ? 1 : 0;
  EXPECT_NEAR(20, at_rest, 2) << "0.2 m/s at 1 m/s^2";
  EXPECT_NEAR(-0.5, run.motion.limited().linear_x, 1e-9);
}

}  // namespace
}  // namespace nord_driver::cycle

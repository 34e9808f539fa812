// P104 > 0 at wheels of a base: no wheel turns against the commanded twist, and none alone.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cycle/cycle_bench.h"
#include "cycle/minimum_speeds.h"

namespace nord_driver::cycle {
namespace {

constexpr double kFull = 157.07963267948966;  // rad/s at the joint, 50 Hz

CycleConfig acceptingMinimumFrequency(double acceleration) {
  CycleConfig config = CycleBench::config(std::nullopt, acceleration);
  for (DriveSetup& setup : config.drives) setup.drive.allow_minimum_frequency = true;
  config.drives[CycleBench::kRight].drive.joint.inverted = true;
  config.base->limits.angular_z = config.base->limits.linear_x;
  return config;
}

class BaseMinimum : public ::testing::Test, protected CycleBench {
 protected:
  explicit BaseMinimum(double acceleration = 0.0) : CycleBench(acceptingMinimumFrequency(acceleration)) {}

  /// P104 in Hz of left and right.
  void begin(double left, double right) {
    setMinimum(kLeft, left);
    setMinimum(kRight, right);
    run(80);
    ASSERT_TRUE(snapshot().drives[kLeft].device.complete);
    const Completion answer = ask(RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  void setMinimum(DriveIndex drive, double frequency) {
    transport.of_drive[drive][104] = static_cast<std::int32_t>(std::lround(10.0 * frequency));
    transport.inverters[drive].minimum = static_cast<std::int16_t>(std::lround(frequency / 50.0 * 16384.0));
  }
  bool runs(DriveIndex drive) const { return (controlWord(drive) & 0x7F) == 0x7F; }
  /// Of the joint, as commanded on the wire.
  int wire(DriveIndex drive) const { return drive == kRight ? -setpoint(drive) : setpoint(drive); }
  void expectRest() {
    for (const DriveIndex i : {kLeft, kRight}) {
      EXPECT_EQ(0x047E, controlWord(i)) << i;
      EXPECT_EQ(0, setpoint(i)) << i;
    }
    EXPECT_TRUE(snapshot().base.enabled);
    EXPECT_EQ(robot::Twist2d{}, snapshot().base.command);
  }
  void hold(double linear, double angular, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandBase(linear, angular);
      step();
    }
  }
};

// 5 Hz are 15.7 rad/s: 1.57 m/s with these wheels.
TEST_F(BaseMinimum, StraightOnTooSlowlyItRests) {
  begin(5.0, 5.0);
  hold(1.5, 0.0, 50);
  expectRest();
  EXPECT_TRUE(snapshot().drives[kLeft].saturated);
  EXPECT_TRUE(snapshot().drives[kRight].saturated);
  hold(1.6, 0.0, 50);
  EXPECT_GT(wire(kLeft), 0);
  EXPECT_GT(wire(kRight), 0);
  EXPECT_FALSE(snapshot().drives[kLeft].saturated);
}

// 50 Hz are 15.7 m/s. The base is scaled before its wheels would be: they tell that it is.
TEST_F(BaseMinimum, StraightOnTooFastItIsSaturated) {
  begin(0.0, 0.0);
  hold(31.4, 0.0, 50);
  for (const DriveIndex i : {kLeft, kRight}) {
    EXPECT_EQ(0x4000, wire(i)) << i;
    EXPECT_TRUE(snapshot().drives[i].saturated) << i;
  }
  hold(15.0, 0.0, 50);
  EXPECT_FALSE(snapshot().drives[kLeft].saturated);
  EXPECT_FALSE(snapshot().drives[kRight].saturated);
}

TEST_F(BaseMinimum, OnTheSpotTooSlowlyItRests) {
  begin(5.0, 5.0);
  hold(0.0, 6.0, 50);
  expectRest();
  hold(0.0, 6.5, 50);
  EXPECT_LT(wire(kLeft), 0);
  EXPECT_GT(wire(kRight), 0);
}

// The inner wheel would be faster than commanded, or turn backwards, or stand while the outer one goes on.
TEST_F(BaseMinimum, InACurveWithTooSlowAnInnerWheelItRests) {
  begin(5.0, 5.0);
  hold(4.0, 0.0, 50);
  ASSERT_TRUE(runs(kLeft) && runs(kRight));
  for (const double angular : {12.0, 16.0, 20.0}) {
    hold(4.0, angular, 100);
    expectRest();
  }
  hold(4.0, 8.0, 50);
  EXPECT_GT(wire(kLeft), 0);
  EXPECT_GT(wire(kRight), wire(kLeft));
}

TEST_F(BaseMinimum, OneWheelWithItIsEnough) {
  begin(0.0, 5.0);
  hold(1.5, 0.0, 50);
  EXPECT_EQ(0, setpoint(kLeft));
  EXPECT_EQ(0, setpoint(kRight));
  EXPECT_EQ(0x047F, controlWord(kLeft)) << "torque at 0 Hz, as without P104";
  EXPECT_EQ(0x047E, controlWord(kRight));
}

TEST_F(BaseMinimum, ACommandThatGrewOldIsOff1AndTheNextOneGoesOn) {
  begin(5.0, 5.0);
  hold(3.0, 0.0, 50);
  run(100);
  expectRest();
  EXPECT_FALSE(snapshot().drives[kLeft].saturated);
  hold(-3.0, 0.0, 80);
  EXPECT_LT(wire(kLeft), 0);
  EXPECT_LT(wire(kRight), 0);
  EXPECT_TRUE(ask(RequestKind::kDisable).success);
}

ScriptedTransport leftForwardOnly() {
  ScriptedTransport transport{3};
  transport.forward_only = {CycleBench::kLeft};
  return transport;
}

class BaseForwardOnly : public ::testing::TestWithParam<double> {
 protected:
  void hold(double linear, double angular, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      bench_.commandBase(linear, angular);
      bench_.step();
    }
  }

  CycleBench bench_{acceptingMinimumFrequency(GetParam()), leftForwardOnly()};
};

// P104 is 0. Told to reverse, the left wheel would stand under the torque of 0 Hz, and the right one alone turn the base about it.
TEST_P(BaseForwardOnly, RestsAsAWholeWhereAWheelCannotReverse) {
  bench_.run(80);
  ASSERT_TRUE(bench_.ask(RequestKind::kEnable).success);
  for (const double angular : {0.0, 16.0, 8.0}) {
    hold(4.0, 0.0, 100);
    ASSERT_GT(bench_.setpoint(CycleBench::kLeft), 0);
    EXPECT_FALSE(bench_.snapshot().drives[CycleBench::kLeft].saturated);
    hold(angular == 16.0 ? 0.0 : -4.0, angular, 100);
    for (const DriveIndex i : {CycleBench::kLeft, CycleBench::kRight}) {
      EXPECT_EQ(0, bench_.setpoint(i)) << angular;
      EXPECT_EQ(0x047F, bench_.controlWord(i)) << "torque at 0 Hz";
      EXPECT_TRUE(bench_.snapshot().drives[i].saturated) << angular;
    }
    EXPECT_EQ(robot::Twist2d{}, bench_.snapshot().base.command);
    EXPECT_TRUE(bench_.snapshot().base.enabled);
  }
}

// 0.583 m/s - 0.265 m * 2.2 rad/s is a little less than 0 in doubles.
TEST(BaseForwardOnlyRounding, ItTurnsAboutAWheelThatIsCommandedToStand) {
  CycleConfig config = acceptingMinimumFrequency(0.0);
  config.base->geometry.wheel_separation = 0.53;
  CycleBench bench{config, leftForwardOnly()};
  bench.run(80);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 20; ++i) {
    bench.commandBase(0.583, 2.2);
    bench.step();
  }
  ASSERT_LT(0.583 - 2.2 * 0.53 / 2.0, 0.0);
  EXPECT_EQ(0, bench.setpoint(CycleBench::kLeft));
  EXPECT_LT(bench.setpoint(CycleBench::kRight), 0);
  EXPECT_FALSE(bench.snapshot().drives[CycleBench::kLeft].saturated);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutRamps, BaseForwardOnly, ::testing::Values(0.0, 10.0));

class BaseMinimumWithRamps : public BaseMinimum {
 protected:
  BaseMinimumWithRamps() : BaseMinimum(10.0) {}
};

// Until every wheel is fast enough the base rests, and it goes on along its ramp from there.
TEST_F(BaseMinimumWithRamps, TheRampGoesOnFromWhereTheWheelsAreFastEnough) {
  begin(5.0, 5.0);
  int rested = 0;
  for (int i = 0; i < 60; ++i) {
    commandBase(4.0);
    step();
    const double before = snapshot().base.command.linear_x;
    if (before == 0.0) {
      ++rested;
      ASSERT_EQ(0, setpoint(kLeft));
    } else {
      ASSERT_GE(before, 1.57);
      ASSERT_LE(before, 0.1 * (i + 1) + 1e-9);
    }
  }
  EXPECT_GE(rested, 15);
  EXPECT_DOUBLE_EQ(4.0, snapshot().base.command.linear_x);
  // And down again.
  for (int i = 0; i < 40; ++i) {
    commandBase(0.0);
    step();
    const double now = snapshot().base.command.linear_x;
    ASSERT_TRUE(now == 0.0 || now >= 1.57) << now;
  }
  expectRest();
}

// While a wheel comes to rest by OFF1 it follows nothing: the ramp begins where it rests, and is no jump.
TEST_F(BaseMinimumWithRamps, TheRampWaitsForAWheelThatComesToRest) {
  begin(5.0, 5.0);
  hold(4.0, 0.0, 60);
  ASSERT_DOUBLE_EQ(4.0, snapshot().base.command.linear_x);
  transport.inverters[kLeft].ramp = 16;  // a longer P103
  hold(0.0, 0.0, 40);
  ASSERT_EQ(0x047E, controlWord(kLeft));
  int waits = 0;
  while (controlWord(kLeft) == 0x047E && waits < 300) {
    commandBase(4.0);
    step();
    ++waits;
  }
  EXPECT_GT(waits, 60) << "P103 takes longer than the limit";
  EXPECT_LT(snapshot().base.command.linear_x, 2.0) << "10 m/s^2, from where it rests";
}

// Whatever is commanded, for whatever P104: the signs on the wire are those of the twist, and no wheel turns by its
// P104.
TEST(BaseMinimumProperty, NoWheelTurnsAgainstTheTwistOrAlone) {
  std::mt19937 random{10};
  const auto pick = [&random](std::initializer_list<double> values) {
    return *(values.begin() + std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random));
  };
  std::uniform_real_distribution<double> any{-1.0, 1.0};
  int moved = 0, reversed = 0, rested = 0;
  for (int universe = 0; universe < 60; ++universe) {
    CycleBench bench{acceptingMinimumFrequency(pick({0.0, 5.0, 30.0}))};
    double minimum[2] = {};
    for (const DriveIndex i : {CycleBench::kLeft, CycleBench::kRight}) {
      minimum[i] = pick({0.0, 2.0, 5.0, 5.0, 10.0});
      bench.transport.of_drive[i][104] = static_cast<std::int32_t>(std::lround(10.0 * minimum[i]));
      bench.transport.inverters[i].minimum = static_cast<std::int16_t>(std::lround(minimum[i] / 50.0 * 16384.0));
    }
    bench.run(80);
    ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
    double linear = 0.0, angular = 0.0;
    bool silent = false;
    int last_sign = 0;
    int before[2] = {};
    for (int cycle = 0; cycle < 600; ++cycle) {
      if (cycle % 40 == 0) {
        linear = pick({0.0, 1.0, 2.0, 5.0, 10.0}) * any(random);
        angular = pick({0.0, 0.0, 4.0, 10.0, 40.0}) * any(random);
        silent = pick({0.0, 0.0, 0.0, 1.0}) > 0.0;
      }
      if (!silent) bench.commandBase(linear, angular);
      bench.step();
      const robot::Twist2d twist = bench.snapshot().base.command;
      ASSERT_TRUE(bench.snapshot().base.enabled) << bench.snapshot().base.text.c_str();
      const double wanted[2] = {(twist.linear_x - 0.25 * twist.angular_z) / 0.1,
                                (twist.linear_x + 0.25 * twist.angular_z) / 0.1};
      const bool moves = bench.setpoint(0) != 0 || bench.setpoint(1) != 0;
      for (const DriveIndex i : {CycleBench::kLeft, CycleBench::kRight}) {
        const int wire = i == CycleBench::kRight ? -bench.setpoint(i) : bench.setpoint(i);
        ASSERT_NEAR(wanted[i] / kFull * 16384.0, wire, 1.0) << "universe " << universe << ", cycle " << cycle;
        if (minimum[i] == 0.0) continue;
        const bool runs = (bench.controlWord(i) & 0x7F) == 0x7F;
        ASSERT_EQ(moves, runs) << "universe " << universe << ", cycle " << cycle << ", wheel " << i;
        if (runs) {
          ASSERT_GE(std::abs(wire) + 1, minimum[i] / 50.0 * 16384.0);
        }
        // Reversed at speed, it comes down first.
        const int frequency = bench.transport.inverters[i].frequency();
        const bool slower = std::abs(frequency) < std::abs(before[i]);
        ASSERT_TRUE(slower || frequency * bench.setpoint(i) >= 0)
            << "it turns against its setpoint, universe " << universe << ", cycle " << cycle;
        before[i] = frequency;
      }
      moved += moves ? 1 : 0;
      rested += !moves && (linear != 0.0 || angular != 0.0) ? 1 : 0;
      const int sign = (bench.setpoint(0) > 0) - (bench.setpoint(0) < 0);
      if (sign != 0 && last_sign != 0 && sign != last_sign) ++reversed;
      if (sign != 0) last_sign = sign;
    }
  }
  EXPECT_GT(moved, 3000);
  EXPECT_GT(rested, 3000);
  EXPECT_GT(reversed, 50);
}

// P104 itself is not below it; a wheel that is to stand beside one that turns is. Of wheels without a P104 nothing is asked.
TEST(MinimumSpeedsTest, AskEachWheelThatIsToTurn) {
  const MinimumSpeeds minimum{{2.0, 2.0}};
  EXPECT_FALSE(anyBelow({2.0, -2.0}, minimum));
  EXPECT_TRUE(anyBelow({5.0, 1.999}, minimum));
  EXPECT_TRUE(anyBelow({-1.999, 5.0}, minimum));
  EXPECT_TRUE(anyBelow({0.0, 5.0}, minimum));
  EXPECT_FALSE(anyBelow({0.0, 0.0}, minimum));
  EXPECT_FALSE(anyBelow({1.0, 1.0}, {}));
  EXPECT_FALSE(anyBelow({5.0, 1.0}, {{2.0}}));
  EXPECT_FALSE(anyBelow({0.001, 5.0}, {{0.0, 2.0}}));
  EXPECT_FALSE(anyBelow({5.0}, {{2.0, 2.0}}));
}

// It would be commanded 0 and turn at its P104; without a P104 it stands, and the other one alone would turn the base.
TEST(MinimumSpeedsTest, AWheelThatCannotTurnThatWayIsBelow) {
  const MinimumSpeeds minimum{{2.0, 2.0}, false, {1.0, -1.0}};
  EXPECT_FALSE(anyBelow({5.0, -5.0}, minimum));
  EXPECT_TRUE(anyBelow({5.0, 5.0}, minimum));
  EXPECT_TRUE(anyBelow({-5.0, -5.0}, minimum));
  EXPECT_FALSE(anyBelow({0.0, 0.0}, minimum));
  EXPECT_FALSE(anyBelow({5.0, -5.0}, {{2.0, 2.0}, false, {1.0}}));
  const MinimumSpeeds none{{0.0, 0.0}, false, {1.0, -1.0}};
  EXPECT_FALSE(anyBelow({5.0, -0.001}, none));
  EXPECT_TRUE(anyBelow({-5.0, -5.0}, none));
  EXPECT_TRUE(anyBelow({5.0, 0.001}, none));
  EXPECT_FALSE(anyBelow({5.0, 1e-12}, none)) << "rounding: it stands, as commanded";
  EXPECT_TRUE(anyBelow({5.0, 5.0}, {{}, false, {1.0, -1.0}}));
}

}  // namespace
}  // namespace nord_driver::cycle

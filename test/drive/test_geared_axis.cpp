// A lift on a spindle: what is 1 in most tests of drives that position, is not here, and each number has one right place.
#include <gtest/gtest.h>

#include <cmath>

#include "drive/drive.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = seconds(0.01);

/// The spindle has a lead of 0.1 m, the motor turns 20 times as fast as it does, the encoder 4 times. The drive counts 0
/// where the lift stands at 0.5 m, and 40 000 steps for a metre.
class GearedAxis : public ::testing::Test {
 protected:
  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 20.0;
    result.joint.pole_pairs = 2;  // 50 Hz are 25 motor turns a second, 1.25 of the spindle, 0.125 m/s
    result.max_frequency[0] = Hertz{50.0};
    PositionConfig position;
    position.scale.revolutions_per_unit = 40.0;
    position.scale.offset = 0.5;
    position.unit_per_radian = 0.1 / 6.283185307179586;
    position.revolutions_per_motor_turn = 0.2;
    position.lower = 1.0;
    position.upper = 3.0;
    position.tolerance = 0.005;
    position.stray = 0.1;
    result.position = position;
    return result;
  }
  GearedAxis() { withFrequency(); }
  /// All three words: frequency, low word, high word.
  void withFrequency() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
    first_ = 1;
  }
  void withoutFrequency() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {21, 22, 0}, {10, 15, 0}, 2));
    first_ = 0;
  }
  /// Without a frequency, and with an encoder that turns once while the motor turns so many times.
  void makeCoarse(double turns) {
    DriveConfig coarse = config();
    coarse.position->revolutions_per_motor_turn = 1.0 / turns;
    drive_ = Drive{coarse};
    withoutFrequency();
  }
  void cycle(Word status_word, std::int32_t steps) {
    sent_ = drive_.pollOutput(now_);
    velocity_sent_ = report().velocity_command.value;
    now_ += kCycle;
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values[first_] = toSigned(static_cast<Word>(steps & 0xFFFF));
    input.actual_values[first_ + 1] = toSigned(static_cast<Word>(static_cast<std::uint32_t>(steps) >> 16));
    drive_.handleInput(input, true, now_);
  }
  void start(std::int32_t steps) {
    for (int i = 0; i < 6; ++i) cycle(0x0B31, steps);
    ASSERT_TRUE(report().position.position);
  }
  void enable(std::int32_t steps) {
    start(steps);
    drive_.requestEnable(now_);
    cycle(0x0B31, steps);
    cycle(0x0B37, steps);
    ASSERT_EQ(Phase::kEnabled, report().phase);
  }
  /// Of a reference run, from the end of its search to its own.
  int cyclesOfQuiet() {
    enable(600);
    drive_.requestHoming(now_, 1);
    for (int i = 0; i < 60; ++i) cycle(0x0B37, 600);
    cycle(0x0A37, 600);
    int cycles = 0;
    for (; cycles < 100 && report().homing.state == RequestState::kRunning; ++cycles) cycle(0x0B37, 600);
    return report().homing.state == RequestState::kDone ? cycles : 0;
  }
  std::int32_t target() const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(toWord(sent_.setpoints[first_ + 1])) << 16 |
                                     toWord(sent_.setpoints[first_]));
  }
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  std::size_t first_ = 1;  // the low word
  profile::ProcessOutput sent_;
  double velocity_sent_ = 0.0;
  Instant now_{std::chrono::hours{1}};
};

TEST_F(GearedAxis, IsHeldWhereItStandsAndGoesToItsTargetInItsOwnSteps) {
  start(60'000);
  EXPECT_NEAR(2.0, report().position.position.value_or(0.0), 1e-9);
  EXPECT_EQ(60'000, target());
  enable(60'000);
  EXPECT_EQ(60'000, target());
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(2.25));
  cycle(0x0A37, 60'000);
  EXPECT_EQ(70'000, target());
}

TEST_F(GearedAxis, TravelsAtP105InMetresASecond) {
  enable(60'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(2.25));
  cycle(0x0A37, 60'000);
  EXPECT_EQ(16'384, sent_.setpoints[0]);
  EXPECT_NEAR(0.125, velocity_sent_, 1e-9);
}

// Half of P105: 12.5 turns of the motor, 2.5 of the encoder, 2500 steps a second.
TEST_F(GearedAxis, TellsItsSpeedByItsCount) {
  withoutFrequency();
  for (int i = 0; i < 60; ++i) cycle(0x0B31, 60'000 + 25 * i);
  EXPECT_NEAR(8192, report().speed, 5);
  EXPECT_NEAR(0.0625, report().velocity.value, 1e-4);
  EXPECT_NEAR(25.0, report().frequency.value, 0.05);
}

// 25 turns a second of the motor are 5000 steps; half as much again in 60 ms, and 20 steps: 470.
TEST_F(GearedAxis, DoubtsWhatItsMotorCannotHaveDone) {
  start(60'000);
  cycle(0x0B31, 60'470);
  EXPECT_FALSE(report().position.held_back);
  cycle(0x0B31, 60'470 + 471);
  EXPECT_TRUE(report().position.held_back);
  EXPECT_NEAR(2.01175, report().position.position.value_or(0.0), 1e-9) << "the one before is told";
}

// As near as what counts as reached: 5 mm, on both sides of each limit.
TEST_F(GearedAxis, IsAtALimitWithinItsTolerance) {
  const auto isAtLimit = [this](double joint) {
    for (int i = 0; i < 20; ++i) cycle(0x0B31, static_cast<std::int32_t>(std::lround((joint - 0.5) * 40'000.0)));
    EXPECT_NEAR(joint, report().position.position.value_or(0.0), 1e-9);
    return report().position.at_limit;
  };
  EXPECT_TRUE(isAtLimit(0.99));
  EXPECT_TRUE(isAtLimit(1.004));
  EXPECT_FALSE(isAtLimit(1.006));
  EXPECT_FALSE(isAtLimit(2.994));
  EXPECT_TRUE(isAtLimit(2.996));
  EXPECT_TRUE(isAtLimit(3.01));
}

// Where it is held it must stay; where it is told to go, it goes.
TEST_F(GearedAxis, DoesNotStrayOnTheWayToATarget) {
  enable(60'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(2.25));
  for (std::int32_t at = 60'000; at <= 70'000; at += 50) {
    cycle(0x0A37, at);
    ASSERT_EQ(Phase::kEnabled, report().phase) << at;
  }
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// The encoder turns once while the motor turns 50 times: 500 steps a second at P105, 5 % for each step in 40 ms.
TEST_F(GearedAxis, ACoarseCountThatFlickersStands) {
  makeCoarse(50.0);
  for (const int period : {1, 3, 5, 30}) {
    for (int i = 0; i < 300; ++i) {
      cycle(0x0B31, 600 + i / period % 2);
      ASSERT_TRUE(drive_.isNearStandstill()) << period << ", " << i;
      ASSERT_FALSE(report().direction_contradiction) << period << ", " << i;
    }
  }
}

TEST_F(GearedAxis, ACoarseCountThatFlickersBeginsNoReferenceRun) {
  makeCoarse(50.0);
  enable(600);
  drive_.requestHoming(now_, 1);
  for (int i = 0; i < 300; ++i) {
    cycle(0x0B37, 600 + i / 30 % 2);
    ASSERT_EQ(RequestState::kRunning, report().homing.state) << i;
  }
}

// What its speed is told over is half a second: it has to be quiet for as long.
TEST_F(GearedAxis, AReferenceRunOfACoarseCountIsQuietForAWindow) {
  makeCoarse(125.0);
  EXPECT_EQ(51, cyclesOfQuiet());
}

TEST_F(GearedAxis, AReferenceRunIsQuietFor200MsWhereAWordTellsItsSpeed) {
  makeCoarse(125.0);
  withFrequency();
  EXPECT_EQ(21, cyclesOfQuiet());
}

TEST_F(GearedAxis, TellsWhichTargetItRefused) {
  enable(60'000);
  EXPECT_EQ(TargetRefusal::kAboveLimit, drive_.setPosition(3.125));
  EXPECT_EQ(TargetRefusal::kAboveLimit, report().position.refused);
  EXPECT_EQ(3.125, report().position.refused_target);
}

}  // namespace
}  // namespace nord_driver::drive

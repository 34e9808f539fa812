// A drive that positions: what it is sent in every phase, and what of its targets is left after a stop.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "drive/drive.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = seconds(0.01);

/// SK 53xE, P546 to P548 = 1, 21, 22 and P543 to P545 = 1, 10, 15 (BU 0020 7.3.5): frequency, low word, high word. 1 rad
/// of the joint is a revolution of the count.
class PositionDrive : public ::testing::Test {
 protected:
  static DriveConfig config() {
    DriveConfig result;
    result.joint.gear_ratio = 1.0;
    result.max_frequency[0] = Hertz{50.0};
    result.drive_timeout = seconds(0.05);
    result.enable_timeout = seconds(0.5);
    result.shutdown_timeout = seconds(1.0);
    PositionConfig position;
    position.lower = -100.0;
    position.upper = 200.0;
    position.tolerance = 0.005;
    position.speed = RadPerSec{78.5398163397448};  // 25 Hz, half of P105
    result.position = position;
    return result;
  }
  PositionDrive() {
    drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  }

  /// One cycle with an answer, in which the axis stands at `steps`: returns the control word that was sent.
  Word cycle(Word status_word, std::int32_t steps, std::int16_t frequency = 0) {
    const Word word = send();
    profile::ProcessInput input;
    input.status_word = status_word;
    input.actual_values = {frequency, toSigned(static_cast<Word>(steps & 0xFFFF)),
                           toSigned(static_cast<Word>(static_cast<std::uint32_t>(steps) >> 16))};
    drive_.handleInput(input, true, now_);
    return word;
  }
  Word silence() {
    const Word word = send();
    drive_.handleInput({}, false, now_);
    return word;
  }
  Word send() {
    const profile::ProcessOutput output = drive_.pollOutput(now_);
    now_ += kCycle;
    sent_ = output;
    return output.control_word;
  }
  /// As sent last; both words together.
  std::int32_t target() const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(toWord(sent_.setpoints[2])) << 16 |
                                     toWord(sent_.setpoints[1]));
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
  const DriveReport& report() const { return drive_.report(); }

  Drive drive_{config()};
  profile::ProcessOutput sent_;
  Instant now_{std::chrono::hours{1}};
};

TEST_F(PositionDrive, TellsItsPositionAlsoWhenItIsNotEnabled) {
  start(12'345);
  EXPECT_NEAR(12.345, report().position.position.value_or(0.0), 1e-9);
  EXPECT_FALSE(report().position.target);
  EXPECT_EQ(0x047E, cycle(0x0B31, 12'345));
  EXPECT_EQ(12'345, target()) << "should anybody enable it, it stays where it is";
  EXPECT_EQ(0, sent_.setpoints[0]);
}

// The literal telegram of a hold and of a target: 047F, half of P105, low word, high word.
TEST_F(PositionDrive, HoldsWhenItIsEnabledAndThenGoesToItsTarget) {
  start(70'000);
  drive_.requestEnable(now_);
  EXPECT_EQ(0x047E, cycle(0x0B31, 70'003));
  EXPECT_EQ(0x047F, cycle(0x0B33, 69'990)) << "it sags a little while its brake opens";
  EXPECT_EQ(70'003, target());
  EXPECT_EQ(0x047F, cycle(0x0B37, 69'980));
  EXPECT_EQ(70'003, target()) << "it is held where it was";
  EXPECT_EQ(Phase::kEnabled, report().phase);
  EXPECT_EQ(TargetRefusal::kNone, drive_.setPosition(100.0));
  EXPECT_EQ(0x047F, cycle(0x0A37, 70'050));
  EXPECT_EQ(0x2000, sent_.setpoints[0]);
  EXPECT_EQ(toSigned(0x86A0), sent_.setpoints[1]);
  EXPECT_EQ(0x0001, sent_.setpoints[2]);
  EXPECT_FALSE(report().position.reached);
  cycle(0x0B37, 70'060);
  EXPECT_FALSE(report().position.reached) << "the bit is of the target before";
  for (std::int32_t at = 70'100; at < 100'000; at += 250) cycle(0x0A37, at);
  cycle(0x0B37, 99'998);
  EXPECT_TRUE(report().position.reached);
}

TEST_F(PositionDrive, RefusesTargetsInWords) {
  start(0);
  EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.setPosition(1.0));
  enable(0);
  EXPECT_EQ(TargetRefusal::kAboveLimit, drive_.setPosition(200.001));
  EXPECT_EQ(TargetRefusal::kBelowLimit, drive_.setPosition(-100.001));
  EXPECT_EQ(TargetRefusal::kNotFinite, drive_.setPosition(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(TargetRefusal::kNotFinite, drive_.setPosition(std::numeric_limits<double>::infinity()));
  cycle(0x0B37, 0);
  EXPECT_EQ(0, target()) << "what is refused changes nothing";
  EXPECT_EQ(TargetRefusal::kNotFinite, report().position.refused);
  EXPECT_EQ(TargetRefusal::kNone, drive_.setPosition(200.0));
  cycle(0x0A37, 0);
  EXPECT_EQ(TargetRefusal::kNone, report().position.refused);
  EXPECT_EQ(200'000, target());
}

TEST_F(PositionDrive, ForgetsItsTargetWithEveryStop) {
  const auto go = [&](std::int32_t from) {
    enable(from);
    ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(150.0));
    cycle(0x0A37, from);
    ASSERT_EQ(150'000, target());
  };
  const auto expectHeldAfterwards = [&](std::int32_t at, const char* cause) {
    for (int i = 0; i < 5; ++i) {
      cycle(0x0B31, at);
      ASSERT_NE(150'000, target()) << cause;
    }
    ASSERT_EQ(at, target()) << cause;
    drive_.requestAcknowledge(now_);
    enable(at);
    for (int i = 0; i < 20; ++i) {
      ASSERT_EQ(0x047F, cycle(0x0B37, at)) << cause;
      ASSERT_EQ(at, target()) << cause;
    }
    drive_.requestShutdown(now_);
    for (int i = 0; i < 3; ++i) cycle(0x0B31, at);
    ASSERT_EQ(Phase::kIdle, report().phase) << cause;
  };
  go(0);
  drive_.requestShutdown(now_);
  EXPECT_EQ(0x047E, cycle(0x0A37, 200));
  expectHeldAfterwards(300, "enable false");
  go(300);
  drive_.requestQuickStop(now_);
  EXPECT_EQ(0x047B, cycle(0x0A17, 400));
  cycle(0x0B50, 450);
  expectHeldAfterwards(450, "quick stop");
  go(450);
  cycle(0x0A38, 500);
  EXPECT_EQ(0x047E, cycle(0x0A38, 500));
  cycle(0x0B50, 500);
  expectHeldAfterwards(500, "fault");
  go(500);
  cycle(0x0837, 550);
  EXPECT_EQ(0x047E, cycle(0x0831, 550));
  expectHeldAfterwards(550, "local control");
  go(550);
  for (int i = 0; i < 10; ++i) silence();
  EXPECT_FALSE(report().online);
  EXPECT_FALSE(report().position.position) << "nobody knows where it is";
  expectHeldAfterwards(700, "silence");
}

// OFF1 from the first word on: with a target it would still go there at setpoint 0.
TEST_F(PositionDrive, ComesToRestByOff1WhereAVelocityWouldBeZero) {
  enable(0);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(150.0));
  cycle(0x0A37, 10);
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(Phase::kStopping, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0A37, 30));
}

TEST_F(PositionDrive, IsNotEnabledBeforeItsPositionIsKnown) {
  cycle(0x0B31, 5);
  EXPECT_EQ(Refusal::kPositionUnknown, drive_.enableRefusal());
  start(5);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
  drive_.setPositionWords(1, {});
  EXPECT_EQ(Refusal::kPositionUnknown, drive_.enableRefusal());
}

// 16 bits: continued past its border, it is where no setpoint can hold it. Sent as it is, it would go 65.536 revolutions.
TEST_F(PositionDrive, IsNotEnabledWhereItsWordsCannotHoldIt) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 0}, {1, 10, 0}, 3));
  for (std::int32_t at = 32'700; at < 32'760; at += 5) cycle(0x0B31, at);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
  for (std::int32_t at = 32'760; at < 32'780; at += 5) cycle(0x0B31, at);
  EXPECT_NEAR(32.775, report().position.position.value_or(0.0), 1e-9);
  EXPECT_EQ(Refusal::kPositionBeyondRange, drive_.enableRefusal());
}

// Enabling, it sags over the border of its 16 bits: 0 in the words would be 32 revolutions away.
TEST_F(PositionDrive, IsHeldAtTheBorderOfItsWords) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 0}, {1, 10, 0}, 3));
  for (int i = 0; i < 10; ++i) cycle(0x0B31, 32'765);
  drive_.requestEnable(now_);
  EXPECT_EQ(0x047E, cycle(0x0B31, 32'770));
  EXPECT_EQ(0x047F, cycle(0x0B33, 32'770));
  EXPECT_EQ(32'767, sent_.setpoints[1]);
}

// Somebody sets the count to zero while it is enabled: the target is somewhere else now.
TEST_F(PositionDrive, StopsWhenItsCountGetsANewZero) {
  enable(90'000);
  for (int i = 0; i < 30 && report().phase == Phase::kEnabled; ++i) cycle(0x0B37, 0);
  EXPECT_EQ(StopCause::kPositionJump, report().stop_cause);
  EXPECT_EQ(0x047E, send());
}

// In the cycle a reference run ends in, its asker is answered: a target that comes with the next one is gone to.
TEST_F(PositionDrive, TakesATargetRightAfterAReferenceRun) {
  enable(5'000);
  drive_.requestHoming(now_);
  cycle(0x0B37, 5'000);
  for (int i = 0; i < 5; ++i) cycle(0x0A37, 5'000 - 50 * i, -200);
  for (int i = 0; i < 60 && report().homing.state == RequestState::kRunning; ++i) cycle(0x0B37, 4'700);
  ASSERT_EQ(RequestState::kDone, report().homing.state);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(8.0));
  cycle(0x0B37, 4'700);
  EXPECT_EQ(8'000, target());
}

// What was low before is no sign that the run has begun.
TEST_F(PositionDrive, AReferenceRunBeginsAtStandstill) {
  enable(5'000);
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(50.0));
  for (int i = 0; i < 5; ++i) cycle(0x0A37, 5'000 + 100 * i, 3'000);
  drive_.requestHoming(now_, 7);
  EXPECT_EQ(RequestState::kRefused, report().homing.state);
  EXPECT_EQ(Refusal::kHomingTurning, report().homing.refusal);
  EXPECT_FALSE(report().position.homing);
}

TEST_F(PositionDrive, AReferenceRunHasNotBegunByABit8ThatWasLowBefore) {
  enable(5'000);
  cycle(0x0A37, 5'000);
  drive_.requestHoming(now_, 7);
  for (int i = 0; i < 5; ++i) cycle(0x0A37, 5'000);
  for (int i = 0; i < 60; ++i) cycle(0x0B37, 5'000);
  EXPECT_EQ(RequestState::kRunning, report().homing.state);
}

// What an earlier run has found does not count while another one looks for it; nor is that one begun a second time.
TEST_F(PositionDrive, IsNotHomedWhileAReferenceRunGoesOn) {
  enable(5'000);
  drive_.requestHoming(now_, 7);
  for (int i = 0; i < 5; ++i) cycle(0x0A37, 5'000 - 50 * i, -200);
  for (int i = 0; i < 60 && report().homing.state == RequestState::kRunning; ++i) cycle(0x0B37, 4'750);
  ASSERT_EQ(RequestState::kDone, report().homing.state);
  EXPECT_TRUE(report().position.homed);
  drive_.requestHoming(now_, 8);
  cycle(0x0B37, 4'750);
  EXPECT_TRUE(report().position.homing);
  EXPECT_FALSE(report().position.homed);
  drive_.requestHoming(now_, 9);
  EXPECT_EQ(8u, report().homing.token);
  EXPECT_EQ(RequestState::kRunning, report().homing.state);
}

TEST(HeldPosition, ADriveThatFollowsVelocitiesHasNoReferenceRun) {
  Drive drive{DriveConfig{}};
  drive.requestHoming(Instant{}, 7);
  EXPECT_EQ(RequestState::kNone, drive.report().homing.state);
}

// 16 bits: 40 revolutions before the switch it counts on, and gets its zero there.
TEST_F(PositionDrive, IsHeldWhereAReferenceRunOf16BitsEnds) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 0}, {1, 10, 0}, 3));
  enable(32'000);
  drive_.requestHoming(now_);
  cycle(0x0B37, 32'000);
  for (std::int32_t steps = 32'000; steps < 40'000; steps += 200) cycle(0x0A37, steps, 3'000);
  for (int i = 0; i < 60 && report().homing.state == RequestState::kRunning; ++i) cycle(0x0B37, 0);
  ASSERT_EQ(RequestState::kDone, report().homing.state);
  EXPECT_NEAR(0.0, report().position.position.value_or(99.0), 1e-9);
  cycle(0x0B37, 0);
  EXPECT_EQ(0, sent_.setpoints[1]) << "the way to 32.767 is 32 revolutions long";
}

// A count that has just been set anew elsewhere: what it was is not where it is to be held.
TEST_F(PositionDrive, IsNotEnabledWhileItsPositionIsInDoubt) {
  start(5'000);
  cycle(0x0B31, 0);
  EXPECT_EQ(Refusal::kPositionUnknown, drive_.enableRefusal());
  for (int i = 0; i < 15; ++i) cycle(0x0B31, 0);
  ASSERT_EQ(Refusal::kNone, drive_.enableRefusal());
  drive_.requestEnable(now_);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(0x047E, cycle(0x0B31, 90'000)) << "in doubt again";
}

// Where the two count different steps, it goes away from where it is to be held.
TEST(HeldPosition, WhatDoesNotStayWhereItIsHeldIsStopped) {
  DriveConfig config;
  config.max_frequency[0] = Hertz{50.0};
  config.position = PositionConfig{};
  config.position->stray = 0.25;
  Drive drive{config};
  drive.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  Instant now{};
  const auto cycle = [&](Word status, std::int16_t steps) {
    const Word word = drive.pollOutput(now).control_word;
    now += kCycle;
    profile::ProcessInput input;
    input.status_word = status;
    input.actual_values = {0, steps, 0};
    drive.handleInput(input, true, now);
    return word;
  };
  for (int i = 0; i < 6; ++i) cycle(0x0B31, 5'000);
  drive.requestEnable(now);
  cycle(0x0B31, 5'000);
  cycle(0x0B37, 5'000);
  ASSERT_EQ(Phase::kEnabled, drive.report().phase);
  cycle(0x0A37, 5'200);
  EXPECT_EQ(0x047F, cycle(0x0A37, 5'240)) << "a load that settles";
  cycle(0x0A37, 5'260);
  EXPECT_EQ(StopCause::kStrayed, drive.report().stop_cause);
  EXPECT_EQ(0x047E, cycle(0x0A37, 5'260));
}

TEST_F(PositionDrive, TellsItsSpeedWhereNoWordCarriesIt) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {21, 22, 0}, {10, 15, 0}, 2));
  const auto at = [&](std::int32_t steps) {
    send();
    profile::ProcessInput input;
    input.status_word = 0x0B31;
    input.actual_values = {toSigned(static_cast<Word>(steps & 0xFFFF)), toSigned(static_cast<Word>(steps >> 16)), 0};
    drive_.handleInput(input, true, now_);
  };
  at(0);
  ASSERT_FALSE(report().position.position);
  EXPECT_EQ(0, report().speed) << "nobody knows";
  for (int i = 0; i < 60; ++i) at(125 * i);  // 12.5 rev/s: 25 Hz, half of P105
  EXPECT_NEAR(8192, report().speed, 5);
  EXPECT_FALSE(drive_.isNearStandstill());
  for (int i = 0; i < 20; ++i) at(7375);
  EXPECT_TRUE(drive_.isNearStandstill());
}

}  // namespace
}  // namespace nord_driver::drive

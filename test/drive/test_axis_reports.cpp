// A drive that positions: what it says to targets and requests it cannot follow, and what is forgotten when.
#include <gtest/gtest.h>

#include "drive/axis_at_rest.h"
#include "drive/drive_group.h"

namespace nord_driver::drive {
namespace {

class AxisReports : public AxisAtRest {
 protected:
  void enable() {
    start();
    drive_.requestEnable(now_);
    cycle();
    cycle(0x0B37);
    ASSERT_EQ(Phase::kEnabled, report().phase);
  }
  void change(const DriveConfig& config) {
    drive_ = Drive{config};
    setWords();
  }
};

TEST_F(AxisReports, AnIncrementIsAddedToItsTarget) {
  enable();
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(5.0));
  ASSERT_EQ(TargetRefusal::kNone, drive_.movePosition(1.5));
  cycle(0x0A37);
  EXPECT_EQ(6.5, report().position.target);
  ASSERT_EQ(TargetRefusal::kNone, drive_.movePosition(-2.0));
  cycle(0x0A37);
  EXPECT_EQ(4.5, report().position.target);
  drive_.requestShutdown(now_);
  cycle(0x0A37);
  EXPECT_FALSE(report().position.target) << "it is forgotten with the enabling";
  EXPECT_FALSE(report().position.following);
}

// 32 bits have +-50 000 revolutions (BU 0020 7.3.5).
TEST_F(AxisReports, ATargetBeyondItsWordsIsRefused) {
  enable();
  EXPECT_EQ(TargetRefusal::kNone, drive_.setPosition(50'000.0));
  EXPECT_EQ(TargetRefusal::kBeyondRange, drive_.setPosition(50'001.0));
  EXPECT_EQ(50'001.0, report().position.refused_target);
  cycle(0x0A37);
  EXPECT_EQ(50'000.0, report().position.target) << "the one before stays";
}

TEST_F(AxisReports, ATargetOfADriveThatIsNotEnabledIsToldAsRefused) {
  start();
  EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.setPosition(3.0));
  EXPECT_EQ(TargetRefusal::kNotEnabled, report().position.refused);
  EXPECT_EQ(3.0, report().position.refused_target);
}

TEST_F(AxisReports, ADriveThatFollowsVelocitiesTakesNone) {
  DriveConfig velocity = config();
  velocity.position.reset();
  drive_ = Drive{velocity};
  for (const bool enabled : {false, true}) {
    cycle();
    cycle();
    if (enabled) {
      drive_.requestEnable(now_);
      cycle();
      cycle(0x0B37);
      ASSERT_EQ(Phase::kEnabled, report().phase);
    }
    EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.setPosition(1.0));
    EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.movePosition(1.0));
    EXPECT_EQ(TargetRefusal::kNotEnabled, drive_.setElement(1, 1.0));
    drive_.requestTeaching(now_);
    drive_.requestPositionReset(now_);
    drive_.setReferenced(true);
    EXPECT_EQ(RequestState::kNone, report().teaching.state);
    EXPECT_EQ(RequestState::kNone, report().resetting.state);
    EXPECT_FALSE(report().position.homed);
  }
}

TEST_F(AxisReports, ASecondResetIsNotBegunWhileOneRuns) {
  start();
  drive_.requestPositionReset(now_, 7);
  cycle();
  drive_.requestPositionReset(now_, 8);
  EXPECT_EQ(7u, report().resetting.token);
  EXPECT_EQ(RequestState::kRunning, report().resetting.state);
}

// Where a bit of the drive says so, that counts, and while it is heard only.
TEST_F(AxisReports, IsHomedWhereItsBitSaysSo) {
  start();
  EXPECT_FALSE(report().position.homed);
  drive_.setReferenced(true);
  cycle();
  EXPECT_TRUE(report().position.homed);
  for (int i = 0; i < 10; ++i) silence();
  EXPECT_FALSE(report().position.homed);
}

// Another inverter may have come back in its place.
TEST_F(AxisReports, WhatAReferenceRunFoundIsForgottenWithALoss) {
  enable();
  drive_.requestHoming(now_);
  for (int i = 0; i < 5; ++i) {
    count_ -= 50;
    cycle(0x0A37, -200);
  }
  for (int i = 0; i < 40; ++i) cycle(0x0B37);
  ASSERT_EQ(RequestState::kDone, report().homing.state);
  ASSERT_TRUE(report().position.homed);
  for (int i = 0; i < 10; ++i) silence();
  EXPECT_FALSE(report().position.position);
  start();
  EXPECT_FALSE(report().position.homed);
}

// What it found is a place in a count that is over. Where a bit of the drive tells, that counts.
TEST_F(AxisReports, WhatAReferenceRunFoundIsForgottenWithANewZeroThatNobodyAskedFor) {
  for (const bool enabled : {true, false}) {
    SCOPED_TRACE(enabled);
    enable();
    drive_.requestHoming(now_);
    for (int i = 0; i < 5; ++i) {
      count_ -= 50;
      cycle(0x0A37, -200);
    }
    for (int i = 0; i < 40; ++i) cycle(0x0B37);
    ASSERT_TRUE(report().position.homed);
    if (!enabled) {
      drive_.requestShutdown(now_);
      for (int i = 0; i < 40; ++i) cycle();
      ASSERT_TRUE(report().position.homed);
    }
    count_ += 30'000;
    for (int i = 0; i < 40; ++i) cycle(enabled ? 0x0B37 : 0x0B31);
    ASSERT_EQ(enabled ? StopCause::kPositionJump : StopCause::kNone, report().stop_cause);
    EXPECT_FALSE(report().position.homed);
    for (int i = 0; i < 40; ++i) cycle();
    EXPECT_FALSE(report().position.homed);
    drive_.setReferenced(true);
    cycle();
    EXPECT_TRUE(report().position.homed);
    drive_.setReferenced(std::nullopt);
  }
}

TEST_F(AxisReports, AReferenceRunIsRefusedWhileItIsNotEnabled) {
  start();
  drive_.requestHoming(now_, 7);
  EXPECT_EQ(RequestState::kRefused, report().homing.state);
  EXPECT_EQ(Refusal::kNotEnabled, report().homing.refusal);
  cycle();
  EXPECT_FALSE(report().position.homing);
}

TEST_F(AxisReports, AReferenceRunThatDoesNotEndStopsTheDrive) {
  DriveConfig impatient = config();
  impatient.position->homing_timeout = seconds(0.5);
  change(impatient);
  enable();
  drive_.requestHoming(now_, 7);
  for (int i = 0; i < 49; ++i) cycle(0x0A37, 200);
  ASSERT_EQ(RequestState::kRunning, report().homing.state);
  for (int i = 0; i < 2; ++i) cycle(0x0A37, 200);
  EXPECT_EQ(Refusal::kHomingTimeout, report().homing.refusal);
  EXPECT_EQ(StopCause::kHomingTimeout, report().stop_cause);
  cycle(0x0A37, 200);
  EXPECT_EQ(0x047E, sent_);
}

TEST_F(AxisReports, AReferenceRunEndsWithEveryStop) {
  enable();
  drive_.requestHoming(now_, 7);
  cycle(0x0A37, 200);
  ASSERT_TRUE(report().position.homing);
  drive_.requestShutdown(now_);
  EXPECT_EQ(RequestState::kRefused, report().homing.state);
  EXPECT_EQ(Refusal::kHomingStopped, report().homing.refusal);
  cycle(0x0A37, 200);
  EXPECT_FALSE(report().position.homing);
}

// Its words may mean something else in the other set: what was read of the one before is no position.
TEST_F(AxisReports, IsNowhereAfterAChangeOfItsParameterSet) {
  drive_.setPositionWords(2, profile::positionWords(profile::Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 3));
  drive_.setMaxFrequency(2, Hertz{50.0});
  start();
  drive_.requestParameterSet(2, now_);
  cycle();
  cycle(0x4B31);
  cycle(0x4B31);
  EXPECT_EQ(2, report().commanded_set);
  EXPECT_FALSE(report().position.position);
  EXPECT_EQ(Refusal::kPositionUnknown, drive_.enableRefusal());
  for (int i = 0; i < 4; ++i) cycle(0x4B31);
  EXPECT_NEAR(12.345, report().position.position.value_or(0.0), 1e-9);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(AxisReports, IsNotTaughtInASetThatIsNotCommanded) {
  start();
  cycle(0x4B31);
  ASSERT_NE(report().parameter_set, report().commanded_set);
  drive_.requestTeaching(now_, 7);
  EXPECT_EQ(Refusal::kParameterSet, report().teaching.refusal);
}

// A target that no word carries could not be held.
TEST_F(AxisReports, IsNotEnabledWhereNoWordCarriesItsTarget) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {1, 0, 0}, {1, 10, 15}, 3));
  start();
  EXPECT_EQ(Refusal::kPositionBeyondRange, drive_.enableRefusal());
}

TEST_F(AxisReports, ASpeedBeyondP105IsCut) {
  DriveConfig fast = config();
  fast.position->speed = RadPerSec{1000.0};
  change(fast);
  enable();
  ASSERT_EQ(TargetRefusal::kNone, drive_.setPosition(50.0));
  cycle(0x0A37);
  EXPECT_TRUE(report().saturated);
  EXPECT_NEAR(157.08, report().velocity_command.value, 0.01);
  EXPECT_EQ(16'384, report().output.setpoints[0]);
}

// Of 16384 a word has twice as much and no more: a count that is faster is not told as a motion the other way.
TEST_F(AxisReports, ASpeedByItsCountEndsAtTwiceP105) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {2, 21, 22}, {0, 10, 15}, 3));
  for (int i = 0; i < 30; ++i) {
    count_ += 125;  // 12.5 turns a second: 25 Hz
    cycle();
  }
  EXPECT_NEAR(8192, report().speed, 5);
  drive_.setMaxFrequency(1, Hertz{10.0});
  count_ += 30;
  cycle();
  EXPECT_NEAR(32'751, report().speed, 1);
}

// 400 Hz at two pole pairs are 200 000 steps a second; half as much again in 60 ms, and 20 steps: 18 020.
TEST_F(AxisReports, WithoutP105TheFastestInverterIsTheMeasure) {
  drive_.setMaxFrequency(1, Hertz{});
  start();
  count_ += 18'020;
  cycle();
  EXPECT_FALSE(report().position.held_back);
  count_ += 18'021;
  cycle();
  EXPECT_TRUE(report().position.held_back);
}

// --- in a group ------------------------------------------------------------------------------------------------------

class AxisInAGroup : public AxisReports {
 protected:
  DriveGroup group_{{&drive_}};
};

// A setpoint of zero would not stop it on its way to a target.
TEST_F(AxisInAGroup, IsDisabledByOff1FromTheFirstWordOn) {
  start();
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  cycle();
  cycle(0x0B37);
  group_.update(now_);
  ASSERT_TRUE(group_.commandAllowed());
  group_.requestDisable(now_);
  EXPECT_FALSE(group_.wantsZeroRamp());
  cycle(0x0A37, 3000);
  EXPECT_EQ(0x047E, sent_);
}

TEST_F(AxisInAGroup, ADisableEndsItsTeaching) {
  start();
  drive_.requestTeaching(now_, 7);
  cycle();
  group_.requestDisable(now_);
  EXPECT_EQ(Refusal::kTeachStopped, report().teaching.refusal);
}

}  // namespace
}  // namespace nord_driver::drive

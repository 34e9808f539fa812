// The count of a drive that positions is set anew: disabled and at standstill only, and no motion is seen in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drive/axis_at_rest.h"

namespace nord_driver::drive {
namespace {

class ResetPosition : public AxisAtRest {
 protected:
  void use(const DriveConfig& with) {
    drive_ = Drive{with};
    setWords();
  }
  void reset() { drive_.requestPositionReset(now_, 7); }
  /// Answered until it has ended; the drive counts from `zero` when it has had the bit.
  int followUntilItEnds(std::int32_t zero) {
    int high = 0;
    for (int i = 0; i < 300 && report().resetting.state == RequestState::kRunning; ++i) {
      cycle();
      EXPECT_EQ(0x047E, sent_);
      high += sent_axis_.reset ? 1 : 0;
      if (sent_axis_.reset) count_ = zero;
      most_ = std::max(most_, std::fabs(report().velocity.value));
    }
    return high;
  }
  void expectRefused(Refusal refusal) {
    EXPECT_EQ(RequestState::kRefused, report().resetting.state);
    EXPECT_EQ(refusal, report().resetting.refusal) << toString(report().resetting.refusal);
    send();
    EXPECT_FALSE(sent_axis_.reset);
  }

  double most_ = 0.0;  // rad/s
};

TEST_F(ResetPosition, EndsWithTheNewPositionAndItsBitLow) {
  start();
  reset();
  EXPECT_EQ(Refusal::kBusy, drive_.enableRefusal());
  EXPECT_FALSE(drive_.isAtRest());
  EXPECT_GE(followUntilItEnds(0), 10) << "100 ms";
  EXPECT_EQ(RequestState::kDone, report().resetting.state);
  EXPECT_EQ(7u, report().resetting.token);
  EXPECT_DOUBLE_EQ(0.0, *report().position.position);
  EXPECT_EQ(0.0, most_);
  send();
  EXPECT_FALSE(sent_axis_.reset);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
  EXPECT_TRUE(drive_.isAtRest());
  EXPECT_EQ(StopCause::kNone, report().stop_cause) << "a jump that was asked for";
}

// A few steps look like motion: without a word for the speed the position is all there is.
TEST_F(ResetPosition, IsNoMotionWhereTheSpeedComesFromThePosition) {
  drive_.setPositionWords(1, profile::positionWords(profile::Series::kSk5xxe, {21, 22, 0}, {10, 15, 0}, 3));
  count_ = 0;
  const auto cycle = [this] {
    send();
    profile::ProcessInput input;
    input.status_word = kReady;
    input.actual_values = {static_cast<std::int16_t>(count_), 0, 0};
    drive_.handleInput(input, true, now_);
  };
  count_ = 900;
  for (int i = 0; i < 20; ++i) cycle();
  reset();
  for (int i = 0; i < 300 && report().resetting.state == RequestState::kRunning; ++i) {
    cycle();
    if (sent_axis_.reset) count_ = 0;
    EXPECT_EQ(0.0, report().velocity.value);
  }
  EXPECT_EQ(RequestState::kDone, report().resetting.state) << toString(report().resetting.refusal);
  for (int i = 0; i < 10; ++i) {
    cycle();
    EXPECT_EQ(0.0, report().velocity.value);
  }
}

TEST_F(ResetPosition, FailsWhereTheCountStaysWhatItWas) {
  start();
  reset();
  followUntilItEnds(12'345);
  expectRefused(Refusal::kResetTimeout);
  EXPECT_DOUBLE_EQ(12.345, *report().position.position);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(ResetPosition, ComparesWithWhatTheDriveMakesOfIt) {
  DriveConfig with = config();
  with.position->reset_to = -2.0;
  with.position->scale.revolutions_per_unit = -10.0;
  with.position->scale.offset = 0.5;
  with.position->tolerance = 0.001;
  use(with);
  start();
  reset();
  followUntilItEnds(-2'000);
  EXPECT_EQ(RequestState::kDone, report().resetting.state);
  EXPECT_DOUBLE_EQ(0.7, *report().position.position);
  reset();
  followUntilItEnds(-2'011);
  expectRefused(Refusal::kResetTimeout);
}

// 70 revolutions on, by counting its turns on: the word alone says 4.464.
TEST_F(ResetPosition, Of16BitsForgetsTheTurnsBefore) {
  const profile::PositionWords low = profile::positionWords(profile::Series::kSk5xxe, {1, 21, 0}, {1, 10, 0}, 3);
  drive_.setPositionWords(1, low);
  const auto turnTo = [this](std::int32_t to) {
    for (; count_ < to; count_ += 200) cycle();
    count_ = to;
    for (int i = 0; i < 6; ++i) cycle();
  };
  count_ = 12'000;
  turnTo(65'541);
  ASSERT_DOUBLE_EQ(65.541, *report().position.position);
  reset();
  followUntilItEnds(0);
  EXPECT_EQ(RequestState::kDone, report().resetting.state);
  EXPECT_DOUBLE_EQ(0.0, *report().position.position);
}

TEST_F(ResetPosition, TakesBackWhatAReferenceRunHasFound) {
  start();
  drive_.requestEnable(now_);
  cycle();
  cycle(0x0B37);
  drive_.requestHoming(now_);
  cycle(0x0B37);
  cycle(0x0A37);
  for (int i = 0; i < 40; ++i) cycle(0x0B37);
  ASSERT_TRUE(report().position.homed);
  drive_.requestShutdown(now_);
  for (int i = 0; i < 3; ++i) cycle();
  reset();
  followUntilItEnds(0);
  EXPECT_EQ(RequestState::kDone, report().resetting.state);
  EXPECT_FALSE(report().position.homed);
}

TEST_F(ResetPosition, IsRefused) {
  reset();
  expectRefused(Refusal::kOffline);
  cycle();
  reset();
  expectRefused(Refusal::kPositionUnknown);
  start();
  cycle(kReady, 400);
  reset();
  expectRefused(Refusal::kTeachTurning);
  cycle();
  drive_.requestEnable(now_);
  reset();
  expectRefused(Refusal::kTeachNotDisabled);
  cycle();
  cycle(0x0B37);
  ASSERT_EQ(Phase::kEnabled, report().phase);
  reset();
  expectRefused(Refusal::kTeachNotDisabled);
}

TEST_F(ResetPosition, IsEndedByWhateverComesBetween) {
  const auto halfWay = [this] {
    start();
    reset();
    for (int i = 0; i < 5; ++i) cycle();
    ASSERT_TRUE(sent_axis_.reset);
  };
  halfWay();
  drive_.requestTeaching(now_, 8);
  EXPECT_EQ(RequestState::kNone, report().teaching.state) << "one after the other";
  drive_.requestQuickStop(now_);
  expectRefused(Refusal::kResetStopped);
  EXPECT_EQ(0x047B, sent_);
  for (int i = 0; i < 3; ++i) cycle(0x0B50);
  halfWay();
  cycle(kReady, 400);
  expectRefused(Refusal::kTeachTurning);
  halfWay();
  cycle(0x0B38);
  expectRefused(Refusal::kFault);
  drive_.requestAcknowledge(now_);
  for (int i = 0; i < 60; ++i) cycle();
  halfWay();
  for (int i = 0; i < 10; ++i) silence();
  expectRefused(Refusal::kOffline);
}

// --- on its way, and at a limit ---------------------------------------------------------------------------------------

TEST_F(ResetPosition, AndTheWayToATargetIsTold) {
  DriveConfig with = config();
  with.position->lower = 0.0;
  with.position->upper = 20.0;
  with.position->tolerance = 0.01;
  use(with);
  start();
  EXPECT_FALSE(report().position.following || report().position.at_limit);
  drive_.requestEnable(now_);
  cycle();
  cycle(0x0B37);
  EXPECT_FALSE(report().position.following) << "held, and nobody has asked for anything";
  drive_.setPosition(20.0);
  cycle(0x0A37);
  EXPECT_TRUE(report().position.following);
  count_ = 12'500;
  cycle(0x0A37, 300);
  EXPECT_TRUE(report().position.following);
  EXPECT_FALSE(report().position.at_limit);
  for (; count_ < 20'000; count_ += 100) cycle(0x0A37, 300);
  count_ = 19'995;
  cycle(0x0B37);
  EXPECT_FALSE(report().position.following);
  EXPECT_TRUE(report().position.reached);
  EXPECT_TRUE(report().position.at_limit);
  drive_.requestShutdown(now_);
  cycle(0x0B37);
  EXPECT_TRUE(report().position.at_limit) << "enabled or not";
  for (int i = 0; i < 10; ++i) silence();
  EXPECT_FALSE(report().position.at_limit) << "nobody knows";
}

}  // namespace
}  // namespace nord_driver::drive

// What is asked of a drive while something else is under way, and what stands in its report afterwards.
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "drive/axis_at_rest.h"
#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

class RequestOutcomes : public DriveTest {
 protected:
  void stop(bool coast) { coast ? drive_.requestCoast(now_) : drive_.requestQuickStop(now_); }
};

// Whoever asked for the enabling hears that a stop came; a stop without one leaves no refusal behind.
TEST_F(RequestOutcomes, AHardStopWhileEnablingRefusesTheEnabling) {
  for (const bool coast : {false, true}) {
    start();
    stop(coast);
    EXPECT_EQ(Refusal::kNone, report().refusal);
    cycle(0x0B70);
    cycle(0x0B70);
    cycle(0x0B31);
    drive_.requestEnable(now_);
    ASSERT_EQ(Phase::kEnabling, report().phase);
    stop(coast);
    EXPECT_EQ(Refusal::kStopped, report().refusal);
    EXPECT_EQ(coast ? 0x047D : 0x047B, cycle(0x0B70));
    cycle(0x0B70);
    drive_ = Drive{config()};
  }
}

TEST_F(RequestOutcomes, AHardStopEndsAnAcknowledging) {
  for (const bool coast : {false, true}) {
    start();
    cycle(0x0B38);
    drive_.requestAcknowledge(now_, 5);
    ASSERT_EQ(Phase::kAcknowledging, report().phase);
    stop(coast);
    EXPECT_EQ(RequestState::kRefused, report().acknowledge.state);
    EXPECT_EQ(Refusal::kRequestStopped, report().acknowledge.refusal);
    EXPECT_EQ(Refusal::kRequestStopped, report().refusal);
    EXPECT_EQ(coast ? 0x047D : 0x047B, cycle(0x0B38)) << "and its bit 7 is low";
    drive_ = Drive{config()};
  }
}

// One edge for both: the first one's outcome is told, and its time is not begun anew.
TEST_F(RequestOutcomes, ASecondAcknowledgingIsNotBegunWhileOneRuns) {
  start();
  cycle(0x0B38);
  drive_.requestAcknowledge(now_, 5);
  int cycles = 0;
  while (report().phase == Phase::kAcknowledging && cycles < 50) {
    cycle(0x0B38);
    drive_.requestAcknowledge(now_, 6);
    if (report().acknowledge.token == 6) break;
    ++cycles;
  }
  EXPECT_EQ(8, cycles) << "low, high and low again for 30 ms each";
}

// Another acknowledging after one that was of no use gives an edge of its own.
TEST_F(RequestOutcomes, EachAcknowledgingHasItsOwnEdge) {
  start();
  cycle(0x0B38);
  for (int asked = 0; asked < 2; ++asked) {
    drive_.requestAcknowledge(now_, 5);
    int high = 0;
    for (int i = 0; i < 50 && report().phase == Phase::kAcknowledging; ++i) high += cycle(0x0B38) == 0x04FE ? 1 : 0;
    EXPECT_EQ(3, high) << "30 ms";
    EXPECT_EQ(Refusal::kCauseStands, report().acknowledge.refusal);
  }
}

// P104 has steps of 0.1 Hz: whatever is above 0 turns the motor.
TEST_F(RequestOutcomes, ASmallMinimumFrequencyTurnsTheMotorToo) {
  start();
  drive_.setMinimumFrequency(1, Hertz{0.1});
  EXPECT_EQ(Refusal::kMinimumFrequency, drive_.enableRefusal());
  drive_.setMinimumFrequency(1, Hertz{0.0});
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(RequestOutcomes, AnotherSourceOfItsWordsRefusesToEnable) {
  start();
  drive_.setUnexpectedSource(UnexpectedSource{509, false, 10, false});
  EXPECT_EQ(Refusal::kUnexpectedSource, drive_.enableRefusal());
  drive_.setUnexpectedSource(std::nullopt);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(RequestOutcomes, ASetpointOfZeroIsNothingToADriveThatIsNotEnabled) {
  start();
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(Phase::kIdle, report().phase);
  drive_.requestQuickStop(now_);
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(Phase::kQuickStopping, report().phase) << "a stop that runs goes on";
}

TEST_F(RequestOutcomes, WithoutP105ThereIsNoLargestVelocity) {
  start();
  EXPECT_NEAR(7.854, drive_.maxVelocity().value_or(RadPerSec{}).value, 1e-3);
  drive_.setMaxFrequency(1, Hertz{});
  EXPECT_FALSE(drive_.maxVelocity());
}

// What was measured and commanded is of the present cycle, or it is 0.
TEST_F(RequestOutcomes, NothingIsLeftOfAMotionThatIsOver) {
  run();
  drive_.setVelocity({100.0});
  cycle(0x0B37, 0x2000);
  EXPECT_TRUE(report().saturated);
  EXPECT_NEAR(7.854, report().velocity_command.value, 1e-3);
  EXPECT_NEAR(25.0, report().frequency.value, 1e-9);
  drive_.requestShutdown(now_);
  cycle(0x0B37, 0x2000);
  EXPECT_FALSE(report().saturated);
  EXPECT_EQ(0.0, report().velocity_command.value);
  drive_.setMaxFrequency(1, Hertz{});
  cycle(0x0B37, 0x2000);
  EXPECT_FALSE(report().scaled);
  EXPECT_EQ(0.0, report().frequency.value);
  EXPECT_EQ(0.0, report().velocity.value);
  fallSilent();
  EXPECT_EQ(0, report().parameter_set);
}

// What reads revolutions per minute tells 0 as long as P105 is not known to it: such a word must not count afterwards.
TEST_F(RequestOutcomes, AWordFromBeforeP105WasKnownIsNotScaledByIt) {
  drive_.setMaxFrequency(1, Hertz{});
  cycle(0x0B38);
  ASSERT_TRUE(report().online);
  drive_.setMaxFrequency(1, {50.0});
  drive_.handleInput({}, false, now_);
  EXPECT_FALSE(report().scaled);
  cycle(0x0B38);
  EXPECT_TRUE(report().scaled);
  drive_.handleInput({}, false, now_);
  EXPECT_TRUE(report().scaled);
}

TEST_F(RequestOutcomes, AnInvalidCommandIsForgottenWithTheNextEnable) {
  run();
  drive_.setVelocity({std::numeric_limits<double>::quiet_NaN()});
  cycle(0x0B37);
  ASSERT_TRUE(report().command_invalid);
  drive_.requestShutdown(now_);
  cycle(0x0B31);
  drive_.requestEnable(now_);
  EXPECT_EQ(Phase::kEnabling, report().phase);
  EXPECT_FALSE(report().command_invalid);
}

// |IW1| from 5 % of P105 on (819) has a sign that counts (BU 2700 6.6.1: at rest bit 11 is 1).
TEST_F(RequestOutcomes, ADirectionIsComparedFromFivePercentOn) {
  start();
  cycle(0x0B37, -818);
  EXPECT_FALSE(report().direction_contradiction);
  cycle(0x0B37, -819);
  EXPECT_TRUE(report().direction_contradiction);
  cycle(0x1337, 819);
  EXPECT_TRUE(report().direction_contradiction) << "bit 12: left";
  cycle(0x1337, -819);
  EXPECT_FALSE(report().direction_contradiction);
}

// It stands at setpoint 0 already, with its torque on: asked once more it does not lose that.
TEST_F(RequestOutcomes, ASetpointOfZeroIsAskedForTwice) {
  run();
  drive_.requestSetpointZero(now_);
  ASSERT_EQ(0x047F, cycle(0x0B37, 0x1000));
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(Phase::kHoldingZero, report().phase);
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x0800));
  EXPECT_EQ(0, setpoint_);
}

TEST_F(RequestOutcomes, AQuickStopEndsASwitchOfTheSet) {
  start();
  drive_.requestParameterSet(3, now_, 5);
  EXPECT_EQ(0x847E, cycle(0x0B31));
  drive_.requestQuickStop(now_);
  EXPECT_EQ(RequestState::kRefused, report().set_switch.state);
  EXPECT_EQ(Refusal::kRequestStopped, report().set_switch.refusal);
  EXPECT_EQ(Refusal::kRequestStopped, report().refusal);
  EXPECT_EQ(0x047B, cycle(0x0B70)) << "in the set that is in force";
}

// enable_timeout: 0.5 s, to the cycle.
TEST_F(RequestOutcomes, ASetThatIsNotConfirmedIsTakenBackInTime) {
  start();
  drive_.requestParameterSet(3, now_, 5);
  for (int i = 0; i < 50; ++i) ASSERT_EQ(0x847E, cycle(0x0B31)) << i;
  EXPECT_EQ(Refusal::kSetNotConfirmed, report().set_switch.refusal);
  EXPECT_EQ(0x047E, cycle(0x0B31));
}

// What was sent to a silent drive is over when it has answered: silent again, it is asked and not commanded.
TEST_F(RequestOutcomes, AStopSentUnansweredIsNotSentAtTheNextSilence) {
  start();
  fallSilent();
  drive_.requestQuickStop(now_);
  EXPECT_EQ(0x047B, silence());
  start();
  ASSERT_EQ(Phase::kIdle, report().phase);
  fallSilent();
  EXPECT_EQ(0x0000, silence());
}

class TaughtMeanwhile : public AxisAtRest {
 protected:
  void teach() {
    start();
    drive_.requestTeaching(now_, 7);
    cycle();
    ASSERT_EQ(RequestState::kRunning, report().teaching.state);
  }
};

TEST_F(TaughtMeanwhile, IsSentToNoOtherParameterSet) {
  teach();
  drive_.requestParameterSet(2, now_, 8);
  EXPECT_EQ(RequestState::kRefused, report().set_switch.state);
  EXPECT_EQ(Refusal::kBusy, report().set_switch.refusal);
  EXPECT_EQ(RequestState::kRunning, report().teaching.state);
}

TEST_F(TaughtMeanwhile, IsEndedByADisable) {
  teach();
  drive_.requestShutdown(now_);
  EXPECT_EQ(RequestState::kRefused, report().teaching.state);
  EXPECT_EQ(Refusal::kTeachStopped, report().teaching.refusal);
  send();
  EXPECT_FALSE(sent_axis_.teach.teach_in);
}

}  // namespace
}  // namespace nord_driver::drive

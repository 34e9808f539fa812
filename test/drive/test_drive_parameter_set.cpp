// Switching the parameter set.
#include <gtest/gtest.h>

#include <utility>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

// Bits 14 and 15 of the control word ask, those of the status word confirm (BU 0020 7.3.3, 7.3.4).
TEST_F(DriveTest, SwitchesTheSetAndWaitsForTheConfirmation) {
  start();
  drive_.requestParameterSet(3, now_);
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
  EXPECT_EQ(0x847E, cycle(0x0B31));
  EXPECT_EQ(0x847E, cycle(0x0B31));
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
  EXPECT_EQ(0x847E, cycle(0x8B31));
  EXPECT_EQ(RequestState::kDone, report().set_switch.state);
  EXPECT_EQ(3, report().parameter_set);
  EXPECT_EQ(Phase::kIdle, report().phase);
  drive_.requestEnable(now_);
  cycle(0x8B31);
  cycle(0x8B37);
  drive_.setVelocity({3.926990816987241});  // 25 Hz, of 100 in set 3
  EXPECT_EQ(0x847F, cycle(0x8B37));
  EXPECT_EQ(0x1000, setpoint_);
}

TEST_F(DriveTest, SwitchesToEverySet) {
  start();
  const Word words[] = {0x047E, 0x447E, 0x847E, 0xC47E};
  for (std::uint8_t set = 4; set >= 1; --set) {
    drive_.requestParameterSet(set, now_);
    EXPECT_EQ(words[set - 1], cycle(static_cast<Word>(0x0B31 | (set - 1) << 14)));
    EXPECT_EQ(RequestState::kDone, report().set_switch.state);
  }
}

// A status word from before the request's own telegram confirms nothing.
TEST_F(DriveTest, WaitsForTheAnswerToItsOwnSet) {
  start();
  cycle(0x4B31);  // set 2 came into force by itself; set 1 is still commanded
  drive_.pollOutput(now_);
  drive_.requestParameterSet(2, now_);
  profile::ProcessInput before;
  before.status_word = 0x4B31;
  drive_.handleInput(before, true, now_);
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
  EXPECT_EQ(0x447E, cycle(0x4B31));
  EXPECT_EQ(RequestState::kDone, report().set_switch.state);
}

// Not confirmed in enable_timeout: back to the set in force, and said.
TEST_F(DriveTest, GoesBackToTheSetInForce) {
  start();
  drive_.requestParameterSet(2, now_);
  const Instant begin = now_;
  while (report().phase == Phase::kSwitchingSet) {
    ASSERT_LE(now_ - begin, seconds(0.6));
    EXPECT_EQ(0x447E, cycle(0x0B31));
  }
  EXPECT_GE(now_ - begin, seconds(0.5));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(RequestState::kRefused, report().set_switch.state);
  EXPECT_EQ(Refusal::kSetNotConfirmed, report().set_switch.refusal);
}

// Setpoint and actual value are shares of P105 of the set (BU 0020 7.3.5): only at standstill, and only while idle.
class SetRefusalTest : public DriveTest {
 protected:
  Refusal ask(std::uint8_t set = 2) {
    const Phase before = report().phase;
    drive_.requestParameterSet(set, now_);
    EXPECT_EQ(before, report().phase);
    EXPECT_EQ(RequestState::kRefused, report().set_switch.state);
    EXPECT_EQ(report().refusal, report().set_switch.refusal);
    EXPECT_STRNE("nothing", toString(report().refusal));
    EXPECT_LE(drive_.pollOutput(now_).control_word, 0x3FFF);
    return report().set_switch.refusal;
  }
};

TEST_F(SetRefusalTest, WhileOffline) {
  EXPECT_EQ(Refusal::kOffline, ask());
}

TEST_F(SetRefusalTest, OfASetThatIsNone) {
  start();
  EXPECT_EQ(Refusal::kNoSuchSet, ask(0));
  EXPECT_EQ(Refusal::kNoSuchSet, ask(5));
}

// A profile without bits for sets: DRIVECOM.
TEST_F(SetRefusalTest, OfAnotherSetThan1WhereThereIsNoOther) {
  DriveConfig set_1_only = config();
  set_1_only.parameter_sets = 1;
  drive_ = Drive{set_1_only};
  start();
  EXPECT_EQ(Refusal::kOnlySet1, ask(2));
  EXPECT_EQ(Refusal::kNoSuchSet, ask(5));
  drive_.requestParameterSet(1, now_);
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
}

TEST_F(SetRefusalTest, WhileEnabledOrStopping) {
  run();
  EXPECT_EQ(Refusal::kNotDisabled, ask());
  drive_.requestShutdown(now_);
  cycle(0x0B37, 0x1000);
  EXPECT_EQ(Refusal::kNotDisabled, ask());
}

TEST_F(SetRefusalTest, WhileItTurns) {
  start();
  cycle(0x0B31, -165);
  EXPECT_EQ(Refusal::kTurning, ask());
  cycle(0x0B31, 164);
  drive_.requestParameterSet(2, now_);
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
}

TEST_F(SetRefusalTest, WithAFaultOrUnderLocalControl) {
  start();
  cycle(0x0B38);
  EXPECT_EQ(Refusal::kFault, ask());
  cycle(0x0931);
  EXPECT_EQ(Refusal::kLocalControl, ask());
}

TEST_F(SetRefusalTest, FromAnotherState) {
  start();
  for (const int status : {0x0B33, 0x0B37, 0x0B17, 0x0B30}) {
    cycle(static_cast<Word>(status));
    EXPECT_EQ(Refusal::kWrongState, ask()) << status;
  }
}

// One at a time; what runs is not disturbed by what is refused.
TEST_F(DriveTest, RefusesASecondSwitchingAndAnEnable) {
  start();
  cycle(0x0B38);
  cycle(0x0B31);  // a fault that has vanished is there to be acknowledged
  drive_.requestParameterSet(3, now_);
  drive_.requestParameterSet(2, now_);
  EXPECT_EQ(Refusal::kBusy, report().refusal);
  EXPECT_EQ(RequestState::kRunning, report().set_switch.state);
  drive_.requestEnable(now_);
  EXPECT_EQ(Refusal::kBusy, report().refusal);
  drive_.requestAcknowledge(now_);
  EXPECT_EQ(Refusal::kBusy, report().acknowledge.refusal);
  EXPECT_EQ(0x847E, cycle(0x8B31));
  EXPECT_EQ(RequestState::kDone, report().set_switch.state);
}

// Whatever comes between ends the switching, with the set in force.
TEST_F(DriveTest, BreaksTheSwitchingOff) {
  const std::pair<int, Refusal> kEnds[] = {{0x0B38, Refusal::kFault}, {0x0931, Refusal::kLocalControl}};
  for (const auto& [status, refusal] : kEnds) {
    drive_ = Drive(config());
    start();
    drive_.requestParameterSet(3, now_);
    EXPECT_EQ(0x847E, cycle(static_cast<Word>(status)));
    EXPECT_EQ(refusal, report().set_switch.refusal);
    EXPECT_EQ(0x047E, cycle(0x0B31));
  }
}

TEST_F(DriveTest, StopsInTheSetInForce) {
  start();
  drive_.requestParameterSet(3, now_);
  cycle(0x0B31);
  drive_.requestQuickStop(now_);
  EXPECT_EQ(Refusal::kRequestStopped, report().set_switch.refusal);
  EXPECT_EQ(0x047B, cycle(0x0B31));
}

// It was idle: nothing is sent unanswered, the set is learned anew, and nothing was stopped.
TEST_F(DriveTest, EndsTheSwitchingOfASilentDrive) {
  start();
  drive_.requestParameterSet(3, now_);
  fallSilent();
  EXPECT_EQ(Refusal::kOffline, report().set_switch.refusal);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
  EXPECT_EQ(0x0000, cycle(0x8B31));
  EXPECT_EQ(0x847E, cycle(0x8B31));
}

}  // namespace
}  // namespace nord_driver::drive

// Each invariant by itself, on moments made by hand: it holds where it must, and it can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "campaign/answer_invariants.h"
#include "campaign/motion_invariants.h"
#include "campaign/report_invariants.h"
#include "campaign/two_wheels_moment.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

class Invariants : public TwoWheelsMoment {
 protected:
  Invariants() { moment_.calls = &calls_; }
  /// What it says in the cycles until `span` has passed; empty: nothing.
  std::string look(Invariant& invariant, Duration span = milliseconds{10}) {
    for (const Instant end = moment_.now + span; moment_.now < end;) {
      std::string wrong = cycle(invariant);
      moment_.answers.clear();
      if (!wrong.empty()) return wrong;
    }
    return "";
  }
  void turn(double frequency, std::int16_t setpoint) {
    for (DriveTruth& drive : moment_.drives) {
      drive.frequency = frequency;
      drive.setpoint = setpoint;
    }
  }
  void ask(cycle::RequestKind kind, Duration patience) {
    Call call;
    call.request.id = static_cast<std::uint32_t>(calls_.size() + 1);
    call.request.kind = kind;
    call.request.patience = patience;
    call.submitted = moment_.now;
    calls_.push_back(call);
  }
  void answer(std::uint32_t id, bool success, const char* message) {
    cycle::Completion answer;
    answer.id = id;
    answer.success = success;
    answer.message = message;
    moment_.answers.push_back(answer);
    if (id <= calls_.size()) calls_[id - 1].answered = true;
  }

  std::vector<Call> calls_;
};

TEST_F(Invariants, TurnsAsFastAsCommandedAndNoFaster) {
  TurnsOnlyAsCommanded invariant;
  want(20.0);
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  turn(20.5, 6554);
  EXPECT_THAT(look(invariant), HasSubstr("20.5 Hz, no more than 20 Hz"));
}

TEST_F(Invariants, ComesDownItsRampWhenTheCommandHasEnded) {
  TurnsOnlyAsCommanded invariant;
  want(20.0);
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  want(0.0);
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  EXPECT_THAT(look(invariant, milliseconds{20}), HasSubstr("is commanded"));
}

// A transport that closes takes its time, and nobody looks meanwhile: at rest afterwards, it was so at some time before.
TEST_F(Invariants, AStopLastsAsLongAsItIsSeenTurning) {
  TurnsOnlyAsCommanded invariant;
  want(20.0);
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  want(0.0);
  EXPECT_EQ("", look(invariant, milliseconds{40}));
  turn(0.0, 0);
  moment_.now += seconds{1};
  EXPECT_EQ("", look(invariant));
  EXPECT_NEAR(0.03, invariant.worstStop().took, 1e-9)
      << "from the first look without a command to the last one turning";
  EXPECT_GE(invariant.worstStop().bound, invariant.worstStop().took);
}

TEST_F(Invariants, WhoIsNotEnabledIsNotCommanded) {
  TurnsOnlyAsCommanded invariant;
  moment_.groups[0].asked = false;
  want(20.0);
  turn(0.2, 6554);
  EXPECT_THAT(look(invariant), HasSubstr("no more than 0 Hz"));
}

TEST_F(Invariants, WhoIsNotReachedStopsByItsTimeOuts) {
  TurnsOnlyAsCommanded invariant;
  want(20.0);
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  moment_.cut[0] = true;
  EXPECT_EQ("", look(invariant, milliseconds{60}));
  EXPECT_THAT(look(invariant, milliseconds{30}), HasSubstr("is commanded"));
}

// A slowest speed is that of a single drive which is told to turn; a base rests below it.
TEST_F(Invariants, WhoCannotTurnSlowlyTurnsAtItsSlowest) {
  for (DriveTruth& drive : moment_.drives) drive.slowest = 3.0;
  const auto turns_at = [&](double wanted, double hertz) {
    TurnsOnlyAsCommanded invariant;
    want(wanted);
    turn(hertz, 983);
    return look(invariant);
  };
  EXPECT_THAT(turns_at(1.0, 3.0), HasSubstr("no more than 1 Hz"));
  moment_.groups[0].is_base = false;
  EXPECT_EQ("", turns_at(1.0, 3.0));
  EXPECT_EQ("", turns_at(-1.0, -3.0));
  EXPECT_THAT(turns_at(0.0, 3.0), HasSubstr("no more than 0 Hz"));
}

TEST_F(Invariants, NobodyTurnsAgainstTheCommand) {
  for (const double sense : {1.0, -1.0}) {
    TurnsTheCommandedWay invariant;
    const auto turns_at = [&](double hertz) {
      for (DriveTruth& drive : moment_.drives) drive.along = sense * hertz;
      return look(invariant);
    };
    want(sense * 20.0);
    EXPECT_EQ("", turns_at(20.0));
    EXPECT_THAT(turns_at(-0.2),
                HasSubstr(sense > 0.0 ? "drive 0 turns its joint backward at 0.2 Hz, no more than 0 Hz"
                                      : "drive 0 turns its joint forward at 0.2 Hz, no more than 0 Hz"));
    EXPECT_THAT(turns_at(20.2), HasSubstr("at 20.2 Hz, no more than 20 Hz"));
    for (DriveTruth& drive : moment_.drives) drive.bus_control = false;
    EXPECT_EQ("", turns_at(-20.0)) << "by its terminals";
    for (DriveTruth& drive : moment_.drives) drive.bus_control = true;
    EXPECT_EQ("", turns_at(-20.0)) << "it was before this look";
    EXPECT_EQ("", turns_at(-19.8)) << "and comes down its ramp";
    EXPECT_THAT(turns_at(-19.8), HasSubstr("is commanded that way"));
  }
}

// The axes of a base with limits of jerk have times of their own: a wheel may be beyond both of its speeds.
TEST_F(Invariants, AWheelIsWhereItsBaseMayBe) {
  moment_.between = {{-5.0, 25.0}, {-5.0, 25.0}};
  want(10.0);
  const auto turns_at = [&](double hertz) {
    TurnsOnlyAsCommanded speed;
    TurnsTheCommandedWay way;
    turn(hertz, 983);
    for (DriveTruth& drive : moment_.drives) drive.along = hertz;
    const std::string wrong = look(speed);
    return wrong.empty() ? look(way) : wrong;
  };
  EXPECT_EQ("", turns_at(25.0));
  EXPECT_EQ("", turns_at(-5.0));
  EXPECT_THAT(turns_at(25.2), HasSubstr("no more than 25 Hz"));
  EXPECT_THAT(turns_at(-5.2), HasSubstr("backward at 5.2 Hz, no more than 5 Hz"));
}

TEST_F(Invariants, NobodyIsEnabledUnasked) {
  NothingEnabledUnasked invariant;
  EXPECT_EQ("", look(invariant));
  moment_.drives[1].state = sim::InverterState::kReadyToSwitchOn;
  moment_.groups[0].asked = false;
  EXPECT_EQ("", look(invariant, seconds{1}));
  moment_.drives[1].state = sim::InverterState::kOperationEnabled;
  EXPECT_THAT(look(invariant), HasSubstr("drive 1 is \"operation enabled\", and nobody has asked"));
}

// Whatever the driver tells meanwhile: who has left "operation enabled" is asked for again.
TEST_F(Invariants, NobodyWhoWasInterruptedIsEnabledUnasked) {
  NothingEnabledUnasked invariant;
  EXPECT_EQ("", look(invariant));
  moment_.drives[1].state = sim::InverterState::kReadyToSwitchOn;
  moment_.groups[0].interrupted = true;
  EXPECT_EQ("", look(invariant, seconds{1}));
  moment_.drives[1].state = sim::InverterState::kOperationEnabled;
  EXPECT_THAT(look(invariant), HasSubstr("drive 1 is \"operation enabled\", and nobody has asked"));
}

// A word on its way may enable it for as long as words take, and no longer.
TEST_F(Invariants, WhoIsEnabledByAWordFromBeforeIsTakenBack) {
  NothingEnabledUnasked invariant;
  moment_.drives[1].state = sim::InverterState::kReadyToSwitchOn;
  EXPECT_EQ("", look(invariant));
  moment_.groups[0].asked = false;
  EXPECT_EQ("", look(invariant, milliseconds{20}));
  moment_.drives[1].state = sim::InverterState::kOperationEnabled;
  EXPECT_EQ("", look(invariant, milliseconds{30}));
  EXPECT_THAT(look(invariant), HasSubstr("drive 1 is \"operation enabled\", and nobody has asked"));
  moment_.drives[1].state = sim::InverterState::kReadyToSwitchOn;
  EXPECT_EQ("", look(invariant));
}

TEST_F(Invariants, ASecondDriveAtAnAddressIsNotEnabled) {
  NobodyUnknownEnabled invariant;
  EXPECT_EQ("", look(invariant));
  moment_.twin_enabled = true;
  EXPECT_THAT(look(invariant), HasSubstr("at the address of drive 0"));
}

TEST_F(Invariants, NoWheelOfABaseIsDrivenAlone) {
  NeverOneWheelAlone invariant;
  turn(20.0, 6554);
  moment_.drives[1].state = sim::InverterState::kFault;
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  EXPECT_THAT(look(invariant, milliseconds{20}), HasSubstr("drive 0 is told to turn"));
  moment_.drives[0].setpoint = 0;
  EXPECT_EQ("", look(invariant, seconds{1}));
}

TEST_F(Invariants, ThePoseNeverJumps) {
  OdometryContinuous invariant;
  EXPECT_EQ("", look(invariant));
  snapshot_.base.pose.x = 0.008;
  EXPECT_EQ("", look(invariant));
  snapshot_.base.pose.x = 0.02;
  EXPECT_THAT(look(invariant), HasSubstr("the pose jumps by 0.012 m"));
  snapshot_.base.pose = {};
  EXPECT_THAT(look(invariant), HasSubstr("the pose jumps"));
  snapshot_.base.pose.heading = 0.1;
  EXPECT_THAT(look(invariant), HasSubstr("0.1 rad"));
  snapshot_.drives[1].joint_position = 0.1;
  EXPECT_THAT(look(invariant), HasSubstr("joint 1 jumps by 0.1 rad"));
}

TEST_F(Invariants, ANewNodeStartsAtPoseZero) {
  OdometryContinuous invariant;
  snapshot_.base.pose.x = 1.0;
  EXPECT_THAT(look(invariant), HasSubstr("not at pose 0"));
}

TEST_F(Invariants, EveryStopIsNamed) {
  EveryLossNamed invariant;
  EXPECT_EQ("", look(invariant));
  snapshot_.base.enabled = false;
  EXPECT_THAT(look(invariant), HasSubstr("no cause is named"));
  snapshot_.drives[1].stopped = true;
  EXPECT_THAT(look(invariant), HasSubstr("drive 1 is stopped without a word"));
  snapshot_.drives[1].text = "a fault of the inverter";
  EXPECT_EQ("", look(invariant));
  snapshot_.drives[0].online = false;
  EXPECT_EQ("", look(invariant, seconds{1}));
  EXPECT_THAT(look(invariant), HasSubstr("drive 0 does not answer, and nobody says why"));
}

// "All drives of the node or none": who refuses is named by the answer.
TEST_F(Invariants, WhatARefusedEnablingTakesBackIsNamed) {
  EveryLossNamed invariant;
  EXPECT_EQ("", look(invariant));
  ask(cycle::RequestKind::kEnable, seconds{3});
  answer(1, false, "drive right: a fault");
  snapshot_.base.enabled = false;
  EXPECT_EQ("", look(invariant));
  snapshot_.base.enabled = true;
  EXPECT_EQ("", look(invariant));
  ask(cycle::RequestKind::kAcknowledge, seconds{3});
  answer(2, false, "drive right: its cause stands");
  snapshot_.base.enabled = false;
  EXPECT_THAT(look(invariant), HasSubstr("no cause is named"));
}

TEST_F(Invariants, EveryCallIsAnsweredInTime) {
  EveryCallAnswered invariant;
  ask(cycle::RequestKind::kEnable, milliseconds{100});
  EXPECT_EQ("", look(invariant, milliseconds{110}));
  EXPECT_THAT(look(invariant), HasSubstr("request 1 (kind 0, drive all) is not answered"));
}

TEST_F(Invariants, NoCallIsAnsweredTwice) {
  NoCallAnsweredTwice invariant;
  ask(cycle::RequestKind::kEnable, seconds{1});
  answer(1, true, "enabled");
  EXPECT_EQ("", look(invariant));
  answer(1, true, "enabled");
  EXPECT_EQ("request 1 is answered twice", look(invariant));
  answer(7, true, "enabled");
  EXPECT_EQ("request 7 was never asked", look(invariant));
}

TEST_F(Invariants, AnswersTellTheTruth) {
  AnswersAreTrue invariant;
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  for (int i = 0; i < 2; ++i) ask(cycle::RequestKind::kDisable, seconds{1});
  answer(1, true, "disabled");
  EXPECT_THAT(look(invariant), HasSubstr("says that drive 0 is at rest, and it turns"));
  answer(2, false, "");
  EXPECT_THAT(look(invariant), HasSubstr("without a sentence"));
  for (DriveTruth& drive : moment_.drives) drive.state = sim::InverterState::kReadyToSwitchOn;
  EXPECT_EQ("", look(invariant, seconds{1}));
  ask(cycle::RequestKind::kEnable, seconds{1});
  answer(3, true, "enabled");
  EXPECT_THAT(look(invariant), HasSubstr("says that drive 0 is enabled, and it is not"));
}

// Nobody can say more of a drive than the one that answers in its name.
TEST_F(Invariants, AStopIsToldOfTheOneThatStandsIn) {
  AnswersAreTrue invariant;
  turn(20.0, 6554);
  EXPECT_EQ("", look(invariant, seconds{1}));
  for (int i = 0; i < 2; ++i) ask(cycle::RequestKind::kDisable, seconds{1});
  moment_.drives[1].frequency = 0.0;
  moment_.stand_in_believed = true;
  answer(1, true, "disabled");
  EXPECT_EQ("", look(invariant));
  moment_.drives[1].frequency = 20.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
  answer(2, true, "disabled");
  EXPECT_THAT(look(invariant), HasSubstr("says that drive 1 is at rest, and it turns"));
}

TEST_F(Invariants, AValueReadWasThere) {
  AnswersAreTrue invariant;
  ask(cycle::RequestKind::kReadParameter, seconds{1});
  calls_[0].held = {150, 160};
  answer(1, true, "");
  moment_.answers[0].parameter.raw = 160;
  EXPECT_EQ("", look(invariant));
  answer(1, true, "");
  moment_.answers[0].parameter.raw = 170;
  EXPECT_THAT(look(invariant), HasSubstr("tells the value 170"));
}

}  // namespace
}  // namespace nord_driver::test

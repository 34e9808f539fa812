// The invariants of drives that go to positions, each by itself on moments made by hand: it holds where it must, and it
// can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "campaign/axes.h"
#include "campaign/position_invariants.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// One axis that is enabled and held at 1 rad; a cycle is 10 ms, a stop takes 50 ms to reach it.
class PositionInvariants : public ::testing::Test {
 protected:
  PositionInvariants() : snapshot_(1) {
    moment_.now = Instant{seconds{1000}};
    moment_.period = milliseconds{10};
    moment_.reaction = milliseconds{50};
    moment_.drives.resize(1);
    moment_.wanted.resize(1);
    moment_.cut.resize(1);
    moment_.axes.resize(1);
    moment_.axes[0].is_axis = true;
    GroupWish axis;
    axis.members = {0};
    axis.is_axis = axis.asked = axis.confirmed = true;
    moment_.groups.push_back(axis);
    moment_.snapshot = &snapshot_;
    moment_.calls = &calls_;
    truth().state = sim::InverterState::kOperationEnabled;
    told().online = told().enabled = true;
    aim(1.0);
    place(1.0);
  }
  /// What it says in the cycles until `span` has passed; empty: nothing. What was asked for is taken in the first one.
  std::string look(Invariant& invariant, Duration span = milliseconds{10}) {
    for (const Instant end = moment_.now + span; moment_.now < end;) {
      moment_.began = moment_.now;
      moment_.now += moment_.period;
      snapshot_.time = moment_.now;
      const auto wrong = invariant.look(moment_);
      wish().asked.clear();
      if (wrong) return *wrong;
    }
    return "";
  }
  DriveTruth& truth() { return moment_.drives[0]; }
  AxisWish& wish() { return moment_.axes[0]; }
  GroupWish& group() { return moment_.groups[0]; }
  cycle::DriveSnapshot& told() { return snapshot_.drives[0]; }
  /// Where it is, and is told to be.
  void place(double position) {
    truth().position = position;
    tell(position);
  }
  void tell(double position) {
    told().position = position;
    told().joint_position = position;
  }
  void aim(double target) { told().position_target = target; }
  void ask(double target, bool onward = false) { wish().asked.push_back({onward, target}); }

  Moment moment_;
  cycle::CycleSnapshot snapshot_;
  std::vector<Call> calls_;
};

TEST_F(PositionInvariants, AnAxisThatIsEnabledIsHeld) {
  AxisMovesOnlyAsAsked invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().rotor = 0.2;
  EXPECT_THAT(look(invariant), HasSubstr("its rotor turns at 0.2 Hz, no more than 0 Hz"));
}

TEST_F(PositionInvariants, AnAxisGoesToItsTargetAndStays) {
  AxisMovesOnlyAsAsked invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  ask(2.0);
  aim(2.0);
  truth().rotor = 20.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().rotor = 27.0;
  EXPECT_THAT(look(invariant), HasSubstr("27 Hz"));
  place(2.0);
  truth().rotor = 0.0;
  EXPECT_EQ("", look(invariant, seconds{2}));
  truth().rotor = 1.0;
  EXPECT_THAT(look(invariant, milliseconds{100}), HasSubstr("1 Hz"));
}

TEST_F(PositionInvariants, ATargetBeyondTheLimitsMovesNothing) {
  AxisMovesOnlyAsAsked invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  ask(6.1);
  truth().rotor = 1.0;
  EXPECT_THAT(look(invariant), HasSubstr("no more than 0 Hz"));
}

TEST_F(PositionInvariants, AStopTakesTheTargetAway) {
  AxisMovesOnlyAsAsked invariant;
  ask(2.0);
  aim(2.0);
  EXPECT_EQ("", look(invariant, seconds{1}));
  group().asked = false;
  EXPECT_EQ("", look(invariant, seconds{2}));
  group().asked = true;
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().rotor = 1.0;
  EXPECT_THAT(look(invariant), HasSubstr("no more than 0 Hz"));
}

TEST_F(PositionInvariants, WithoutAnEnablingNoTargetCounts) {
  AxisMovesOnlyAsAsked invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  group().asked = false;
  wish().homing = true;
  ask(2.0);
  truth().rotor = 1.0;
  EXPECT_THAT(look(invariant), HasSubstr("no more than 0 Hz"));
}

TEST_F(PositionInvariants, AnAxisThatCoastsIsBroughtToRest) {
  AxisMovesOnlyAsAsked invariant;
  truth().state = sim::InverterState::kSwitchOnDisabled;
  truth().rotor = 20.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().state = sim::InverterState::kOperationEnabled;
  EXPECT_EQ("", look(invariant, milliseconds{10}));
  truth().rotor = 20.5;
  EXPECT_THAT(look(invariant), HasSubstr("20.5 Hz"));
  truth().rotor = 5.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
  EXPECT_THAT(look(invariant, seconds{3}), HasSubstr("5 Hz"));
}

TEST_F(PositionInvariants, AReferenceRunMoves) {
  AxisMovesOnlyAsAsked invariant;
  wish().homing = true;
  truth().rotor = -15.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
}

TEST_F(PositionInvariants, NoTargetLeadsBeyondTheLimits) {
  AxisWithinItsLimits invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  place(6.01);
  EXPECT_EQ("", look(invariant));
  place(-6.03);
  EXPECT_THAT(look(invariant), HasSubstr("is led to -6.03 rad"));
}

TEST_F(PositionInvariants, WhatCoastsBeyondIsLedNoFarther) {
  AxisWithinItsLimits invariant;
  truth().state = sim::InverterState::kFault;
  place(6.5);
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().state = sim::InverterState::kOperationEnabled;
  EXPECT_EQ("", look(invariant, seconds{1}));
  place(6.53);
  EXPECT_THAT(look(invariant), HasSubstr("0.53 rad beyond"));
  place(6.1);
  EXPECT_EQ("", look(invariant));
  place(6.2);
  EXPECT_THAT(look(invariant), HasSubstr("0.2 rad beyond"));
}

TEST_F(PositionInvariants, TargetsCountAndIncrementsAddUp) {
  AxisTargetsCount invariant;
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  ask(0.5, true);
  ask(2.0);
  ask(0.3, true);
  ask(0.4, true);
  aim(2.7);
  EXPECT_EQ("", look(invariant));
  ask(6.5);
  EXPECT_EQ("", look(invariant)) << "refused";
  ask(3.4, true);
  EXPECT_EQ("", look(invariant)) << "refused";
  ask(0.1, true);
  EXPECT_THAT(look(invariant), HasSubstr("the target is 2.7 rad, and what was asked for leads to 2.8 rad"));
}

TEST_F(PositionInvariants, ATargetIsNotGivenUp) {
  AxisTargetsCount invariant;
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  aim(1.1);
  EXPECT_THAT(look(invariant), HasSubstr("leads to 1 rad"));
}

TEST_F(PositionInvariants, APositionToldIsTrue) {
  AxisPositionTrue invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  tell(1.05);
  EXPECT_EQ("", look(invariant));
  tell(1.1);
  EXPECT_THAT(look(invariant), HasSubstr("is told to be at 1.1 rad, and is at 1"));
}

TEST_F(PositionInvariants, TheJointDoesNotJump) {
  AxisPositionTrue invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  told().position.reset();
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  told().joint_position = 1.4;
  EXPECT_EQ("", look(invariant)) << "unheard it may have moved";
  told().joint_position = 2.5;
  EXPECT_THAT(look(invariant), HasSubstr("its joint jumps from 1 to 2.5"));
}

// Two at one address: either answers, and what either says is true.
TEST_F(PositionInvariants, AnotherOneAtTheAddressTellsItsOwnPosition) {
  AxisPositionTrue invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  moment_.twin_position = -2.0;
  tell(-2.0);
  EXPECT_EQ("", look(invariant));
  tell(0.0);
  EXPECT_THAT(look(invariant), HasSubstr("is told to be at 0 rad"));
}

TEST_F(PositionInvariants, AnotherOneThatHasGoneIsNoExcuse) {
  AxisPositionTrue invariant;
  moment_.twin_position = -2.0;
  EXPECT_EQ("", look(invariant, seconds{1}));
  moment_.twin_position.reset();
  EXPECT_EQ("", look(invariant, seconds{4}));
  tell(-2.0);
  EXPECT_THAT(look(invariant), HasSubstr("is told to be at -2 rad"));
}

TEST_F(PositionInvariants, AReferenceRunGivesTheCountANewZero) {
  AxisPositionTrue invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  wish().homing = true;
  EXPECT_EQ("", look(invariant, milliseconds{50}));
  truth().zero = -8.0;
  truth().position = 0.0;
  EXPECT_EQ("", look(invariant, milliseconds{100})) << "held back meanwhile";
  tell(0.0);
  EXPECT_EQ("", look(invariant, milliseconds{100}));
  tell(1.0);
  EXPECT_THAT(look(invariant), HasSubstr("is told to be at 1 rad"));
}

TEST_F(PositionInvariants, ANewZeroIsAskedFor) {
  AxisPositionTrue invariant;
  EXPECT_EQ("", look(invariant, seconds{1}));
  truth().zero = -8.0;
  EXPECT_THAT(look(invariant), HasSubstr("new zero, and nobody has asked"));
}

TEST_F(PositionInvariants, WhoHasArrivedIsThere) {
  AxisPositionTrue invariant;
  told().position_reached = true;
  EXPECT_EQ("", look(invariant, seconds{1}));
  aim(1.01);
  place(1.02);
  EXPECT_EQ("", look(invariant)) << "it has passed there";
  aim(1.03);
  EXPECT_THAT(look(invariant), HasSubstr("is said to have reached its target, and is at 1.02 rad"));
}

}  // namespace
}  // namespace nord_driver::test

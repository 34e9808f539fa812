// P104 > 0: the motor turns at setpoint 0. Refused; or accepted, and then zero is OFF1.
#include <gtest/gtest.h>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

class MinimumFrequency : public DriveTest {
 protected:
  static constexpr double kHalf = 3.926990816987241;  // rad/s: 25 of 50 Hz

  explicit MinimumFrequency(bool allow = true) {
    DriveConfig configuration = config();
    configuration.allow_minimum_frequency = allow;
    drive_ = Drive{configuration};
    drive_.setMinimumFrequency(1, Hertz{5.0});
  }
  /// Enabled, at rest, and it would follow.
  void enableAtRest() {
    start();
    drive_.requestEnable(now_);
    cycle(0x0B31);
    ASSERT_EQ(Phase::kResting, report().phase);
    cycle(0x0B31);
    ASSERT_FALSE(drive_.comesToRest());
  }
  void runAtHalf() {
    enableAtRest();
    drive_.setVelocity({kHalf});
    cycle(0x0B33);
    cycle(0x0B37);
    ASSERT_EQ(Phase::kEnabled, report().phase);
    cycle(0x0B37, 0x2000);
  }
};

class MinimumFrequencyRefused : public MinimumFrequency {
 protected:
  MinimumFrequencyRefused() : MinimumFrequency(false) {}
};

TEST_F(MinimumFrequencyRefused, IsNotEnabled) {
  start();
  EXPECT_EQ(Refusal::kMinimumFrequency, drive_.enableRefusal());
  drive_.requestEnable(now_);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_DOUBLE_EQ(5.0, report().minimum_frequency.value);
  drive_.setMinimumFrequency(1, Hertz{0.0});
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(MinimumFrequencyRefused, OfASetThatIsNotInForceCountsNothing) {
  drive_.setMinimumFrequency(1, Hertz{});
  drive_.setMinimumFrequency(3, Hertz{5.0});
  start();
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(MinimumFrequencyRefused, NothingIsEnabledBeforeItHasBeenAskedFor) {
  drive_.setMinimumFrequency(1, Hertz{});
  drive_.setParametersAwaited(true);
  start();
  EXPECT_EQ(Refusal::kParametersAwaited, drive_.enableRefusal());
  drive_.setParametersAwaited(false);
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

TEST_F(MinimumFrequencyRefused, AnUnexpectedFunctionIsNotEnabled) {
  drive_.setMinimumFrequency(1, Hertz{});
  drive_.setUnexpectedFunction(1, UnexpectedFunction{543, false, 3, 1});
  start();
  EXPECT_EQ(Refusal::kUnexpectedFunction, drive_.enableRefusal());
  drive_.setUnexpectedFunction(1, std::nullopt);
  drive_.setUnexpectedFunction(2, UnexpectedFunction{543, false, 3, 1});
  EXPECT_EQ(Refusal::kNone, drive_.enableRefusal());
}

// 047F with setpoint 0 would turn the motor at once: enabled, it waits at "ready to switch on".
TEST_F(MinimumFrequency, EnabledItRestsUntilTheFirstVelocity) {
  enableAtRest();
  EXPECT_TRUE(isEnabled(report().phase));
  for (int i = 0; i < 300; ++i) ASSERT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kResting, report().phase);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// Its setpoint goes out with the first 047F: at setpoint 0 it would turn to the right, whatever is wanted.
TEST_F(MinimumFrequency, LeadsUpWithTheSetpoint) {
  enableAtRest();
  drive_.setVelocity({-kHalf});
  EXPECT_EQ(0x047F, cycle(0x0B31));
  EXPECT_EQ(-0x2000, setpoint_);
  EXPECT_EQ(0x047F, cycle(0x0B33));
  EXPECT_EQ(-0x2000, setpoint_);
  EXPECT_EQ(0x047F, cycle(0x0B37));
  EXPECT_EQ(-0x2000, setpoint_);
  EXPECT_EQ(Phase::kEnabled, report().phase);
}

TEST_F(MinimumFrequency, ZeroIsOff1AndHeldUntilReadyToSwitchOn) {
  runAtHalf();
  drive_.setVelocity({0.0});
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0, setpoint_);
  EXPECT_EQ(Phase::kResting, report().phase);
  // OFF1 is no latch: 047F during the ramp would run the motor up again.
  drive_.setVelocity({kHalf});
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(drive_.comesToRest());
    ASSERT_EQ(0x047E, cycle(0x0B37, 0x1000));
    ASSERT_EQ(0, setpoint_);
  }
  cycle(0x0B31);
  EXPECT_FALSE(drive_.comesToRest());
  EXPECT_EQ(0x047F, cycle(0x0B31));
  EXPECT_EQ(0x2000, setpoint_);
}

TEST_F(MinimumFrequency, ZeroOnTheWayUpIsOff1Again) {
  enableAtRest();
  drive_.setVelocity({kHalf});
  ASSERT_EQ(0x047F, cycle(0x0B33));
  drive_.setVelocity({0.0});
  EXPECT_EQ(0x047E, cycle(0x0B37));
  EXPECT_EQ(Phase::kResting, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

TEST_F(MinimumFrequency, AnUnaskedExitWhileDrivingIsFound) {
  runAtHalf();
  cycle(0x0B31);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kUnaskedExit, report().stop_cause);
}

TEST_F(MinimumFrequency, AStopAtTheTerminalsIsFoundAtRest) {
  enableAtRest();
  cycle(0x0B60);  // OFF2
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kOff2, report().stop_cause);
}

TEST_F(MinimumFrequency, AFaultIsFoundAtRest) {
  enableAtRest();
  cycle(0x0B38);
  EXPECT_EQ(StopCause::kFault, report().stop_cause);
}

TEST_F(MinimumFrequency, LocalControlAndAnotherSetAreFoundAtRest) {
  enableAtRest();
  cycle(0x0931);
  EXPECT_EQ(StopCause::kLocalControl, report().stop_cause);
  cycle(0x0B31);
  drive_.requestEnable(now_);
  cycle(0x0B31);
  ASSERT_EQ(Phase::kResting, report().phase);
  cycle(0x4B31);
  EXPECT_EQ(StopCause::kParameterSet, report().stop_cause);
}

TEST_F(MinimumFrequency, ALossAtRestIsLatched) {
  enableAtRest();
  fallSilent();
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
  EXPECT_EQ(0x047E, silence());
}

TEST_F(MinimumFrequency, ARampThatDoesNotEndBecomesAQuickStop) {
  runAtHalf();
  drive_.setVelocity({0.0});
  for (int i = 0; i < 105; ++i) cycle(0x0B37, 0x1000);
  EXPECT_EQ(0x047B, cycle(0x0B37, 0x1000));
  EXPECT_EQ(StopCause::kShutdownTimeout, report().stop_cause);
}

TEST_F(MinimumFrequency, ADriveThatDoesNotComeBackIsStopped) {
  enableAtRest();
  drive_.setVelocity({kHalf});
  for (int i = 0; i < 55; ++i) cycle(0x0B31);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kNotResumed, report().stop_cause);
  EXPECT_EQ(0x047E, cycle(0x0B31));
}

TEST_F(MinimumFrequency, IsDisabledFromRest) {
  enableAtRest();
  drive_.requestShutdown(now_);
  drive_.setVelocity({kHalf});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_TRUE(drive_.isAtRest());
}

// Setpoint 0 with torque is no way to rest here.
TEST_F(MinimumFrequency, SetpointZeroIsOff1) {
  runAtHalf();
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x1000));
  EXPECT_EQ(Phase::kStopping, report().phase);
}

// A drive alone: the inverter turns at P104, in the direction wanted, and the status says that it is not what was
// asked.
TEST_F(MinimumFrequency, ACommandBelowItIsTold) {
  runAtHalf();
  EXPECT_FALSE(report().saturated);
  drive_.setVelocity({kHalf / 10.0});  // 2.5 Hz
  EXPECT_EQ(0x047F, cycle(0x0B37));
  EXPECT_TRUE(report().saturated);
  drive_.setVelocity({kHalf / 4.0});  // 6.25 Hz
  cycle(0x0B37);
  EXPECT_FALSE(report().saturated);
  drive_.setVelocity({0.0});
  cycle(0x0B37);
  EXPECT_FALSE(report().saturated);
}

class MinimumFrequencyForwardOnly : public MinimumFrequency {
 protected:
  void begin(double minimum, bool inverted) {
    DriveConfig configuration = config();
    configuration.allow_minimum_frequency = true;
    configuration.reverses = false;
    configuration.joint.inverted = inverted;
    drive_ = Drive{configuration};
    drive_.setMinimumFrequency(1, Hertz{minimum});
  }
};

// At 0 rpm it would turn to the right, against the command.
TEST_F(MinimumFrequencyForwardOnly, ReverseIsOff1) {
  begin(5.0, false);
  EXPECT_EQ(1.0, drive_.onlyDirection());
  runAtHalf();
  EXPECT_FALSE(report().saturated);
  drive_.setVelocity({-kHalf});
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0, setpoint_);
  EXPECT_EQ(Phase::kResting, report().phase);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_TRUE(report().saturated);
  EXPECT_EQ(0.0, report().velocity_command.value) << "what is on the wire";
  drive_.setVelocity({kHalf});
  EXPECT_EQ(0x047F, cycle(0x0B31));
  EXPECT_EQ(0x2000, setpoint_);
  EXPECT_FALSE(report().saturated);
}

TEST_F(MinimumFrequencyForwardOnly, OfAnInvertedJointForwardIsTheReverse) {
  begin(5.0, true);
  EXPECT_EQ(-1.0, drive_.onlyDirection());
  enableAtRest();
  drive_.setVelocity({kHalf});
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_TRUE(report().saturated);
  drive_.setVelocity({-kHalf});
  EXPECT_EQ(0x047F, cycle(0x0B31));
  EXPECT_EQ(0x2000, setpoint_);
}

// Setpoint 0 is rest there, with torque.
TEST_F(MinimumFrequencyForwardOnly, WithoutP104ReverseIsZero) {
  begin(0.0, false);
  run();
  drive_.setVelocity({-kHalf});
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0, setpoint_);
  EXPECT_TRUE(report().saturated);
  EXPECT_EQ(0.0, report().velocity_command.value);
  drive_.setVelocity({0.0});
  cycle(0x0B37);
  EXPECT_FALSE(report().saturated);
}

// Its own setpoint reaches nothing: what its inverter does its leader says, which may turn it to the left.
TEST_F(MinimumFrequencyForwardOnly, OneThatIsLedTurnsBothWays) {
  DriveConfig configuration = config();
  configuration.reverses = false;
  configuration.led = true;
  drive_ = Drive{configuration};
  drive_.setMinimumFrequency(1, Hertz{});
  run();
  drive_.setVelocity({-kHalf});
  EXPECT_EQ(0x047F, cycle(0x0B37, -0x2000));
  EXPECT_FALSE(report().saturated);
  EXPECT_NEAR(-kHalf, report().velocity_command.value, 1e-9);
}

TEST_F(MinimumFrequency, ADriveThatReversesHasBothDirections) {
  EXPECT_EQ(0.0, drive_.onlyDirection());
}

}  // namespace
}  // namespace nord_driver::drive

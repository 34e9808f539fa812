// What is exactly at its bound in a group of two drives, and whom a stop of the whole group names.
#include <gtest/gtest.h>

#include "drive/drive_group.h"
#include "drive/fake_inverter.h"

namespace nord_driver::drive {
namespace {

class GroupBounds : public ::testing::Test {
 protected:
  static DriveConfig driveConfig() {
    DriveConfig config;
    config.max_frequency[0] = Hertz{50.0};
    config.enable_timeout = seconds(0.5);
    config.shutdown_timeout = seconds(3.0);
    return config;
  }
  static GroupConfig groupConfig() {
    GroupConfig config;
    config.shutdown_timeout = seconds(1.0);
    config.standstill_timeout = seconds(0.3);
    return config;
  }
  void cycle() {
    for (std::size_t i = 0; i < 2; ++i) {
      Drive& drive = drives_[i];
      if (group_.commandAllowed()) drive.setVelocity({velocity_});
      const profile::ProcessOutput output = drive.pollOutput(now_);
      profile::ProcessInput input = inverters_[i].exchange(output);
      if (coasting_[i] != 0) input.actual_values[0] = coasting_[i];
      drive.handleInput(input, true, now_ + seconds(0.01));
    }
    now_ += seconds(0.01);
    group_.update(now_);
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  void run() {
    cycles(4);
    ASSERT_TRUE(group_.requestEnable(now_).accepted());
    cycles(10);
    ASSERT_TRUE(group_.commandAllowed());
    velocity_ = 78.5;  // about half of 50 Hz at two pole pairs
    cycles(20);
  }

  /// From the cycle on in which the stop began.
  void expectOff1ForASecond() {
    for (int i = 0; i < 99; ++i) {
      cycle();
      ASSERT_EQ(0x047E, drives_[0].report().output.control_word) << i;
    }
    cycles(3);
    EXPECT_EQ(0x047B, drives_[0].report().output.control_word) << "shutdown_timeout of the group: 1 s";
  }

  Drive drives_[2] = {Drive{driveConfig()}, Drive{driveConfig()}};
  FakeInverter inverters_[2];
  std::int16_t coasting_[2] = {0, 0};  // what the motor without torque still turns at; 0: as the inverter says
  DriveGroup group_{{&drives_[0], &drives_[1]}, groupConfig()};
  Instant now_{std::chrono::hours{1}};
  double velocity_ = 0.0;
};

// Slower by exactly what counts as near standstill (164), each time just before the patience with it is over.
TEST_F(GroupBounds, ARampSlowerByTheLeastThatCountsGoesOn) {
  run();
  inverters_[0].fault = true;
  inverters_[1].ramp = 0;
  cycles(2);
  ASSERT_EQ(GroupPhase::kHalting, group_.report().phase);
  for (int step = 0; step < 3; ++step) {
    cycles(25);
    inverters_[1].ramp = 164;
    cycle();
    inverters_[1].ramp = 0;
    EXPECT_EQ(GroupPhase::kHalting, group_.report().phase) << step;
  }
  cycles(31);
  EXPECT_NE(GroupPhase::kHalting, group_.report().phase);
}

// A quick stop is nobody's fault: the first drive stands for the group.
TEST_F(GroupBounds, AQuickStopWhileEnablingNamesTheFirst) {
  cycles(4);
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  group_.requestQuickStop(now_);
  EXPECT_EQ(Refusal::kStopped, group_.report().refusal.refusal);
  EXPECT_EQ(0u, group_.report().refusal.member);
  EXPECT_EQ(0u, group_.report().stop_member);
}

TEST_F(GroupBounds, ADisableWhileEnablingNamesTheFirst) {
  cycles(4);
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  group_.requestDisable(now_);
  EXPECT_EQ(Refusal::kStopped, group_.report().refusal.refusal);
  EXPECT_EQ(0u, group_.report().refusal.member);
}

// The motor of the one that tripped coasts on, and nothing here brakes it: standstill is that of the others.
TEST_F(GroupBounds, AMotorWithoutTorqueIsNotWaitedFor) {
  run();
  inverters_[0].fault = true;
  coasting_[0] = 0x2000;
  for (int i = 0; inverters_[1].frequency() > 164 && i < 20; ++i) {
    ASSERT_NE(GroupPhase::kStopping, group_.report().phase) << "the other is still on its own ramp";
    cycle();
  }
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
}

// Nor does its coming down count as that of the other, whose own ramp does not move.
TEST_F(GroupBounds, AMotorWithoutTorqueDoesNotSlowTheOthersDown) {
  run();
  inverters_[0].fault = true;
  inverters_[1].ramp = 0;
  coasting_[0] = 0x2000;
  cycle();
  ASSERT_EQ(GroupPhase::kHalting, group_.report().phase);
  for (int i = 0; i < 31; ++i) {
    coasting_[0] = static_cast<std::int16_t>(coasting_[0] - 200);
    cycle();
  }
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase) << "standstill_timeout";
}

TEST_F(GroupBounds, AWayDownThatTakesTooLongNamesTheFirst) {
  run();
  inverters_[0].ramp = inverters_[1].ramp = 100;
  group_.requestDisable(now_);
  cycles(105);  // and nobody brings the setpoint to zero
  EXPECT_EQ(StopCause::kShutdownTimeout, group_.report().stop_cause);
  EXPECT_EQ(0u, group_.report().stop_member);
  EXPECT_EQ(0x047B, drives_[0].report().output.control_word) << "the motors still turn: quick stop";
  EXPECT_EQ(0x047B, drives_[1].report().output.control_word);
}

// The setpoint at zero is that of this way down: the one before has nothing to say of it.
TEST_F(GroupBounds, EachWayDownBeginsWithASetpointThatIsNotZero) {
  for (int round = 0; round < 2; ++round) {
    run();
    group_.requestDisable(now_);
    ASSERT_TRUE(group_.wantsZeroRamp());
    cycles(50);  // longer than standstill_timeout
    EXPECT_TRUE(group_.wantsZeroRamp()) << "round " << round << ": nobody has said that the setpoint is zero";
    velocity_ = 0.0;
    for (Drive& drive : drives_) drive.setVelocity({0.0});
    group_.setpointIsZero(true);
    cycles(30);
    ASSERT_TRUE(group_.settled());
  }
}

// All is as at first: what an enabling ended by is no answer to the next one, nor what stopped the group before.
TEST_F(GroupBounds, AnEnableBeginsWithACleanReport) {
  cycles(4);
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  group_.requestQuickStop(now_);
  EXPECT_EQ(Refusal::kStopping, group_.requestEnable(now_).refusal) << "the quick stop has not ended";
  EXPECT_FALSE(group_.settled());
  cycles(10);
  ASSERT_TRUE(group_.settled());
  EXPECT_EQ(StopCause::kQuickStop, group_.report().stop_cause);
  EXPECT_TRUE(group_.requestEnable(now_).accepted());
  EXPECT_EQ(StopCause::kNone, group_.report().stop_cause);
  EXPECT_TRUE(group_.report().refusal.accepted());
  EXPECT_EQ(0u, group_.report().refusal.member);
  cycles(10);
  ASSERT_TRUE(group_.commandAllowed());
  EXPECT_TRUE(group_.requestEnable(now_).accepted()) << "it is";
  EXPECT_TRUE(group_.commandAllowed());
}

// Every member is asked, the first one too.
TEST_F(GroupBounds, TheFirstOfThemMayRefuseToo) {
  cycles(4);
  inverters_[0].local = true;
  cycle();
  const GroupRefusal refusal = group_.requestEnable(now_);
  EXPECT_EQ(Refusal::kLocalControl, refusal.refusal);
  EXPECT_EQ(0u, refusal.member);
  EXPECT_EQ(Phase::kIdle, drives_[1].report().phase);
}

// Its members would still say yes: they are enabled until the setpoint is at zero.
TEST_F(GroupBounds, OnTheWayDownItIsNotEnabledAgain) {
  run();
  group_.requestDisable(now_);
  EXPECT_EQ(Refusal::kStopping, group_.requestEnable(now_).refusal);
  EXPECT_TRUE(group_.wantsZeroRamp());
}

// OFF1 of one that does not come down has its own time, from where it began, and then ends in a quick stop.
TEST_F(GroupBounds, Off1HasItsTimeWhereAnEnablingIsTakenBack) {
  cycles(4);
  inverters_[0].endless = true;
  inverters_[1].stuck = true;
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  cycles(10);
  ASSERT_EQ(Phase::kEnabled, drives_[0].report().phase);
  drives_[0].setVelocity({78.5});
  cycles(20);
  ASSERT_GT(inverters_[0].frequency(), 0x1000);
  group_.requestDisable(now_);
  expectOff1ForASecond();
}

TEST_F(GroupBounds, Off1HasItsTimeWhereOneTripsMeanwhile) {
  cycles(4);
  inverters_[0].endless = true;
  inverters_[1].stuck = true;
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  cycles(10);
  ASSERT_EQ(Phase::kEnabled, drives_[0].report().phase);
  drives_[0].setVelocity({78.5});
  cycles(20);
  inverters_[1].fault = true;
  cycle();
  ASSERT_EQ(GroupPhase::kStopping, group_.report().phase);
  expectOff1ForASecond();
}

TEST_F(GroupBounds, TheFirstCauseStays) {
  run();
  inverters_[1].fault = true;
  cycles(2);
  ASSERT_EQ(StopCause::kFault, group_.report().stop_cause);
  inverters_[0].silent = true;
  group_.requestQuickStop(now_);
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
  EXPECT_EQ(1u, group_.report().stop_member);
}

// Disabled, but one turns at its terminals: not at rest.
TEST_F(GroupBounds, IsNotSettledWhileAMemberTurns) {
  cycles(4);
  ASSERT_TRUE(group_.settled());
  inverters_[1].terminals = true;
  cycles(2);
  EXPECT_FALSE(group_.settled());
}

// Exactly as fast as what counts as near standstill: it is, and OFF1 may take over.
TEST_F(GroupBounds, StandstillIsNearUpToItsBound) {
  run();
  inverters_[0].ramp = inverters_[1].ramp = 0;
  coasting_[0] = coasting_[1] = 165;
  group_.requestDisable(now_);
  group_.setpointIsZero(true);
  cycles(2);
  EXPECT_EQ(GroupPhase::kRampingDown, group_.report().phase);
  coasting_[0] = 164;
  coasting_[1] = -164;
  cycle();
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
}

// Its bound runs on from where the way down began: the program that ends waits for no second one.
TEST_F(GroupBounds, DisablingWhileTheOthersHaltKeepsTheBound) {
  run();
  inverters_[0].fault = true;
  inverters_[1].ramp = 1;
  inverters_[1].endless = true;
  cycles(2);
  ASSERT_EQ(GroupPhase::kHalting, group_.report().phase);
  cycles(20);
  ASSERT_EQ(GroupPhase::kHalting, group_.report().phase);
  group_.requestDisable(now_);
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
  cycles(70);
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
  cycles(20);
  EXPECT_NE(GroupPhase::kStopping, group_.report().phase) << "a second after the fault: OFF3";
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
}

}  // namespace
}  // namespace nord_driver::drive

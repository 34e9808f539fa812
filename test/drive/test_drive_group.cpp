// Two drives that stand or fall together, each with an inverter that follows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "drive/drive_group.h"
#include "drive/fake_inverter.h"

namespace nord_driver::drive {
namespace {

class DriveGroupTest : public ::testing::Test {
 protected:
  static constexpr Duration kCycle = seconds(0.01);

  static DriveConfig config() {
    DriveConfig result;
    result.max_frequency[0] = Hertz{50.0};
    result.enable_timeout = seconds(0.5);
    result.shutdown_timeout = seconds(3.0);
    return result;
  }
  static GroupConfig groupConfig() {
    GroupConfig result;
    result.shutdown_timeout = seconds(1.0);
    result.standstill_timeout = seconds(0.3);
    return result;
  }

  void cycle() {
    const profile::ProcessOutput to_left = left_.pollOutput(now_);
    const profile::ProcessOutput to_right = right_.pollOutput(now_);
    now_ += kCycle;
    left_.handleInput(left_inverter_.exchange(to_left), !left_inverter_.silent, now_);
    right_.handleInput(right_inverter_.exchange(to_right), !right_inverter_.silent, now_);
    group_.update(now_);
    if (group_.commandAllowed()) {
      left_.setVelocity({velocity_});
      right_.setVelocity({velocity_});
    } else if (group_.wantsZeroRamp()) {
      velocity_ = std::max(0.0, velocity_ - 5.0);
      left_.setVelocity({velocity_});
      right_.setVelocity({velocity_});
      group_.setpointIsZero(velocity_ == 0.0);
    }
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i) cycle();
  }
  /// The cycles until the group is in the phase; at most `limit`.
  int cyclesUntil(GroupPhase phase, int limit) {
    int count = 0;
    while (group_.report().phase != phase && count < limit) {
      cycle();
      ++count;
    }
    return count;
  }
  void run() {
    cycles(4);
    ASSERT_TRUE(group_.requestEnable(now_).accepted());
    ASSERT_LT(cyclesUntil(GroupPhase::kEnabled, 20), 20);
    velocity_ = 78.5;  // about half of 50 Hz at two pole pairs
    cycles(20);
    ASSERT_GT(left_inverter_.frequency(), 0x1F00);
    ASSERT_GT(right_inverter_.frequency(), 0x1F00);
  }
  Word leftWord() const { return left_.report().output.control_word; }
  Word rightWord() const { return right_.report().output.control_word; }

  Drive left_{config()};
  Drive right_{config()};
  FakeInverter left_inverter_;
  FakeInverter right_inverter_;
  DriveGroup group_{{&left_, &right_}, groupConfig()};
  Instant now_{std::chrono::hours{1}};
  double velocity_ = 0.0;
};

TEST_F(DriveGroupTest, EnablesAllAndFollowsCommandsOnlyThen) {
  cycles(4);
  EXPECT_TRUE(group_.settled());
  EXPECT_TRUE(group_.requestEnable(now_).accepted());
  EXPECT_FALSE(group_.commandAllowed());
  cyclesUntil(GroupPhase::kEnabled, 20);
  EXPECT_TRUE(group_.commandAllowed());
  EXPECT_FALSE(group_.settled());
  EXPECT_EQ(0x047F, leftWord());
  EXPECT_EQ(0x047F, rightWord());
}

// Both wheels are lost: nothing of it moves, but it has not yet been told.
TEST_F(DriveGroupTest, IsNotSettledBeforeItHasLookedAtItsDrives) {
  run();
  for (Drive* drive : {&left_, &right_}) {
    drive->handleInput({}, false, now_ + std::chrono::seconds{1});
    ASSERT_TRUE(drive->isAtRest());
  }
  EXPECT_FALSE(group_.settled());
}

// One that refuses: none is enabled, and the answer names it.
TEST_F(DriveGroupTest, EnablesNoneWhenOneRefuses) {
  cycles(4);
  right_inverter_.local = true;
  cycles(1);
  const GroupRefusal refusal = group_.requestEnable(now_);
  EXPECT_EQ(Refusal::kLocalControl, refusal.refusal);
  EXPECT_EQ(1u, refusal.member);
  cycles(5);
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_EQ(Phase::kIdle, left_.report().phase);
}

// One that does not follow takes the others back.
TEST_F(DriveGroupTest, TakesAllBackWhenOneDoesNotFollow) {
  cycles(4);
  left_inverter_.stuck = true;
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  cycles(70);
  EXPECT_EQ(GroupPhase::kDisabled, group_.report().phase);
  EXPECT_EQ(Refusal::kEnableTimeout, group_.report().refusal.refusal);
  EXPECT_EQ(0u, group_.report().refusal.member);
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_EQ(0x047E, rightWord());
  EXPECT_TRUE(group_.settled());
}

TEST_F(DriveGroupTest, TakesAllBackWhenOneTripsMeanwhile) {
  cycles(4);
  ASSERT_TRUE(group_.requestEnable(now_).accepted());
  cycle();
  right_inverter_.fault = true;
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
  EXPECT_EQ(Refusal::kStopped, group_.report().refusal.refusal);
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
  EXPECT_EQ(1u, group_.report().stop_member);
  EXPECT_EQ(0x047E, leftWord());
}

// enable false: the setpoint ramps to zero from above, then OFF1 until "ready to switch on".
TEST_F(DriveGroupTest, RampsDownThenOff1) {
  run();
  cycles(150);  // longer than shutdown_timeout, which counts from the request
  group_.requestDisable(now_);
  EXPECT_TRUE(group_.wantsZeroRamp());
  EXPECT_FALSE(group_.commandAllowed());
  for (int i = 0; i < 100 && group_.wantsZeroRamp(); ++i) {
    EXPECT_EQ(0x047F, leftWord());
    cycle();
  }
  EXPECT_EQ(0.0, velocity_);
  EXPECT_LT(left_inverter_.frequency(), 200);
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
  cycle();
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_EQ(0x047E, rightWord());
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
  EXPECT_TRUE(group_.settled());
  EXPECT_EQ(StopCause::kNone, group_.report().stop_cause);
}

// Standstill has no direction: backwards, OFF1 waits for it as well.
TEST_F(DriveGroupTest, RampsDownFromBackwards) {
  run();
  velocity_ = -78.5;
  cycles(40);
  ASSERT_LT(left_inverter_.frequency(), -0x1F00);
  left_inverter_.ramp = right_inverter_.ramp = 0x0200;
  velocity_ = 0.0;  // the setpoint comes down at once, the inverters in 16 cycles
  group_.requestDisable(now_);
  cyclesUntil(GroupPhase::kStopping, 25);
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
  EXPECT_GT(left_inverter_.frequency(), -200);
}

// With P104 > 0 standstill never comes at setpoint 0: OFF1 takes over after a bounded wait.
TEST_F(DriveGroupTest, DoesNotWaitForeverForStandstill) {
  run();
  left_inverter_.ramp = 10;
  group_.requestDisable(now_);
  EXPECT_LE(cyclesUntil(GroupPhase::kStopping, 100), 60);
  EXPECT_EQ(GroupPhase::kStopping, group_.report().phase);
  EXPECT_GT(left_inverter_.frequency(), 0x1000);
}

TEST_F(DriveGroupTest, QuickStopsWhenTheWayDownTakesTooLong) {
  run();
  left_inverter_.endless = true;
  left_inverter_.ramp = 10;
  group_.requestDisable(now_);
  EXPECT_LE(cyclesUntil(GroupPhase::kQuickStopping, 200), 102);
  cycle();
  EXPECT_EQ(0x047B, leftWord());
  EXPECT_EQ(StopCause::kShutdownTimeout, group_.report().stop_cause);
}

// A fault: that drive idles in the next cycle, the other runs down its own ramp with torque on, then OFF1.
TEST_F(DriveGroupTest, HaltsTheOthersWhenOneTrips) {
  run();
  right_inverter_.fault = true;
  cycle();
  EXPECT_EQ(GroupPhase::kHalting, group_.report().phase);
  EXPECT_FALSE(group_.commandAllowed());
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
  EXPECT_EQ(1u, group_.report().stop_member);
  cycle();
  EXPECT_EQ(0x047E, rightWord());
  EXPECT_EQ(0x047F, leftWord());
  EXPECT_EQ(0, left_.report().output.setpoints[0]);
  for (int i = 0; i < 100 && group_.report().phase == GroupPhase::kHalting; ++i) {
    EXPECT_EQ(0x047F, leftWord());
    cycle();
  }
  EXPECT_LT(left_inverter_.frequency(), 200);
  cycle();
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
  right_inverter_.fault = false;
  cycles(20);
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_EQ(0x047E, rightWord());
  EXPECT_EQ(Refusal::kFaultLatched, group_.requestEnable(now_).refusal);
}

TEST_F(DriveGroupTest, HaltsTheOthersWhenOneFallsSilent) {
  run();
  left_inverter_.silent = true;
  EXPECT_LE(cyclesUntil(GroupPhase::kHalting, 20), 6);
  EXPECT_EQ(StopCause::kSilent, group_.report().stop_cause);
  EXPECT_EQ(0u, group_.report().stop_member);
  cycle();
  EXPECT_EQ(0, right_.report().output.setpoints[0]);
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 100), 100);
  EXPECT_TRUE(group_.settled());
  left_inverter_.silent = false;
  cycles(50);
  EXPECT_EQ(GroupPhase::kDisabled, group_.report().phase);
  EXPECT_EQ(0, left_inverter_.frequency());
  EXPECT_TRUE(group_.requestEnable(now_).accepted());
}

// With P104 > 0 the others turn on at setpoint 0, and the base around the drive without torque: OFF1 as soon as they do
// not get slower any more.
TEST_F(DriveGroupTest, HaltsADriveThatTurnsAtSetpointZero) {
  run();
  left_inverter_.minimum = 0x0800;
  right_inverter_.fault = true;
  cycle();
  ASSERT_EQ(GroupPhase::kHalting, group_.report().phase);
  EXPECT_LE(cyclesUntil(GroupPhase::kStopping, 200), 50) << "its ramp of 6 cycles, 0.3 s, and never a whole second";
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
  EXPECT_EQ(0, left_inverter_.frequency());
}

// A long ramp of its own is not cut short: OFF1 would take the torque away where it ends.
TEST_F(DriveGroupTest, LetsALongRampEndWhenOneTrips) {
  run();
  left_inverter_.ramp = 0x0080;  // 64 cycles, twice standstill_timeout
  right_inverter_.fault = true;
  cycle();
  for (int i = 0; left_inverter_.frequency() > 0x0100; ++i) {
    ASSERT_LT(i, 100) << "the left one is not braked: it turns at " << left_inverter_.frequency();
    ASSERT_EQ(GroupPhase::kHalting, group_.report().phase) << left_inverter_.frequency();
    ASSERT_EQ(0x047F, leftWord());
    cycle();
  }
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
}

// Its ramp is waited for, and OFF1 has its own time after that: nothing brakes hard that comes down all the while.
TEST_F(DriveGroupTest, BoundsTheWayDownWhenOneTrips) {
  run();
  left_inverter_.ramp = 50;  // 1.6 s
  right_inverter_.fault = true;
  cycle();
  EXPECT_EQ(100, cyclesUntil(GroupPhase::kStopping, 200)) << "shutdown_timeout";
  for (int i = 0; left_inverter_.frequency() > 0; ++i) {
    ASSERT_LT(i, 200) << "OFF1 does not end: the left one turns at " << left_inverter_.frequency();
    cycle();
    ASSERT_EQ(0x047E, leftWord());
  }
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 20), 20);
}

TEST_F(DriveGroupTest, HaltsUnderLocalControl) {
  run();
  right_inverter_.local = true;
  cycles(2);
  EXPECT_EQ(StopCause::kLocalControl, group_.report().stop_cause);
  EXPECT_EQ(0x047E, rightWord());
  EXPECT_EQ(0, left_.report().output.setpoints[0]);
}

TEST_F(DriveGroupTest, QuickStopsAllInTheNextCycle) {
  run();
  group_.requestQuickStop(now_);
  cycle();
  EXPECT_EQ(0x047B, leftWord());
  EXPECT_EQ(0x047B, rightWord());
  EXPECT_EQ(Refusal::kStopping, group_.requestEnable(now_).refusal);
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 50), 50);
  cycles(5);
  EXPECT_EQ(0x047E, leftWord());
  EXPECT_EQ(StopCause::kQuickStop, group_.report().stop_cause);
  EXPECT_TRUE(group_.settled());
}

// A quick stop of one member alone is a stop of the base.
TEST_F(DriveGroupTest, HaltsWhenOneMemberIsQuickStopped) {
  run();
  left_.requestQuickStop(now_);
  cycles(2);
  EXPECT_EQ(StopCause::kQuickStop, group_.report().stop_cause);
  EXPECT_EQ(0, right_.report().output.setpoints[0]);
}

// A member that trips during the way down: the others go on down, nothing waits for it.
TEST_F(DriveGroupTest, SurvivesATripOnTheWayDown) {
  run();
  group_.requestDisable(now_);
  cycles(2);
  left_inverter_.fault = true;
  EXPECT_LT(cyclesUntil(GroupPhase::kDisabled, 100), 100);
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
  EXPECT_EQ(0, right_inverter_.frequency());
}

// Whoever asked for the stop waits for shutdown_timeout: a trip on the way does not begin it anew.
TEST_F(DriveGroupTest, ATripOnTheWayDownDoesNotMakeItLonger) {
  run();
  right_inverter_.ramp = 20;  // 4 s
  group_.requestDisable(now_);
  cycles(5);
  left_inverter_.fault = true;
  EXPECT_LE(cyclesUntil(GroupPhase::kQuickStopping, 200), 96) << "shutdown_timeout, 100 cycles behind the request";
  cycle();
  EXPECT_EQ(0x047B, rightWord());
  EXPECT_EQ(StopCause::kFault, group_.report().stop_cause);
}

TEST_F(DriveGroupTest, DisablesWhileEnabling) {
  cycles(4);
  group_.requestEnable(now_);
  cycles(2);
  group_.requestDisable(now_);
  cycles(5);
  EXPECT_EQ(GroupPhase::kDisabled, group_.report().phase);
  EXPECT_EQ(Refusal::kStopped, group_.report().refusal.refusal);
  EXPECT_EQ(0x047E, leftWord());
}

TEST(DriveGroup, NeedsMembers) {
  EXPECT_THROW(DriveGroup({}), std::invalid_argument);
  EXPECT_THROW(DriveGroup({nullptr}), std::invalid_argument);
}

// It goes by another inverter's setpoint: 0 in ours would let it run on.
TEST(LedDrive, IsStoppedByOff1WhereOthersGetSetpointZero) {
  DriveConfig config;
  config.max_frequency[0] = Hertz{50.0};
  config.led = true;
  Drive drive{config};
  Instant now{};
  const auto cycle = [&](Word status) {
    const Word word = drive.pollOutput(now).control_word;
    now += seconds(0.01);
    profile::ProcessInput input;
    input.status_word = status;
    input.actual_values = {8192, 0, 0};
    drive.handleInput(input, true, now);
    return word;
  };
  cycle(0x0B31);
  cycle(0x0B31);
  drive.requestEnable(now);
  cycle(0x0B31);
  cycle(0x0B37);
  ASSERT_EQ(Phase::kEnabled, drive.report().phase);
  ASSERT_EQ(0x047F, cycle(0x0B37));
  drive.requestSetpointZero(now);
  EXPECT_EQ(0x047E, cycle(0x0B37));
}

}  // namespace
}  // namespace nord_driver::drive

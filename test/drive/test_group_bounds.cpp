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
      drive.handleInput(inverters_[i].exchange(output), true, now_ + seconds(0.01));
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

  Drive drives_[2] = {Drive{driveConfig()}, Drive{driveConfig()}};
  FakeInverter inverters_[2];
  DriveGroup group_{{&drives_[0], &drives_[1]}, groupConfig()};
  Instant now_{};
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

TEST_F(GroupBounds, AWayDownThatTakesTooLongNamesTheFirst) {
  run();
  group_.requestDisable(now_);
  cycles(105);  // and nobody brings the setpoint to zero
  EXPECT_EQ(StopCause::kShutdownTimeout, group_.report().stop_cause);
  EXPECT_EQ(0u, group_.report().stop_member);
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

// A connection that is reset, or leaves operation, under a drive.
#include <gtest/gtest.h>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

// A connection that was reset is no silence: what the inverter heard last is not known, also when it answers at once.
TEST_F(DriveTest, AnInterruptedConnectionStopsItAtOnce) {
  run();
  drive_.handleInterruption(StopCause::kInterrupted, now_);
  EXPECT_FALSE(report().online);
  EXPECT_EQ(StopCause::kInterrupted, report().stop_cause);
  EXPECT_EQ(0x0B37, report().stop_status_word);
  EXPECT_EQ(0x047E, silence()) << "it may hear us";
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x2000));
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x1F00));
}

TEST_F(DriveTest, AnInterruptionWithinACycleIsSeenToo) {
  run();
  drive_.pollOutput(now_);
  now_ += kCycle;
  drive_.handleInterruption(StopCause::kInterrupted, now_);
  profile::ProcessInput input;
  input.status_word = 0x8B37;
  drive_.handleInput(input, true, now_);
  EXPECT_TRUE(report().online);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kInterrupted, report().stop_cause);
  EXPECT_EQ(0x847E, cycle(0x8B37)) << "in the set it reports now";
}

// An idle drive has nothing to be stopped; one that is being enabled is refused.
TEST_F(DriveTest, AnInterruptionOfADriveThatIsNotDriven) {
  start();
  drive_.handleInterruption(StopCause::kInterrupted, now_);
  EXPECT_FALSE(report().online);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
  start();
  drive_.requestEnable(now_);
  drive_.handleInterruption(StopCause::kInterrupted, now_);
  EXPECT_EQ(Refusal::kOffline, report().refusal);
  EXPECT_EQ(StopCause::kInterrupted, report().stop_cause);
  EXPECT_EQ(0x047E, silence());
}

}  // namespace
}  // namespace nord_driver::drive

// An enable that waits: for parameters that are being read, or until the commands have been listened to for long enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/drives_under_supervision.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class WaitingEnables : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  void SetUp() override { bringUp(); }
};

TEST_F(WaitingEnables, WaitForTheParametersOfEachDrive) {
  for (const DriveIndex awaited : {kLeft, kRight, kLift}) {
    DrivesUnderSupervision robot;
    robot.bringUp();
    robot.drives[awaited].setParametersAwaited(true);
    robot.request(1, RequestKind::kEnable);
    for (int i = 0; i < 20; ++i) {
      robot.step();
      ASSERT_TRUE(robot.noneRuns()) << awaited;
    }
    EXPECT_THAT(robot.answersTo(1), IsEmpty());
    robot.drives[awaited].setParametersAwaited(false);
    robot.run(20);
    EXPECT_THAT(robot.answersTo(1), ElementsAre("yes: enabled"));
    EXPECT_TRUE(robot.allEnabled());
  }
}

TEST_F(WaitingEnables, DoNotWaitBesideADriveThatRefuses) {
  inverters[kLift].silent = true;
  run(20);
  drives[kLeft].setParametersAwaited(true);
  request(1, RequestKind::kEnable);
  step();
  EXPECT_THAT(answersTo(1), ElementsAre(HasSubstr("drive lift: the inverter does not answer")));
}

TEST_F(WaitingEnables, DoNotAskWhatIsEnabledAlready) {
  for (const DriveIndex asked : {kLift, kAllDrives}) {
    DrivesUnderSupervision robot;
    robot.bringUp();
    ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
    ASSERT_TRUE(robot.ask(RequestKind::kDisable, kLift).success);
    robot.drives[kLift].setParametersAwaited(true);
    robot.request(1, RequestKind::kEnable, asked);
    robot.run(20);
    EXPECT_THAT(robot.answersTo(1), IsEmpty());
    robot.drives[kLift].setParametersAwaited(false);
    robot.run(20);
    EXPECT_THAT(robot.answersTo(1), ElementsAre("yes: enabled"));
  }
}

// The base comes down its ramp: its drives are enabled still, and none of them refuses.
TEST_F(WaitingEnables, DoNotWaitForTheEndOfAStop) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  ASSERT_TRUE(ask(RequestKind::kDisable, kLift).success);
  velocity = 50.0;
  run(40);
  request(1, RequestKind::kDisable, kLeft);
  ASSERT_EQ(drive::GroupPhase::kRampingDown, supervisor.groupOf(kLeft).report().phase);
  for (const bool awaited : {false, true}) {
    drives[kLift].setParametersAwaited(awaited);
    request(awaited ? 2 : 3, RequestKind::kEnable);
    EXPECT_EQ(drive::Phase::kIdle, drives[kLift].report().phase) << "all or none";
  }
  step();
  EXPECT_THAT(answersTo(2), ElementsAre(StartsWith("no: drive left: the drive is still being stopped")));
  EXPECT_THAT(answersTo(3), ElementsAre(StartsWith("no: drive left: the drive is still being stopped")));
}

// Whoever stops one wheel does not want the base enabled, which is a part of what waits.
TEST_F(WaitingEnables, EndWithAStopOfAPart) {
  to_hear = std::chrono::milliseconds{500};
  request(1, RequestKind::kEnable);
  request(2, RequestKind::kQuickStop, kRight);
  to_hear = Duration::zero();
  run(20);
  EXPECT_THAT(answersTo(1), ElementsAre("no: disabled again before all drives were enabled"));
  EXPECT_TRUE(noneRuns());
}

TEST_F(WaitingEnables, DoNotEndWithAStopOfOthers) {
  to_hear = std::chrono::milliseconds{500};
  request(1, RequestKind::kEnable, kLift);
  request(2, RequestKind::kQuickStop, kRight);
  run(5);
  to_hear = Duration::zero();
  run(20);
  EXPECT_THAT(answersTo(1), ElementsAre("yes: enabled"));
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase);
}

// One publisher after the other is connected: the answer comes when its asker goes, and nothing after it.
TEST_F(WaitingEnables, AreRefusedWhenTheirTimeIsOver) {
  to_hear = std::chrono::milliseconds{50};
  request(1, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{100});
  run(9);
  EXPECT_THAT(answersTo(1), IsEmpty());
  step();
  EXPECT_THAT(answersTo(1), ElementsAre(StartsWith("no: cmd_vel has been listened to for 0.0 s only")));
  to_hear = Duration::zero();
  run(50);
  EXPECT_EQ(1u, answersTo(1).size());
  EXPECT_TRUE(noneRuns());
}

// ... so one that waits for parameters: in the cycle in which its time is over, not in the one after it.
TEST_F(WaitingEnables, AreAnsweredWhenTheirTimeIsOverThoughParametersAreMissing) {
  drives[kLeft].setParametersAwaited(true);
  request(1, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{100});
  run(9);
  EXPECT_THAT(answersTo(1), IsEmpty());
  step();
  EXPECT_THAT(answersTo(1), ElementsAre(StartsWith("no: ")));
  EXPECT_TRUE(noneRuns());
}

// A failed enabling takes back what it has begun. What somebody else has enabled while it waited goes on.
TEST_F(WaitingEnables, TakeBackOnlyWhatTheyHaveBegun) {
  drives[kLeft].setParametersAwaited(true);
  request(1, RequestKind::kEnable);
  step();
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  inverters[kLeft].stuck = true;
  drives[kLeft].setParametersAwaited(false);
  run(50);
  EXPECT_THAT(answersTo(1), ElementsAre(HasSubstr("drive left")));
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase);
  EXPECT_TRUE(drives[kRight].isAtRest());
}

// Refused for parameters that did not come in its time, it has begun nothing; auto_enable goes on when they are there.
TEST_F(WaitingEnables, LeaveAutoEnableWhatItWasWhenTheyAreRefused) {
  DrivesUnderSupervision robot{true};
  for (auto& drive : robot.drives) drive.setParametersAwaited(true);
  robot.bringUp();
  robot.request(1, RequestKind::kEnable, kLift, std::chrono::milliseconds{100});
  robot.run(20);
  ASSERT_EQ(1u, robot.answersTo(1).size());
  EXPECT_THAT(robot.answersTo(1).front(), StartsWith("no: drive lift: "));
  for (auto& drive : robot.drives) drive.setParametersAwaited(false);
  robot.run(20);
  EXPECT_TRUE(robot.allEnabled());
}

// While it waits for one drive, auto_enable does not bring up all of them.
TEST_F(WaitingEnables, AreNotOvertakenByAutoEnable) {
  DrivesUnderSupervision robot{true};
  robot.drives[kLift].setParametersAwaited(true);
  robot.bringUp();
  robot.request(1, RequestKind::kEnable, kLift);
  robot.step();
  robot.drives[kLift].setParametersAwaited(false);
  robot.run(30);
  EXPECT_THAT(robot.answersTo(1), ElementsAre("yes: enabled"));
  for (const DriveIndex wheel : {kLeft, kRight}) EXPECT_TRUE(robot.drives[wheel].isAtRest());
}

// Who does not wait is not sent away to wait for what has been heard.
TEST_F(WaitingEnables, AreNotToldToAskAgainForWhatWasHeard) {
  EXPECT_THAT(ask(RequestKind::kEnable, kAllDrives, Duration::zero()).message.c_str(),
              HasSubstr("did not reach \"operation enabled\" in time"));
}

}  // namespace
}  // namespace nord_driver::cycle

// Enabling: all drives or none, refusals in words, and what undoes it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/drives_under_supervision.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class SupervisorEnable : public ::testing::Test, protected DrivesUnderSupervision {};

TEST_F(SupervisorEnable, EnablesAllDrivesAndAnswersWhenAllFollow) {
  bringUp();
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_STREQ("enabled", answer.message.c_str());
  EXPECT_TRUE(allEnabled());
  EXPECT_FALSE(supervisor.settled());
}

// One drive that refuses at once keeps all others back: not one 047F leaves.
TEST_F(SupervisorEnable, RefusesForAllWhenOneDriveIsOffline) {
  inverters[kLift].silent = true;
  bringUp();
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), StartsWith("drive lift: the inverter does not answer"));
  for (int i = 0; i < 50; ++i) {
    step();
    ASSERT_TRUE(noneRuns());
  }
  EXPECT_TRUE(supervisor.settled());
}

TEST_F(SupervisorEnable, TakesAllBackWhenOneDriveDoesNotFollow) {
  bringUp();
  inverters[kLift].stuck = true;
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive lift"));
  EXPECT_THAT(answer.message.c_str(), HasSubstr("did not reach \"operation enabled\" in time"));
  run(20);
  EXPECT_TRUE(noneRuns());
  EXPECT_TRUE(supervisor.settled());
}

// A request that ran out of patience has failed: nothing may come up behind its back afterwards.
TEST_F(SupervisorEnable, AnEnableThatIsGivenUpIsTakenBack) {
  bringUp();
  inverters[kLift].stuck = true;
  const Completion answer = ask(RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{100});
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(),
              StartsWith("drive lift: the inverter did not reach \"operation enabled\" in time "));
  inverters[kLift].stuck = false;  // now it would follow
  for (int i = 0; i < 50; ++i) {
    step();
    ASSERT_NE(drive::Phase::kEnabled, drives[kLift].report().phase);
  }
  EXPECT_TRUE(noneRuns());
}

TEST_F(SupervisorEnable, RefusesWhileTheNewestCommandMoves) {
  bringUp();
  moving = "the newest cmd_vel is not zero";
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("the newest cmd_vel is not zero", answer.message.c_str());
  EXPECT_TRUE(noneRuns());
}

// Who has sent zero shall not learn only then of the fault, and after it of the drive that is off.
TEST_F(SupervisorEnable, NamesEveryReasonFaultAndAbsenceFirst) {
  inverters[kRight].fault = inverters[kLift].silent = true;
  bringUp();
  moving = "the newest cmd_vel is not zero (0.250 m/s, 0.500 rad/s, 0.02 s old): send zero first";
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ(
      "drive right: the inverter reports a fault (when its cause is gone: ~acknowledge_faults); drive lift: the "
      "inverter "
      "does not answer; the newest cmd_vel is not zero",
      answer.message.c_str());
  EXPECT_TRUE(noneRuns());
}

TEST_F(SupervisorEnable, NamesDrivesWithOneReasonTogether) {
  inverters[kRight].silent = inverters[kLift].silent = true;
  inverters[kLeft].local = true;
  bringUp();
  EXPECT_STREQ(
      "drives right, lift: the inverter does not answer; drive left: the inverter is under local control (status bit 9 "
      "= 0)",
      ask(RequestKind::kEnable).message.c_str());
  EXPECT_STREQ("drive lift: the inverter does not answer", ask(RequestKind::kEnable, kLift).message.c_str())
      << "of the drives that were asked";
}

// Both wheels and the lift have a fault that went by itself.
TEST_F(SupervisorEnable, NamesTheServiceThatIsDueForALatchedFault) {
  bringUp();
  for (auto& inverter : inverters) inverter.fault = true;
  run(2);
  for (auto& inverter : inverters) inverter.fault = false;
  run(2);
  EXPECT_STREQ("drives left, right, lift: a fault was seen and has not been acknowledged (~acknowledge_faults)",
               ask(RequestKind::kEnable).message.c_str());
}

TEST_F(SupervisorEnable, RefusesUnderLocalControlAndOverAFault) {
  inverters[kLeft].local = true;
  bringUp();
  EXPECT_THAT(ask(RequestKind::kEnable).message.c_str(), HasSubstr("drive left: the inverter is under local control"));
  inverters[kLeft].local = false;
  inverters[kRight].fault = true;
  run(2);
  EXPECT_THAT(ask(RequestKind::kEnable).message.c_str(), StartsWith("drive right: the inverter reports a fault"));
  EXPECT_TRUE(noneRuns());
}

// A wheel of a base alone would turn the base.
TEST_F(SupervisorEnable, RefusesADriveOfTheBaseAlone) {
  bringUp();
  const Completion answer = ask(RequestKind::kEnable, kRight);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("drive right belongs to the base: use ~enable", answer.message.c_str());
  EXPECT_TRUE(noneRuns());
}

// A stop is never refused: that of one wheel is one of the base, as its quick stop is.
TEST_F(SupervisorEnable, DisablingADriveOfTheBaseDisablesTheBase) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  const Completion answer = ask(RequestKind::kDisable, kRight);
  EXPECT_TRUE(answer.success);
  EXPECT_STREQ("disabled", answer.message.c_str());
  EXPECT_EQ(drive::Phase::kIdle, drives[kLeft].report().phase);
  EXPECT_EQ(drive::Phase::kIdle, drives[kRight].report().phase);
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase) << "no drive of the base";
}

// All or none of what is asked for now: what somebody has enabled before goes on.
TEST_F(SupervisorEnable, ARefusedEnableLeavesWhatWasEnabledBefore) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kDisable).success);
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  inverters[kRight].fault = true;
  run(2);
  EXPECT_FALSE(ask(RequestKind::kEnable).success) << "the base has a fault";
  run(50);
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase);
  EXPECT_TRUE(drives[kLeft].isAtRest());
}

TEST_F(SupervisorEnable, AnEnablingThatFailsLeavesWhatWasEnabledBefore) {
  for (const Duration patience : {Duration{std::chrono::seconds{3}}, Duration{std::chrono::milliseconds{100}}}) {
    DrivesUnderSupervision robot;
    robot.bringUp();
    ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
    ASSERT_TRUE(robot.ask(RequestKind::kDisable, kLift).success);
    robot.inverters[kLift].stuck = true;
    EXPECT_FALSE(robot.ask(RequestKind::kEnable, kAllDrives, patience).success);
    robot.run(50);
    EXPECT_EQ(drive::Phase::kEnabled, robot.drives[kLeft].report().phase);
    EXPECT_EQ(drive::Phase::kEnabled, robot.drives[kRight].report().phase);
    EXPECT_TRUE(robot.drives[kLift].isAtRest());
  }
}

TEST_F(SupervisorEnable, EnablesASingleDriveBesideTheBase) {
  bringUp();
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase);
  EXPECT_EQ(drive::Phase::kIdle, drives[kLeft].report().phase);
  EXPECT_EQ(0x047E, outputs[kLeft].control_word);
  EXPECT_EQ(0x047E, outputs[kRight].control_word);
}

TEST_F(SupervisorEnable, EnablingWhatIsEnabledIsGranted) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  EXPECT_TRUE(ask(RequestKind::kEnable).success);
  EXPECT_TRUE(allEnabled());
}

// Nothing is begun then: the command is already followed.
TEST_F(SupervisorEnable, EnablingWhatIsEnabledIsGrantedWhileItDrives) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  moving = "the newest cmd_vel is not zero";
  velocity = 3.0;
  run(5);
  const Completion again = ask(RequestKind::kEnable);
  EXPECT_TRUE(again.success);
  EXPECT_STREQ("already enabled", again.message.c_str());
  EXPECT_TRUE(ask(RequestKind::kEnable, kLift).success);
  run(5);
  EXPECT_TRUE(allEnabled());
  ASSERT_TRUE(ask(RequestKind::kDisable, kLift).success);
  EXPECT_STREQ("the newest cmd_vel is not zero", ask(RequestKind::kEnable).message.c_str()) << "the lift is not";
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLeft].report().phase) << "a refusal takes back nothing that was enabled";
}

// Found by the campaign (devicenet, 60297): held up for longer than the drives' time-out the driver still has their status
// words from before, and what they have become since is in the next ones.
TEST_F(SupervisorEnable, WhatWasEnabledBeforeAHoldUpIsNotGrantedUnseen) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  inverters[kLeft].fault = true;
  const Completion again = ask(RequestKind::kEnable);
  EXPECT_FALSE(again.success) << again.message.c_str();
}

TEST_F(SupervisorEnable, WhatIsEnabledAndSilentIsNotGrantedUnseen) {
  bringUp();
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  inverters[kLeft].silent = true;
  const Completion again = ask(RequestKind::kEnable);
  EXPECT_FALSE(again.success) << again.message.c_str();
}

TEST_F(SupervisorEnable, AStopDuringTheEnablingEndsItForItsAsker) {
  bringUp();
  request(1, RequestKind::kEnable);
  step();
  EXPECT_TRUE(ask(RequestKind::kDisable).success);
  ASSERT_FALSE(completions.empty());
  EXPECT_EQ(1u, completions[0].id);
  EXPECT_FALSE(completions[0].success);
  EXPECT_TRUE(noneRuns());
}

TEST_F(SupervisorEnable, NothingIsEnabledAfterShutDown) {
  bringUp();
  EXPECT_TRUE(ask(RequestKind::kShutDown).success);
  const Completion answer = ask(RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("the node is ending", answer.message.c_str());
  EXPECT_TRUE(noneRuns());
}

/// auto_enable: once, when every drive has first become ready after start.
class AutoEnable : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  AutoEnable() : DrivesUnderSupervision{true} {}
};

TEST_F(AutoEnable, ActsWhenTheLastDriveHasBecomeReady) {
  inverters[kLift].silent = true;
  run(20);
  EXPECT_TRUE(noneRuns());
  inverters[kLift].silent = false;
  run(20);
  EXPECT_TRUE(allEnabled());
}

// The emergency stop is pressed while the robot starts: nobody is enabled beside who is held, and all are when it is released.
TEST_F(AutoEnable, WaitsForADriveThatIsHeldInSwitchOnDisabled) {
  inverters[kRight].held = true;
  for (int i = 0; i < 500; ++i) {
    step();
    ASSERT_TRUE(noneRuns());
  }
  EXPECT_FALSE(supervisor.takeAutoEnableFailure());
  inverters[kRight].held = false;
  run(20);
  EXPECT_TRUE(allEnabled());
}

// Nobody waits for its answer: it is told by itself, and once.
TEST_F(AutoEnable, SaysWhyItEnabledNobody) {
  inverters[kLift].stuck = true;
  run(60);
  EXPECT_TRUE(noneRuns());
  const auto why = supervisor.takeAutoEnableFailure();
  ASSERT_TRUE(why);
  EXPECT_THAT(why->c_str(), HasSubstr("drive lift"));
  EXPECT_THAT(why->c_str(), HasSubstr("did not reach \"operation enabled\" in time"));
  EXPECT_FALSE(supervisor.takeAutoEnableFailure());
  ask(RequestKind::kEnable);
  EXPECT_FALSE(supervisor.takeAutoEnableFailure()) << "whoever asked has the answer";
}

TEST_F(AutoEnable, WaitsWhileACommandMoves) {
  moving = "the newest cmd_vel is not zero";
  run(20);
  EXPECT_TRUE(noneRuns());
  moving.clear();
  run(20);
  EXPECT_TRUE(allEnabled());
}

TEST_F(AutoEnable, NeverActsAfterAStop) {
  run(20);
  ASSERT_TRUE(allEnabled());
  ASSERT_TRUE(ask(RequestKind::kDisable).success);
  run(50);
  EXPECT_TRUE(noneRuns());
}

// Somebody said stop before the drives were ready: then auto_enable has had its turn.
TEST_F(AutoEnable, NeverActsAfterAStopThatCameBeforeIt) {
  for (const RequestKind stop : {RequestKind::kDisable, RequestKind::kQuickStop, RequestKind::kShutDown}) {
    DrivesUnderSupervision robot{true};
    robot.inverters[kLift].silent = true;
    robot.run(5);
    robot.request(1, stop);
    robot.run(5);
    robot.inverters[kLift].silent = false;
    robot.run(50);
    EXPECT_TRUE(robot.noneRuns()) << static_cast<int>(stop);
  }
}

TEST_F(AutoEnable, NeverActsOverAFaultEvenOneThatWentByItself) {
  inverters[kLeft].fault = true;
  run(20);
  EXPECT_TRUE(noneRuns());
  inverters[kLeft].fault = false;
  run(50);
  EXPECT_TRUE(noneRuns()) << "the fault is latched";
}

// "The drives stay disabled until they are enabled" is what acknowledging answers.
TEST_F(AutoEnable, LeavesItToTheUserAfterAFault) {
  inverters[kLeft].fault = true;
  run(20);
  drives[kLeft].requestAcknowledge(now);
  run(50);
  ASSERT_FALSE(drives[kLeft].report().fault_latched);
  EXPECT_TRUE(noneRuns());
  EXPECT_TRUE(ask(RequestKind::kEnable).success);
}

TEST_F(AutoEnable, ActsOnceAndNotAgainAfterALoss) {
  run(20);
  ASSERT_TRUE(allEnabled());
  inverters[kRight].silent = true;
  run(50);
  inverters[kRight].silent = false;
  run(50);
  EXPECT_NE(drive::Phase::kEnabled, drives[kLeft].report().phase);
  EXPECT_NE(drive::Phase::kEnabled, drives[kRight].report().phase);
}

}  // namespace
}  // namespace nord_driver::cycle

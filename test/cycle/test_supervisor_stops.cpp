// Disable, quick stop and shut down: they always act, whatever else is going on, and answer when it is done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/drives_under_supervision.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

class SupervisorStops : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  void SetUp() override {
    bringUp();
    ASSERT_TRUE(ask(RequestKind::kEnable).success);
  }
};

TEST_F(SupervisorStops, DisableAnswersWhenEveryDriveIsReadyToSwitchOn) {
  const Completion answer = ask(RequestKind::kDisable);
  EXPECT_TRUE(answer.success);
  EXPECT_STREQ("disabled", answer.message.c_str());
  for (const auto& drive : drives) EXPECT_EQ(profile::DriveState::kReadyToSwitchOn, drive.report().state);
  EXPECT_TRUE(supervisor.settled());
}

TEST_F(SupervisorStops, QuickStopOfOneWheelStopsTheWholeBaseAndNothingElse) {
  request(1, RequestKind::kQuickStop, kRight);
  step();
  EXPECT_EQ(0x047B, outputs[kLeft].control_word);
  EXPECT_EQ(0x047B, outputs[kRight].control_word);
  EXPECT_EQ(0x047F, outputs[kLift].control_word);
  run(20);
  ASSERT_EQ(1u, completions.back().id);
  EXPECT_TRUE(completions.back().success);
  EXPECT_STREQ("stopped and disabled", completions.back().message.c_str());
  EXPECT_THAT(supervisor.baseStopSentence().c_str(), HasSubstr("a quick stop was asked for"));
}

TEST_F(SupervisorStops, AStopThatIsNotConfirmedSaysWhatItLastSaw) {
  velocity = 1.0;
  run(40);
  inverters[kLift].ramp = 1;  // hardly comes down
  const Completion answer = ask(RequestKind::kDisable, kLift, std::chrono::milliseconds{300});
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("not confirmed in time: drive lift is operation enabled, status word 0B37", answer.message.c_str());
}

// Thirty-two requests are followed at a time. One more may go without its answer, but never without its stop.
TEST_F(SupervisorStops, AStopActsHoweverManyRequestsAreUnderWay) {
  velocity = 1.0;
  run(40);
  for (std::uint32_t id = 1; id <= 32; ++id) request(id, RequestKind::kDisable);
  completions.clear();
  request(33, RequestKind::kQuickStop);
  step();
  for (const auto& output : outputs) EXPECT_EQ(0x047B, output.control_word);
  ASSERT_FALSE(completions.empty());
  EXPECT_EQ(33u, completions.front().id);
  EXPECT_FALSE(completions.front().success);
  EXPECT_THAT(completions.front().message.c_str(), HasSubstr("too many requests"));
  run(50);
  EXPECT_TRUE(supervisor.settled());
}

// The end of the node is followed in any case: told at once that it was begun, the node would close the bus over drives that
// come down.
TEST_F(SupervisorStops, TheEndIsFollowedHoweverManyRequestsAreUnderWay) {
  velocity = 1.0;
  run(40);
  for (std::uint32_t id = 1; id <= 32; ++id) request(id, RequestKind::kDisable);
  request(33, RequestKind::kShutDown);
  const auto answered = [this] {
    for (const Completion& completion : completions) {
      if (completion.id == 33) return true;
    }
    return false;
  };
  for (int i = 0; i < 200 && !answered(); ++i) {
    step();
    EXPECT_TRUE(!answered() || supervisor.settled()) << i;
  }
  EXPECT_TRUE(answered());
}

// A whole queue of requests may be refused in one cycle; each asker is told.
TEST_F(SupervisorStops, EveryRefusalIsAnswered) {
  completions.clear();
  for (std::uint32_t id = 1; id <= 32; ++id) request(id, RequestKind::kEnable, kLeft);
  step();
  EXPECT_EQ(32u, completions.size());
}

TEST_F(SupervisorStops, ARequestNobodyWaitsForIsNotAnswered) {
  completions.clear();
  request(0, RequestKind::kDisable);
  run(30);
  EXPECT_TRUE(completions.empty());
  EXPECT_TRUE(supervisor.settled());
}

TEST_F(SupervisorStops, AMemberThatStopsBringsTheBaseDownAndIsNamed) {
  velocity = 1.0;
  run(40);
  EXPECT_TRUE(supervisor.baseStopSentence().empty());
  inverters[kRight].fault = true;
  run(2);
  EXPECT_EQ(0x047E, outputs[kRight].control_word);
  EXPECT_EQ(0x047F, outputs[kLeft].control_word);
  EXPECT_EQ(0, outputs[kLeft].setpoints[0]);
  EXPECT_EQ(drive::Phase::kEnabled, drives[kLift].report().phase) << "no part of the base";
  EXPECT_STREQ("drive right stopped: a fault of the inverter (status word 0B38, fault)",
               supervisor.baseStopSentence().c_str());
  run(40);
  EXPECT_EQ(0x047E, outputs[kLeft].control_word);
}

// Nobody has seen a drive stop that does not answer: a stop is no success before it is back and at rest.
TEST_F(SupervisorStops, ADriveThatDoesNotAnswerConfirmsNoStop) {
  inverters[kLift].silent = true;
  run(20);
  for (const RequestKind stop : {RequestKind::kQuickStop, RequestKind::kDisable}) {
    const Completion answer = ask(stop, kAllDrives, std::chrono::milliseconds{200});
    EXPECT_FALSE(answer.success);
    EXPECT_STREQ("not confirmed in time: drive lift does not answer", answer.message.c_str());
  }
  EXPECT_TRUE(ask(RequestKind::kQuickStop, kLeft).success) << "of the base, which answers";
  request(1, RequestKind::kQuickStop);
  inverters[kLift].silent = false;
  run(20);
  ASSERT_EQ(1u, completions.back().id);
  EXPECT_TRUE(completions.back().success) << "it came back in time";
}

// The node ends without waiting for a drive that has long been away, but does not call it stopped.
TEST_F(SupervisorStops, ShutDownWaitsForNoDriveThatDoesNotAnswer) {
  inverters[kLift].silent = true;
  run(150);
  const Instant asked = now;
  const Completion answer = ask(RequestKind::kShutDown);
  EXPECT_LT(now - asked, std::chrono::milliseconds{200});
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("drive lift does not answer: nobody has seen it stop", answer.message.c_str());
}

// But for one that was lost while it turned: it may hear what stops it, and be back in a moment.
TEST_F(SupervisorStops, ShutDownWaitsForAStopThatIsStillSent) {
  velocity = 1.0;
  run(40);
  inverters[kRight].silent = true;
  run(20);
  ASSERT_EQ(0x047E, outputs[kRight].control_word);
  request(7, RequestKind::kShutDown);
  run(20);
  for (const Completion& completion : completions) EXPECT_NE(7u, completion.id) << completion.message.c_str();
  inverters[kRight].silent = false;
  run(60);
  ASSERT_EQ(7u, completions.back().id);
  EXPECT_TRUE(completions.back().success) << completions.back().message.c_str();
}

// For as long as that word is sent.
TEST_F(SupervisorStops, ShutDownEndsWithTheStopThatNobodyAnswers) {
  velocity = 1.0;
  run(40);
  inverters[kRight].silent = true;
  run(20);
  const Instant asked = now;
  const Completion answer = ask(RequestKind::kShutDown, kAllDrives, std::chrono::seconds{13});
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("drive right does not answer: nobody has seen it stop", answer.message.c_str());
  EXPECT_LT(now - asked, std::chrono::milliseconds{1200});
  EXPECT_EQ(0x0000, outputs[kRight].control_word);
}

TEST_F(SupervisorStops, ShutDownNamesEveryDriveThatDoesNotAnswer) {
  inverters[kLift].silent = inverters[kLeft].silent = true;
  run(60);
  const Completion answer = ask(RequestKind::kShutDown);
  EXPECT_FALSE(answer.success);
  EXPECT_STREQ("drives left, lift do not answer: nobody has seen them stop", answer.message.c_str());
}

// Whichever of the two comes first in a cycle: nothing is enabled afterwards, and the asker of the enable is told.
TEST_F(SupervisorStops, AStopBesideAnEnableWins) {
  for (const RequestKind stop : {RequestKind::kQuickStop, RequestKind::kDisable, RequestKind::kShutDown}) {
    for (const bool enable_first : {true, false}) {
      DrivesUnderSupervision robot;
      robot.bringUp();
      if (enable_first) robot.request(1, RequestKind::kEnable);
      robot.request(2, stop);
      if (!enable_first && stop != RequestKind::kDisable) robot.request(1, RequestKind::kEnable);
      for (int i = 0; i < 50; ++i) {
        robot.step();
        ASSERT_TRUE(robot.noneRuns()) << static_cast<int>(stop) << enable_first;
      }
      for (const Completion& completion : robot.completions) {
        EXPECT_EQ(completion.id == 2, completion.success) << completion.message.c_str();
      }
      EXPECT_EQ(!enable_first && stop == RequestKind::kDisable ? 1u : 2u, robot.completions.size());
      EXPECT_TRUE(robot.supervisor.settled());
    }
  }
}

}  // namespace
}  // namespace nord_driver::cycle

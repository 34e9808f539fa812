// Each request is answered once, and in time; and what the answer says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"
#include "cycle/drives_under_supervision.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

class SupervisorAnswers : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  void SetUp() override { bringUp(); }
};

TEST_F(SupervisorAnswers, AnEnableThatIsGivenUpIsAnsweredOnce) {
  inverters[kLift].stuck = true;
  request(1, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{100});
  run(100);
  EXPECT_THAT(answersTo(1), ElementsAre("no: drive lift: the inverter did not reach \"operation enabled\" in time "
                                        "(status word 0B31, ready to switch on)"));
}

// Not the one of its base that is enabled and waits for it.
TEST_F(SupervisorAnswers, AnEnableThatIsGivenUpNamesTheDriveThatHasNotCome) {
  inverters[kRight].stuck = true;
  request(1, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{100});
  run(9);
  ASSERT_EQ(drive::Phase::kEnabled, drives[kLeft].report().phase);
  run(91);
  EXPECT_THAT(answersTo(1), ElementsAre(StartsWith("no: drive right: the inverter did not reach ")));
}

// Whichever time ends first, the request's or the drive's own: an emergency stop is told as one.
TEST_F(SupervisorAnswers, AnEnableOfADriveHeldByItsTerminalsNamesWhatHoldsIt) {
  const struct {
    Word taken;
    const char* expected;
  } cases[] = {{0x0002,
                "(status word 0B60, switch-on disabled, bit 4 = 0: OFF2 or safe stop (STO) at its terminals, or no "
                "mains)"},
               {0x0004,
                "(status word 0B50, switch-on disabled, bit 5 = 0: OFF3 (quick stop, emergency stop) at its "
                "terminals)"},
               {0x0006,
                "(status word 0B40, switch-on disabled, bit 4 = 0: OFF2 or safe stop (STO) at its terminals, or no "
                "mains)"}};
  std::uint32_t id = 0;
  for (const auto& held : cases) {
    for (const int patience : {100, 190, 200, 210, 3000}) {
      SCOPED_TRACE(patience);
      inverters[kRight].taken = held.taken;
      request(++id, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{patience});
      run(100);
      EXPECT_THAT(answersTo(id), ElementsAre(std::string("no: drive right: the inverter did not reach \"operation "
                                                         "enabled\" in time ") +
                                             held.expected));
      inverters[kRight].taken = 0;
      run(50);
    }
  }
}

// Enabled before, it is enabled as far as is known, and not heard since it was asked for.
TEST_F(SupervisorAnswers, AnEnableOfWhatIsEnabledNamesTheDriveThatWasNotHeard) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  inverters[kRight].silent = true;
  request(1, RequestKind::kEnable, kAllDrives, std::chrono::milliseconds{30});
  run(10);
  EXPECT_THAT(answersTo(1), ElementsAre(StartsWith("no: not confirmed in time: drive right is ")));
}

TEST_F(SupervisorAnswers, TheEndBesideASilentDriveIsAnsweredOnce) {
  inverters[kLift].silent = true;
  run(150);
  request(1, RequestKind::kShutDown);
  run(50);
  EXPECT_THAT(answersTo(1), ElementsAre("no: drive lift does not answer: nobody has seen it stop"));
}

TEST_F(SupervisorAnswers, AStopThatIsNotConfirmedNamesTheDriveOfTheBase) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  velocity = 1.0;
  run(40);
  inverters[kLeft].ramp = 1;  // hardly comes down
  EXPECT_THAT(ask(RequestKind::kDisable, kAllDrives, std::chrono::milliseconds{300}).message.c_str(),
              StartsWith("not confirmed in time: drive left is "));
}

// The second one asks for what is under way: a command that moves is none against it.
TEST_F(SupervisorAnswers, TwoMayAskForTheSameEnabling) {
  request(1, RequestKind::kEnable);
  step();
  moving = "the newest cmd_vel is not zero";
  for (const DriveIndex asked : {kAllDrives, kLift}) request(asked == kLift ? 3 : 2, RequestKind::kEnable, asked);
  run(20);
  for (const std::uint32_t id : {1u, 2u, 3u}) EXPECT_THAT(answersTo(id), ElementsAre("yes: enabled")) << id;
}

// For a stop there is always a place, see SupervisorStops.
TEST_F(SupervisorAnswers, AnEnableIsRefusedWhereNobodyCouldFollowIt) {
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  velocity = 1.0;
  run(40);
  for (std::uint32_t id = 1; id <= 32; ++id) request(id, RequestKind::kDisable, kLift);
  request(33, RequestKind::kEnable, kLift);
  step();
  EXPECT_THAT(answersTo(33), ElementsAre("no: too many requests are being carried out already"));
}

// The base comes down a ramp that does not end: the configured time, and then quick stop, whoever is still on it.
TEST_F(SupervisorAnswers, TheWayDownIsBoundByTheShutdownTimeOut) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  velocity = 50.0;
  run(100);
  for (auto& inverter : inverters) inverter.ramp = 1;
  request(1, RequestKind::kDisable);
  run(99);
  for (const auto& output : outputs) EXPECT_NE(0x047B, output.control_word);
  run(3);
  for (const auto& output : outputs) EXPECT_EQ(0x047B, output.control_word);
}

TEST_F(SupervisorAnswers, WithoutABaseNoneHasStopped) {
  CycleConfig single = config();
  single.base.reset();
  DrivesUnderSupervision robot{single};
  robot.bringUp();
  ASSERT_TRUE(robot.ask(RequestKind::kEnable).success);
  ASSERT_TRUE(robot.ask(RequestKind::kQuickStop, kLeft).success);
  EXPECT_STREQ("", robot.supervisor.baseStopSentence().c_str());
  EXPECT_EQ(drive::Phase::kEnabled, robot.drives[kRight].report().phase) << "each for itself";
}

TEST(BaseStop, ByACommandThatGrewOldIsNobodysFault) {
  drive::StopWays ways;
  ways.command_timeout = drive::StopWay::kQuickStop;
  CycleBench bench{std::nullopt, 0.0, ways};
  bench.run(80);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 20; ++i) {
    bench.commandBase(0.2);
    bench.step();
  }
  bench.run(100);
  EXPECT_FALSE(bench.snapshot().base.enabled);
  EXPECT_STREQ("no new velocity command came within cmd_vel_timeout", bench.snapshot().base.text.c_str());
}

/// The left drive leads the right one; the lift is alone.
class Followers : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  Followers() : DrivesUnderSupervision{following()} {}
  static CycleConfig following() {
    CycleConfig config = DrivesUnderSupervision::config();
    config.base.reset();
    config.drives[kRight].leader = kLeft;
    return config;
  }
  void SetUp() override { bringUp(); }
  bool runs(DriveIndex drive) const { return drives[drive].report().phase == drive::Phase::kEnabled; }
};

TEST_F(Followers, AreEnabledAndDisabledWithTheirLeader) {
  EXPECT_TRUE(ask(RequestKind::kEnable, kLeft).success);
  EXPECT_TRUE(runs(kLeft) && runs(kRight) && !runs(kLift));
  ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  EXPECT_TRUE(ask(RequestKind::kDisable, kLeft).success);
  EXPECT_TRUE(!runs(kLeft) && !runs(kRight) && runs(kLift));
}

// A stop is never refused.
TEST_F(Followers, StopTheirLeader) {
  ASSERT_TRUE(ask(RequestKind::kEnable, kLeft).success);
  EXPECT_TRUE(ask(RequestKind::kQuickStop, kRight).success);
  EXPECT_FALSE(runs(kLeft) || runs(kRight));
}

TEST_F(Followers, AreNotEnabledAlone) {
  request(1, RequestKind::kEnable, kRight);
  run(20);
  EXPECT_THAT(answersTo(1), ElementsAre("no: drive right follows drive left (drives/right/follows), and is enabled and "
                                        "disabled with it: use ~left/enable"));
  EXPECT_TRUE(noneRuns());
}

/// auto_enable.
class AutoEnabling : public ::testing::Test, protected DrivesUnderSupervision {
 protected:
  AutoEnabling() : DrivesUnderSupervision{true} {}
};

// Until all are ready nothing is begun: one that is lost once more is no end of it.
TEST_F(AutoEnabling, WaitsForADriveThatIsLostBeforeItIsReady) {
  drives[kLift].setParametersAwaited(true);
  run(10);
  inverters[kLift].silent = true;
  run(20);
  inverters[kLift].silent = false;
  run(10);
  EXPECT_TRUE(noneRuns());
  drives[kLift].setParametersAwaited(false);
  run(20);
  EXPECT_TRUE(allEnabled());
}

TEST_F(AutoEnabling, EnablesAllOrNone) {
  inverters[kLift].stuck = true;
  run(100);
  EXPECT_TRUE(noneRuns());
  EXPECT_TRUE(supervisor.settled());
}

// However long a drive may take for it: nothing comes up by itself when nobody expects it any more.
TEST_F(AutoEnabling, IsGivenUpAfterAMinute) {
  CycleConfig patient = config();
  for (DriveSetup& setup : patient.drives) setup.drive.enable_timeout = std::chrono::seconds{200};
  DrivesUnderSupervision robot{patient, true};
  robot.inverters[kLift].stuck = true;
  robot.run(5900);
  EXPECT_EQ(drive::Phase::kEnabled, robot.drives[kLeft].report().phase);
  robot.run(200);
  robot.inverters[kLift].stuck = false;
  robot.run(50);
  EXPECT_TRUE(robot.noneRuns());
  EXPECT_TRUE(robot.supervisor.settled());
}

}  // namespace
}  // namespace nord_driver::cycle

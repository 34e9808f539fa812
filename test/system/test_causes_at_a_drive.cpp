// What stops the base without being asked, row by row of "What stops what": the drive concerned gets the idle word, the
// others setpoint 0 on their own ramp, then OFF1; all of it latched until somebody enables again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;

enum class Base { kTwoDrives, kFourDrives, kFourBehindOneModule };

/// A drive is a drive wherever it is connected. The cause is at the first right one.
class CauseAtADrive : public ::testing::TestWithParam<Base> {
 protected:
  CauseAtADrive() : robot_(options()) {}
  static SimulatedRobot::Options options() {
    SimulatedRobot::Options options;
    options.one_module = GetParam() == Base::kFourBehindOneModule;
    options.wheels_a_side = GetParam() == Base::kTwoDrives ? 1 : 2;
    return options;
  }
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
    for (DriveIndex i = 0; i < robot_.driveCount(); ++i) {
      ASSERT_EQ(i % 2 == 0 ? 0x2000 : -0x2000, robot_.setpoint(i));
      if (i != kRight) others_.push_back(i);
    }
  }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.segment().referee().report()); }

  void step() {
    robot_.command(kHalfSpeed);  // somebody goes on commanding, whatever happens
    robot_.step();
  }
  bool known() {
    const cycle::DriveSnapshot& right = robot_.snapshot().drives[kRight];
    return !right.online || right.stopped;
  }
  /// Steps until the driver knows of the cause, at most `limit` cycles; then two cycles are the bound.
  void expectReaction(int limit) {
    for (int i = 0; i < limit && !known(); ++i) step();
    ASSERT_TRUE(known());
    step();
    step();
    EXPECT_EQ(0x047E, robot_.controlWord(kRight)) << "the idle word";
    for (const DriveIndex other : others_) {
      EXPECT_EQ(0x047F, robot_.controlWord(other)) << "torque stays until it has come to rest, drive " << other;
      EXPECT_EQ(0, robot_.setpoint(other)) << other;
    }
  }
  /// The other one comes down its own ramp, then OFF1; a standing command moves nothing any more.
  void expectRestForGood(bool by_ramp = true) {
    bool off1_while_fast = false;
    for (int i = 0; i < 500; ++i) {
      step();
      for (DriveIndex drive = 0; drive < robot_.driveCount(); ++drive) ASSERT_EQ(0, robot_.setpoint(drive)) << drive;
      for (const DriveIndex other : others_) {
        off1_while_fast |= robot_.controlWord(other) == 0x047E && std::abs(robot_.unit(other).shaftSpeed()) > 5.0;
      }
    }
    EXPECT_EQ(!by_ramp, off1_while_fast);
    for (const DriveIndex other : others_) {
      EXPECT_EQ(0x047E, robot_.controlWord(other)) << other;
      EXPECT_EQ(0x0B31, robot_.statusWord(other)) << other;
    }
    EXPECT_FALSE(robot_.snapshot().base.enabled);
    EXPECT_TRUE(robot_.snapshot().base.stopped);
  }
  std::string stopText() { return robot_.snapshot().base.text.str(); }
  cycle::Completion enableAtRest() {
    robot_.run(milliseconds{600});  // the last command is too old by then
    return robot_.ask(cycle::RequestKind::kEnable);
  }

  SimulatedRobot robot_;
  std::vector<DriveIndex> others_;
};

std::string nameOf(const ::testing::TestParamInfo<Base>& test) {
  const char* const names[] = {"TwoDrives", "FourDrives", "FourBehindOneModule"};
  return names[static_cast<int>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(On, CauseAtADrive,
                         ::testing::Values(Base::kTwoDrives, Base::kFourDrives, Base::kFourBehindOneModule), nameOf);

TEST_P(CauseAtADrive, AFaultStopsTheBase) {
  robot_.unit(kRight).inverter().trip(30, true);
  expectReaction(2);
  EXPECT_THAT(stopText(), HasSubstr("drive right stopped: a fault of the inverter"));
  expectRestForGood();
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("drive right: the inverter reports a fault"));
}

// Taking the enable away acknowledges (BU 0020 8): the fault is gone by itself, and must not be forgotten.
TEST_P(CauseAtADrive, AFaultThatVanishedIsStillInTheWay) {
  robot_.unit(kRight).inverter().trip(30, false);
  expectReaction(2);
  expectRestForGood();
  EXPECT_EQ(0, robot_.unit(kRight).inverter().faultNumber()) << "the inverter has forgotten it";
  const cycle::Completion answer = enableAtRest();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("a fault was seen and has not been acknowledged"));
}

// P509 or digital input 14: terminals may turn the wheel, and a standing 047F would act when the bus has control again.
TEST_P(CauseAtADrive, LocalControlStopsTheBase) {
  robot_.unit(kRight).inverter().setLocalControl(true, 0.0);
  expectReaction(2);
  EXPECT_THAT(stopText(), HasSubstr("local control"));
  expectRestForGood();
  EXPECT_THAT(robot_.ask(cycle::RequestKind::kEnable).message.c_str(), HasSubstr("the newest cmd_vel"));
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("under local control"));
  robot_.unit(kRight).inverter().setLocalControl(false);
  robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }))
      << "control over the bus returns: nothing moves";
  EXPECT_STREQ("enabled", enableAtRest().message.c_str());
}

// OFF2 and OFF3 at the terminals, seen in status bits 4 and 5 (BU 2700 6.4.2).
TEST_P(CauseAtADrive, Off2AndOff3AtTheTerminalsStopTheBase) {
  for (const bool off2 : {true, false}) {
    sim::Terminals terminals;
    terminals.coast = off2;
    terminals.quick_stop = !off2;
    robot_.unit(kRight).inverter().setTerminals(terminals);
    expectReaction(2);
    EXPECT_THAT(stopText(), HasSubstr(off2 ? "OFF2 at the inverter's terminals" : "OFF3 at the inverter's terminals"));
    expectRestForGood();
    EXPECT_THAT(stopText(), HasSubstr("P700[-03]")) << "the inverter's own reason, once it is read";
    robot_.unit(kRight).inverter().setTerminals({});
    ASSERT_STREQ("enabled", enableAtRest().message.c_str());
    robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  }
}

// A dip of the mains: "operation enabled" is left without being asked.
TEST_P(CauseAtADrive, AnUnaskedExitStopsTheBase) {
  robot_.unit(kRight).inverter().setPowered(false);
  robot_.unit(kRight).inverter().setPowered(true);  // a dip of the mains: "not ready to switch on" with the set kept
  expectReaction(2);
  EXPECT_THAT(stopText(), HasSubstr("left \"operation enabled\" without being asked"));
  expectRestForGood();
  EXPECT_STREQ("enabled", enableAtRest().message.c_str());
}

// Silent for longer than drive_timeout (50 ms), then the same. The fifth silent cycle ends behind it: it is asked, with
// the repetition, in each.
TEST_P(CauseAtADrive, ADriveThatFallsSilentStopsTheBase) {
  robot_.unit(kRight).setPlugged(false);
  for (int i = 0; i < 4; ++i) {
    step();
    EXPECT_TRUE(robot_.snapshot().drives[kRight].online) << "cycle " << i;
  }
  expectReaction(3);
  EXPECT_THAT(stopText(), HasSubstr("drive right stopped: the inverter fell silent"));
  expectRestForGood();
  EXPECT_THAT(enableAtRest().message.c_str(), HasSubstr("drive right: the inverter does not answer"));
}

// Modules with 24 V of their own answer for an inverter that is off (BU 0020 2.1.3): with zeros, which are no status.
TEST_P(CauseAtADrive, AnInverterThatIsOffBehindItsModuleStopsTheBase) {
  robot_.unit(kRight).setInverterPower(false);
  expectReaction(10);
  EXPECT_TRUE(robot_.snapshot().drives[kRight].module_answers);
  EXPECT_FALSE(robot_.snapshot().drives[kRight].online);
  EXPECT_THAT(robot_.snapshot().drives[kRight].text.c_str(), HasSubstr("the inverter behind it does not"));
  EXPECT_THAT(stopText(), HasSubstr("the inverter fell silent"));
  expectRestForGood();
  // Power is back: idle, in the set it says, and only `enable` moves it.
  robot_.unit(kRight).setInverterPower(true);
  robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  EXPECT_TRUE(robot_.snapshot().drives[kRight].online);
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  EXPECT_EQ(0x047E, robot_.controlWord(kRight));
  EXPECT_STREQ("enabled", enableAtRest().message.c_str());
}

// Two cycles with all their retries unanswered are shorter than drive_timeout: data exchange goes on, and so does the
// base.
TEST_P(CauseAtADrive, TwoLostCyclesStopNothing) {
  robot_.unit(kRight).setMute(true);
  step();
  step();
  robot_.unit(kRight).setMute(false);
  for (int i = 0; i < 50; ++i) {
    step();
    ASSERT_TRUE(robot_.snapshot().base.enabled) << i << ": " << stopText();
    ASSERT_TRUE(robot_.snapshot().drives[kRight].online) << i;
    ASSERT_EQ(0x047F, robot_.controlWord(kRight)) << i;
    ASSERT_EQ(-0x2000, robot_.setpoint(kRight)) << i;
  }
}

// Silent for longer than drive_timeout: the slave is parameterised anew. Back within 2 s, at rest, and enabled only
// when asked.
TEST_P(CauseAtADrive, ADriveThatIsBackDoesNotMoveBeforeItIsEnabled) {
  robot_.unit(kRight).setMute(true);
  for (int i = 0; i < 10 && robot_.snapshot().drives[kRight].online; ++i) step();
  robot_.unit(kRight).setMute(false);
  ASSERT_FALSE(robot_.snapshot().drives[kRight].online);
  const Instant back = robot_.transport().now();
  while (!robot_.snapshot().drives[kRight].online && robot_.transport().now() - back < std::chrono::seconds{5}) step();
  EXPECT_LT(toSeconds(robot_.transport().now() - back), 2.0);
  ASSERT_TRUE(robot_.snapshot().drives[kRight].online);
  expectRestForGood(
      GetParam() !=
      Base::kFourBehindOneModule);  // a module is lost with all its drives: nobody is left to come down by a ramp
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  ASSERT_STREQ("enabled", enableAtRest().message.c_str());
  robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  EXPECT_EQ(0x2000, robot_.setpoint(kLeft));
  EXPECT_EQ(-0x2000, robot_.setpoint(kRight));
}

// Unplugged and plugged in again: the same after its restart, with mains and module both gone.
TEST_P(CauseAtADrive, ADriveThatWasOffIsBackWithinTwoSecondsAtRest) {
  robot_.unit(kRight).setPlugged(false);
  for (int i = 0; i < 100; ++i) step();
  robot_.unit(kRight).setPlugged(true);
  const Instant back = robot_.transport().now();
  while (!robot_.snapshot().drives[kRight].online && robot_.transport().now() - back < std::chrono::seconds{5}) step();
  EXPECT_LT(toSeconds(robot_.transport().now() - back), 2.0);
  expectRestForGood();
  EXPECT_STREQ("enabled", enableAtRest().message.c_str());
}

// The bus device is pulled: nothing can be sent, the drives' watchdogs switch off and the wheels coast. On return:
// disabled, and the fault E10.2 the watchdog left is in the way of enabling.
TEST_P(CauseAtADrive, TheBusLostAndBackLeavesTheBaseDisabled) {
  robot_.segment().setDevicePresent(false);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_FALSE(robot_.snapshot().connected);
  EXPECT_THAT(robot_.snapshot().bus_text.c_str(), HasSubstr("simulated segment: no such device"));
  EXPECT_EQ(1u, robot_.unit(kLeft).counters().watchdog_trips);
  EXPECT_EQ(1u, robot_.unit(kRight).counters().watchdog_trips);
  robot_.segment().setDevicePresent(true);
  const Instant back = robot_.transport().now();
  const auto all_online = [this] {
    const auto& drives = robot_.snapshot().drives;
    return std::all_of(drives.begin(), drives.end(), [](const auto& drive) { return drive.online; });
  };
  while (!all_online() && robot_.transport().now() - back < std::chrono::seconds{5}) step();
  EXPECT_LT(toSeconds(robot_.transport().now() - back), 2.0);
  expectRestForGood(false);
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  const cycle::Completion answer = enableAtRest();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("has not been acknowledged"));
}

}  // namespace
}  // namespace nord_driver::test

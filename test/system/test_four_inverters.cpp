// Four wheels behind one bus module SK CU4: what is different from four modules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/profibus/module_station.h"
#include "system/four_inverters.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

class FourInverters : public ::testing::Test {
 protected:
  static SimulatedRobot::Options options() {
    SimulatedRobot::Options options;
    options.one_module = true;
    return options;
  }
  void SetUp() override { ASSERT_TRUE(robot_.bringUp()); }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.segment().referee().report()); }

  sim::ModuleStation& module() { return robot_.segment().stations().module(0); }

  SimulatedRobot robot_{options()};
};

// One exchange a cycle for all four, and the base drives as with modules of their own.
TEST_F(FourInverters, DriveTheBase) {
  ASSERT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
  const std::uint64_t before = robot_.transport().counters().value(bus_counter::kTelegramsSent);
  robot_.step();
  EXPECT_EQ(before + 1, robot_.transport().counters().value(bus_counter::kTelegramsSent));
  robot_.drive(kHalfSpeed, 0.0, seconds{3});
  for (const DriveIndex drive : {kLeft, kRearLeft}) EXPECT_EQ(0x2000, robot_.setpoint(drive));
  for (const DriveIndex drive : {kRight, kRearRight}) EXPECT_EQ(-0x2000, robot_.setpoint(drive));
  EXPECT_GT(robot_.snapshot().base.pose.x, 0.5);
  EXPECT_EQ(0, module().outputs());
}

// P151 by a record from the module, P120 by the PKW from the inverter: what protects the drive is known from the start.
TEST_F(FourInverters, TellWhatWatchesTheBus) {
  expectMonitoringKnown(robot_);
  for (const auto& drive : robot_.snapshot().drives) EXPECT_EQ(0x0BA8u, drive.device.ident);
  EXPECT_EQ(TimeoutOwner::kModule, robot_.transport().identity(kRearLeft).timeout_owner);
  EXPECT_EQ("PROFIBUS station 3, inverter 3", robot_.transport().identity(kRearLeft).address);
}

TEST_F(FourInverters, ShareTheParametersOfTheirModule) {
  expectSharedTimeout(robot_, module());
  const cycle::Completion answer = parameter(robot_, cycle::RequestKind::kReadParameter, kRearLeft, 199);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive rear_left refuses P199: PKW error 0"));
}

// As long as one of them is not acknowledged, the module stays in its time-out.
TEST_F(FourInverters, AreAcknowledgedTogetherAfterATimeout) {
  module().setMute(true);
  robot_.segment().setDevicePresent(false);
  robot_.run(seconds{1});
  module().setMute(false);
  robot_.segment().setDevicePresent(true);
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{3}));
  robot_.run(seconds{1});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(102, robot_.snapshot().drives[i].last_fault_number) << i;
  expectAcknowledgedTogether(robot_, module());
}

// Behind a module of their own nobody waits for a neighbour.
TEST(TwoModules, AreAcknowledgedOneByOne) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUp());
  for (std::size_t i = 0; i < 2; ++i) robot.unit(i).inverter().trip(30, false);
  robot.run(milliseconds{500});
  EXPECT_STREQ("no fault stands; the drives stay disabled until they are enabled",
               robot.ask(cycle::RequestKind::kAcknowledge, 0).message.c_str());
}

// The module is gone: four drives at once, and all of them back.
TEST_F(FourInverters, AreLostAndFoundTogether) {
  ASSERT_TRUE(robot_.ask(cycle::RequestKind::kEnable).success);
  robot_.drive(kHalfSpeed, 0.0, seconds{2});
  module().setMute(true);
  robot_.run(milliseconds{120});
  for (const auto& drive : robot_.snapshot().drives) EXPECT_FALSE(drive.online);
  module().setMute(false);
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{2}));
  EXPECT_EQ(0u, module().counters().watchdog_trips) << "found before its watchdog of 0.2 s ran out";
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  EXPECT_FALSE(robot_.snapshot().base.enabled);
  EXPECT_TRUE(robot_.snapshot().base.stopped);
}

// One of four is switched off and on again: the other three stay what they are.
TEST_F(FourInverters, OneOffIsThatDriveOffline) {
  robot_.unit(kRearLeft).setInverterPower(false);
  robot_.run(milliseconds{300});
  for (const DriveIndex drive : {kLeft, kRight, kRearRight}) EXPECT_TRUE(robot_.snapshot().drives[drive].online);
  EXPECT_FALSE(robot_.snapshot().drives[kRearLeft].online);
  EXPECT_TRUE(robot_.snapshot().drives[kRearLeft].module_answers);
  EXPECT_THAT(robot_.ask(cycle::RequestKind::kEnable).message.c_str(),
              HasSubstr("drive rear_left: the inverter does not answer"));
  robot_.unit(kRearLeft).setInverterPower(true);
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{2}));
  robot_.run(seconds{1});
  EXPECT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
}

// The mains of all four go, the module lives on its 24 V: with 0000 for all of them P151 would run out (BU 0220
// 4.2.3.2). The idle word goes on, in the set each had; what comes back says its set itself.
TEST_F(FourInverters, AllOffAreNoTimeoutOfTheirModule) {
  module().parameters().preset(151, 0, 0, 100);
  cycle::Request request;
  request.kind = cycle::RequestKind::kSelectParameterSet;
  request.drive = kRearRight;
  request.parameter_set = 3;
  ASSERT_TRUE(robot_.ask(request).success);
  for (DriveIndex i = 0; i < 4; ++i) robot_.unit(i).setInverterPower(false);
  for (int i = 0; i < 300; ++i) {
    robot_.step();
    ASSERT_FALSE(module().timedOut()) << i;
  }
  for (DriveIndex drive = 0; drive < 4; ++drive) {
    EXPECT_FALSE(robot_.snapshot().drives[drive].online);
    EXPECT_EQ(drive == kRearRight ? 0x847E : 0x047E, robot_.controlWord(drive)) << drive;
  }
  for (DriveIndex i = 0; i < 4; ++i) robot_.unit(i).setInverterPower(true);
  ASSERT_TRUE(robot_.runUntil([this] { return allOnline(robot_); }, seconds{3}));
  robot_.run(seconds{1});
  EXPECT_EQ(0, module().parameters().value(170, 0, 1)) << "no time-out of the past either";
  EXPECT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
}

TEST_F(FourInverters, HaveParameterSetsOfTheirOwn) {
  expectSetsOfTheirOwn(robot_);
}

// PPO 3 has no PKW: P105, P700 and the rest come by records, and everything works as with one.
TEST(FourInvertersInPpo3, ReadTheirParametersByRecords) {
  SimulatedRobot::Options options;
  options.one_module = true;
  options.drives["ppo_type"] = 3;
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ("DP-V1 records", robot.transport().identity(0).parameter_channel);
  for (const auto& drive : robot.snapshot().drives) EXPECT_EQ(50.0, drive.device.max_frequency[0].value_or(0.0));
  ASSERT_STREQ("enabled", robot.ask(cycle::RequestKind::kEnable).message.c_str());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  EXPECT_EQ(0x2000, robot.setpoint(kRearLeft));
  robot.unit(kRearLeft).inverter().trip(30, true);
  robot.drive(kHalfSpeed, 0.0, seconds{1});
  EXPECT_EQ(30, robot.snapshot().drives[kRearLeft].fault_number) << "P700 by a record";
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

}  // namespace
}  // namespace nord_driver::test

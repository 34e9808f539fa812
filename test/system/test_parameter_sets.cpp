// The parameter set in force: learned before anything is commanded, never switched, and what setpoints are shares of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "system/every_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

/// An earlier node commanded set 3 and died; with `turning` it was driving at half of P105.
template <typename Robot>
void leaveInSet3(Robot& robot, bool turning) {
  for (std::size_t i = 0; i < 2; ++i) robot.unit(i).inverter().receive({0x847E, {}});
  busOf(robot).run(std::chrono::seconds{1});
  if (!turning) return;
  for (std::size_t i = 0; i < 2; ++i) robot.unit(i).inverter().receive({0x847F, {0x2000}});
  busOf(robot).run(std::chrono::seconds{5});
}

template <typename Robot>
class LeftInSet3 : public ::testing::Test {};
TYPED_TEST_SUITE(LeftInSet3, EveryRobot, BusName);

TYPED_TEST(LeftInSet3, ADriveIsToldToIdleInIt) {
  TypeParam robot;
  leaveInSet3(robot, false);
  const auto switches = robot.unit(0).inverter().setSwitches();
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ(0x847E, robot.controlWord(0));
  EXPECT_EQ(3, robot.snapshot().drives[0].parameter_set);
  EXPECT_EQ(switches, robot.unit(0).inverter().setSwitches()) << "no set was switched";
  EXPECT_EQ(2u, robot.unit(0).inverter().parameterSet());
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
  EXPECT_EQ(0x847F, robot.controlWord(0));
  EXPECT_EQ(switches, robot.unit(0).inverter().setSwitches());
  EXPECT_EQ("no rule broken", busOf(robot).referee().report());
}

// A node restarted over turning drives: 047E alone would switch to the ramps and P105 of set 1 in full run.
TYPED_TEST(LeftInSet3, ADriveThatTurnsIsStoppedInIt) {
  TypeParam robot;
  leaveInSet3(robot, true);
  ASSERT_GT(robot.unit(0).shaftSpeed(), 50.0);
  const auto switches = robot.unit(0).inverter().setSwitches();
  ASSERT_TRUE(robot.runUntil([&] {
    EXPECT_TRUE(robot.controlWord(0) == 0x0000 || robot.controlWord(0) == 0x847E);
    return robot.standsStill();
  }));
  EXPECT_EQ(switches, robot.unit(0).inverter().setSwitches());
  EXPECT_FALSE(robot.snapshot().drives[0].enabled);
  EXPECT_EQ(0x847E, robot.controlWord(0));
  EXPECT_EQ("no rule broken", busOf(robot).referee().report());
}

// SW1 and IW1 are shares of P105 of the set in force (BU 0020 7.3.5): 100 Hz in set 3, 50 Hz in set 1.
TEST(ParameterSets, SetpointAndSpeedAreScaledByP105OfTheSetInForce) {
  SimulatedRobot::Options options;
  options.parameters = {{105, 2, 0, 1000}};
  SimulatedRobot in_set_1{options}, in_set_3{options};
  leaveInSet3(in_set_3, false);
  for (SimulatedRobot* robot : {&in_set_1, &in_set_3}) {
    ASSERT_TRUE(robot->bringUpAndEnable());
    robot->drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
    EXPECT_NEAR(kHalfSpeed, robot->snapshot().base.velocity.linear_x, 1e-4);
    EXPECT_NEAR(25.0, robot->snapshot().drives[0].frequency, 1e-2);
    EXPECT_NEAR(25.0, robot->unit(0).inverter().frequency(), 1e-2) << "the truth";
  }
  EXPECT_EQ(0x2000, in_set_1.setpoint(0));
  EXPECT_EQ(0x1000, in_set_3.setpoint(0));
}

// max_frequency in the configuration says 50 Hz, P105 is 100 Hz: P105 counts, from the first movement on.
TEST(ParameterSets, ATypedMaxFrequencyThatContradictsP105DoesNotMoveTheBaseAtAnotherSpeed) {
  SimulatedRobot::Options options;
  options.parameters = {{105, 0, 0, 1000}};
  options.drives = {{"max_frequency", 50.0}};
  options.auto_enable = true;
  SimulatedRobot robot{options};
  double fastest = 0.0;
  const Instant end = robot.transport().now() + std::chrono::seconds{6};
  while (robot.transport().now() < end) {
    if (robot.snapshot().base.enabled) robot.command(kHalfSpeed);
    robot.step();
    fastest = std::max(fastest, robot.unit(0).inverter().frequency());
  }
  EXPECT_TRUE(robot.snapshot().base.enabled);
  EXPECT_NEAR(25.0, fastest, 0.01);
  EXPECT_DOUBLE_EQ(100.0, robot.snapshot().drives[0].device.max_frequency[0].value());
}

// PPO 3 has no parameter channel (BU 0020 5.2.2): the typed value is all there is.
TEST(ParameterSets, WithoutAParameterChannelTheTypedMaxFrequencyCounts) {
  SimulatedRobot::Options options;
  options.ppo_type = 3;
  options.drives = {{"ppo_type", 3}, {"max_frequency", 50.0}};
  SimulatedRobot robot{options};
  robot.run(std::chrono::seconds{1});
  ASSERT_STREQ("enabled", robot.ask(cycle::RequestKind::kEnable).message.c_str());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  EXPECT_EQ(0x2000, robot.setpoint(0));
  EXPECT_NEAR(25.0, robot.unit(0).inverter().frequency(), 0.01);
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

// Another set comes into force without being asked for: a step of the speed. The base stops.
TEST(ParameterSets, ASetThatChangesByItselfStopsTheBase) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  robot.unit(1).inverter().receive({0x447F, {0xE000}});
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{10});
  EXPECT_THAT(robot.snapshot().base.text.c_str(), HasSubstr("another parameter set came into force"));
  EXPECT_TRUE(robot.standsStill());
}

// Written over the driver's own service, the new P105 counts from the first movement on.
TEST(ParameterSets, AP105ThatTheUserHasWrittenScalesFromThenOn) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUp());
  for (DriveIndex drive = 0; drive < 2; ++drive) {
    const cycle::Completion written = robot.ask(writeRequest(drive, 105, 1000));
    ASSERT_TRUE(written.success) << written.message.c_str();
  }
  const cycle::Completion enabled = robot.ask(cycle::RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  for (DriveIndex drive = 0; drive < 2; ++drive) {
    EXPECT_EQ(100.0, robot.snapshot().drives[drive].device.max_frequency[0]) << "enabling has waited until it was read";
  }
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
  EXPECT_EQ(0x1000, robot.setpoint(0));
  EXPECT_NEAR(25.0, robot.unit(0).inverter().frequency(), 1e-2) << "the truth";
  EXPECT_NEAR(kHalfSpeed, robot.snapshot().base.velocity.linear_x, 1e-4);
}

// Under a setpoint it would be a step of the speed.
TEST(ParameterSets, P105IsNotWrittenWhileTheDriveIsEnabled) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
  const cycle::Completion answer = robot.ask(writeRequest(0, 105, 1000));
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("P105 decides what setpoints and actual values mean: disable drive"));
  EXPECT_EQ(500, robot.unit(0).parameters().value(105));
}

}  // namespace
}  // namespace nord_driver::test

// P104 > 0: the inverter turns its motor at setpoint 0. Refused, or accepted and then brought to rest by OFF1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/parameter_requests.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

SimulatedRobot::Options withP104(std::int32_t raw, bool allowed) {
  SimulatedRobot::Options options;
  options.parameters = {{104, 0, 0, raw}};
  if (allowed) options.drives = {{"allow_minimum_frequency", true}};
  return options;
}

TEST(MinimumFrequency, RefusesToEnable) {
  SimulatedRobot robot{withP104(50, false)};
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive left: P104 of parameter set 1 is 5.0 Hz"));
  EXPECT_THAT(answer.message.c_str(), HasSubstr("set P104 to 0, or allow_minimum_frequency: true"));
  robot.drive(0.0, 0.0, std::chrono::seconds{2});
  EXPECT_TRUE(robot.standsStill());
}

TEST(MinimumFrequency, OfAnotherSetRefusesNothing) {
  SimulatedRobot::Options options;
  options.parameters = {{104, 2, 0, 50}};
  SimulatedRobot robot{options};
  EXPECT_TRUE(robot.bringUpAndEnable());
}

// Accepted: a command of zero, and one that has grown old, is OFF1, and the next one leads up again.
TEST(MinimumFrequency, AcceptedACommandOfZeroIsOff1) {
  SimulatedRobot robot{withP104(50, true)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.0, 0.0, std::chrono::seconds{2});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_TRUE(robot.snapshot().base.enabled);
  EXPECT_TRUE(robot.snapshot().drives[0].enabled);
  EXPECT_EQ(0x047E, robot.controlWord(0));
  EXPECT_EQ(0x0B31, robot.statusWord(0) & 0xFFFF);
  for (const double speed : {kHalfSpeed, -kHalfSpeed}) {
    robot.drive(speed, 0.0, std::chrono::seconds{4});
    EXPECT_EQ(0x047F, robot.controlWord(0));
    EXPECT_NEAR(speed, robot.snapshot().base.velocity.linear_x, 2e-3);
    robot.run(std::chrono::seconds{4});  // nobody says anything any more
    EXPECT_EQ(0x047E, robot.controlWord(0));
    EXPECT_EQ(0, robot.setpoint(0));
    EXPECT_TRUE(robot.standsStill());
    EXPECT_TRUE(robot.snapshot().base.enabled);
    EXPECT_STREQ("", robot.snapshot().base.text.c_str());
  }
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  EXPECT_FALSE(robot.snapshot().drives[0].enabled);
}

// The inverted wheel would turn at +P104 as well, against the other one.
TEST(MinimumFrequency, ACommandBelowItMovesNoWheel) {
  SimulatedRobot robot{withP104(50, true)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  const Instant end = robot.transport().now() + std::chrono::seconds{3};
  while (robot.transport().now() < end) {
    robot.command(0.05);  // 3.2 Hz
    robot.step();
    ASSERT_LT(std::abs(robot.unit(0).shaftSpeed()), 0.1);
    ASSERT_LT(std::abs(robot.unit(1).shaftSpeed()), 0.1);
  }
  EXPECT_TRUE(robot.snapshot().drives[0].saturated);
  EXPECT_TRUE(robot.snapshot().drives[1].saturated);
  EXPECT_TRUE(robot.snapshot().base.enabled);
  robot.drive(0.5, 0.0, std::chrono::seconds{1});
  EXPECT_FALSE(robot.snapshot().drives[0].saturated);
}

// Never while it rests does a terminal stop go unnoticed.
TEST(MinimumFrequency, AStopAtTheTerminalsIsFoundAtRestToo) {
  SimulatedRobot robot{withP104(50, true)};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(0.0, 0.0, std::chrono::seconds{1});
  sim::Terminals terminals;
  terminals.coast = true;
  robot.unit(1).inverter().setTerminals(terminals);
  robot.drive(0.0, 0.0, std::chrono::seconds{1});
  EXPECT_FALSE(robot.snapshot().base.enabled);
  EXPECT_THAT(robot.snapshot().base.text.c_str(), HasSubstr("drive right stopped: OFF2"));
}

// What is written counts from then on.
TEST(MinimumFrequency, IsReadAgainAfterItWasWritten) {
  SimulatedRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  const cycle::Completion enabled = robot.ask(writeRequest(0, 104, 30));
  EXPECT_FALSE(enabled.success);
  EXPECT_THAT(enabled.message.c_str(), HasSubstr("P104"));
  EXPECT_THAT(enabled.message.c_str(), HasSubstr("disable drive left first"));
  EXPECT_EQ(0, robot.unit(0).parameters().value(104));
  robot.run(std::chrono::seconds{4});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  ASSERT_TRUE(robot.ask(writeRequest(0, 104, 30)).success);
  EXPECT_FALSE(robot.ask(cycle::RequestKind::kEnable).success) << "not before it is read";
  ASSERT_TRUE(robot.bringUp());
  EXPECT_THAT(robot.ask(cycle::RequestKind::kEnable).message.c_str(), HasSubstr("P104 of parameter set 1 is 3.0 Hz"));
  ASSERT_TRUE(robot.ask(writeRequest(0, 104, 0)).success);
  robot.run(std::chrono::milliseconds{50});
  ASSERT_TRUE(robot.bringUp());
  EXPECT_TRUE(robot.ask(cycle::RequestKind::kEnable).success);
}

}  // namespace
}  // namespace nord_driver::test

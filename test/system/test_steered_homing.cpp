// Reference runs of the steering axes of a base, over every bus: none under way, and the base stands until one has ended.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "system/steered_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

template <typename Bus>
class SteeredHoming : public ::testing::Test {
 protected:
  static SteeredOptions options() {
    SteeredOptions options;
    options.homes = true;
    return options;
  }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.report()); }
  cycle::Request home(DriveIndex drive) {
    cycle::Request request;
    request.kind = cycle::RequestKind::kHome;
    request.drive = drive;
    return request;
  }
  std::string refusal(DriveIndex drive) {
    return "drive " + robot_.nameOf(drive) +
           " steers the base, and the base is not enabled at standstill: no reference run";
  }

  SteeredRobot<Bus> robot_{options()};
};
TYPED_TEST_SUITE(SteeredHoming, EveryLift, BusName);

TYPED_TEST(SteeredHoming, IsRefusedWhileTheBaseIsNotEnabled) {
  auto& robot = this->robot_;
  ASSERT_TRUE(robot.bringUp());
  const cycle::Completion answer = robot.ask(this->home(kFrontSteering));
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(this->refusal(kFrontSteering), answer.message.str());
  EXPECT_FALSE(robot.drive(kFrontSteering).homed);
}

// Straight on, so that the axis itself stands.
TYPED_TEST(SteeredHoming, IsRefusedUnderWayAndTheBaseGoesOn) {
  auto& robot = this->robot_;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.go(0.3, 0.0, 0.0, seconds{3});
  for (const DriveIndex axis : {kFrontSteering, kRearSteering}) {
    cycle::Request request = this->home(axis);
    request.id = 900 + static_cast<std::uint32_t>(axis);
    request.patience = seconds{20};
    const std::size_t before = robot.completions().size();
    robot.ports().submit(request);
    robot.go(0.3, 0.0, 0.0, milliseconds{100});
    ASSERT_EQ(before + 1, robot.completions().size());
    EXPECT_FALSE(robot.completions().back().success);
    EXPECT_EQ(this->refusal(axis), robot.completions().back().message.str());
    robot.go(0.3, 0.0, 0.0, seconds{1});
    EXPECT_NEAR(0.3, robot.body().linear(), 0.01);
    EXPECT_NEAR(0.0, robot.angle(axis), 0.005);
  }
}

// The axis has no angle to drive by on its way, and another one in the end than before.
TYPED_TEST(SteeredHoming, TheBaseStandsUntilTheRunHasEnded) {
  auto& robot = this->robot_;
  ASSERT_TRUE(robot.bringUpAndEnable());
  cycle::Request request = this->home(kFrontSteering);
  request.id = 900;
  request.patience = seconds{20};
  robot.ports().submit(request);
  robot.run(milliseconds{50});
  const std::size_t before = robot.completions().size();
  bool rolled = false;
  std::string waits;
  for (int i = 0; i < 2000 && robot.completions().size() == before; ++i) {
    robot.say(0.3, 0.0, 0.0);
    robot.step();
    rolled = rolled || robot.setpoint(kFront) != 0 || robot.setpoint(kRear) != 0;
    if (waits.empty()) waits = robot.snapshot().base.waits.str();
  }
  ASSERT_EQ(before + 1, robot.completions().size());
  const cycle::Completion& answer = robot.completions().back();
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_FALSE(rolled);
  EXPECT_EQ(
      "drive " + robot.nameOf(kFrontSteering) + " does not take the steering angle 0: a reference run is under way",
      waits);
  EXPECT_TRUE(robot.drive(kFrontSteering).homed);
  EXPECT_FALSE(robot.drive(kRearSteering).homed);
  // The switch is a tenth of a turn below: what the drive calls 0 now, and the body does not.
  EXPECT_NEAR(-0.2 * 3.14159265358979, robot.angle(kFrontSteering), 0.05);
  EXPECT_TRUE(robot.snapshot().base.enabled) << robot.snapshot().base.text.c_str();
  robot.go(0.2, 0.0, 0.0, seconds{2});
  EXPECT_EQ("", robot.snapshot().base.waits.str());
  EXPECT_NEAR(0.0, robot.drive(kFrontSteering).joint_position, 0.01);
  EXPECT_NE(0, robot.setpoint(kRear)) << "it drives on";
}

// Commanded to stand, it rolls on down P103 where no acceleration limit holds it.
TYPED_TEST(SteeredHoming, IsRefusedWhileTheBaseRollsOut) {
  SteeredOptions options = this->options();
  options.limits = false;
  options.wheel_ramp = 3.0;
  SteeredRobot<TypeParam> robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.go(0.4, 0.0, 0.0, seconds{4});
  robot.go(0.0, 0.0, 0.0, milliseconds{200});
  ASSERT_EQ(0, robot.setpoint(kFront));
  ASSERT_GT(robot.body().linear(), 0.1);
  const cycle::Completion answer = robot.ask(this->home(kFrontSteering));
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(this->refusal(kFrontSteering), answer.message.str());
  EXPECT_NEAR(0.0, robot.angle(kFrontSteering), 0.01);
}

// An axis on its reference run follows no setpoint that could be ramped down: OFF1 is what stops it.
TYPED_TEST(SteeredHoming, DisablingEndsTheRunAtOnce) {
  auto& robot = this->robot_;
  ASSERT_TRUE(robot.bringUpAndEnable());
  cycle::Request request = this->home(kFrontSteering);
  request.id = 900;
  request.patience = seconds{20};
  robot.ports().submit(request);
  robot.run(seconds{1});
  ASSERT_GT(std::abs(robot.unit(kFrontSteering).shaftSpeed()), 0.1) << "on its way";
  const std::size_t before = robot.completions().size();
  cycle::Request disable;
  disable.kind = cycle::RequestKind::kDisable;
  disable.id = 901;
  disable.patience = seconds{3};
  robot.ports().submit(disable);
  for (int i = 0; i < 2; ++i) robot.step();
  EXPECT_EQ(0x047E, robot.controlWord(kFrontSteering));
  robot.run(seconds{2});
  EXPECT_TRUE(robot.standsStill());
  ASSERT_EQ(before + 2, robot.completions().size());
  for (std::size_t i = before; i < before + 2; ++i) {
    const cycle::Completion& answer = robot.completions()[i];
    EXPECT_EQ(answer.id == 901, answer.success) << answer.message.c_str();
  }
}

}  // namespace
}  // namespace nord_driver::test

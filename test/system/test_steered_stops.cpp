// Whatever stops a drive of a steered base stops all of it, wheels and steering axes: the drive concerned gets the idle
// word, the other wheels setpoint 0 on their own ramp and then OFF1, the other steering axes OFF1; all of it latched.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "system/steered_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr int kBound = 2;       // bus cycles after the driver knows
constexpr int kShowLimit = 30;  // bus cycles until a simulated cause shows

struct Cause {
  const char* name;
  void (*make)(sim::DriveUnit&);
  const char* told;
};

const Cause kCauses[] = {
    {"fault", [](sim::DriveUnit& unit) { unit.inverter().trip(30, true); }, "a fault of the inverter"},
    {"local control", [](sim::DriveUnit& unit) { unit.inverter().setLocalControl(true, 0.0); }, "local control"},
    {"unplugged", [](sim::DriveUnit& unit) { unit.setPlugged(false); }, "silent"},
    {"no power", [](sim::DriveUnit& unit) { unit.setInverterPower(false); }, ""},
    {"link broken", [](sim::DriveUnit& unit) { unit.setInverterLink(false); }, ""},
    {"mute", [](sim::DriveUnit& unit) { unit.setMute(true); }, "silent"},
};

/// On its way from one curve into another, so that the axes turn, too.
template <typename Bus>
class MovingBase : public SteeredRobot<Bus> {
 public:
  void driveOff() {
    ASSERT_TRUE(this->bringUpAndEnable());
    this->go(0.3, 0.4, 0.0, seconds{4});
    ASSERT_NEAR(0.3, this->body().linear(), 0.02);
    ASSERT_NEAR(0.4, this->body().angular(), 0.02);
    this->go(0.3, -0.4, 0.0, milliseconds{200});
    ASSERT_GT(std::abs(this->unit(kFrontSteering).shaftSpeed()), 1.0);
  }
  void commandAndStep() {
    this->say(0.3, -0.4, 0.0);  // somebody goes on commanding
    this->step();
  }
  bool knows(DriveIndex index) { return !this->drive(index).online || this->drive(index).stopped; }
  void expectAllTold(DriveIndex at) {
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) {
      if (isSteering(i) || i == at) {
        EXPECT_EQ(0x047E, this->controlWord(i)) << "no axis goes on to a target, drive " << i;
      } else {
        EXPECT_EQ(0, this->setpoint(i)) << i;
      }
    }
  }
  /// Down to rest, and nothing moves again by itself, the cause gone or not.
  void expectLastingRest() {
    EXPECT_TRUE(this->runUntil([this] {
      this->say(0.3, -0.4, 0.0);
      return this->standsStill();
    }));
    std::vector<double> stood;
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) stood.push_back(this->unit(i).shaftAngle());
    for (int i = 0; i < 300; ++i) commandAndStep();
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) {
      EXPECT_EQ(0x047E, this->controlWord(i) & 0xFFFE) << i;
      EXPECT_NE(0x047F, this->controlWord(i)) << i;
      EXPECT_NEAR(stood[i], this->unit(i).shaftAngle(), 0.3) << i;
    }
  }
};

template <typename Bus>
class SteeredStops : public ::testing::Test {
 protected:
  static void stopTheWholeBaseBy(DriveIndex at) {
    for (const Cause& cause : kCauses) {
      SCOPED_TRACE(cause.name);
      MovingBase<Bus> robot;
      ASSERT_NO_FATAL_FAILURE(robot.driveOff());
      cause.make(robot.unit(at));
      for (int i = 0; i < kShowLimit && !robot.knows(at); ++i) robot.commandAndStep();
      ASSERT_TRUE(robot.knows(at));
      for (int i = 0; i < kBound; ++i) robot.commandAndStep();
      robot.expectAllTold(at);
      EXPECT_FALSE(robot.snapshot().base.enabled);
      EXPECT_TRUE(robot.snapshot().base.stopped);
      EXPECT_THAT(robot.snapshot().base.text.str(), HasSubstr(cause.told));
      robot.expectLastingRest();
    }
  }
};
TYPED_TEST_SUITE(SteeredStops, EveryLift, BusName);

TYPED_TEST(SteeredStops, WhatStopsAWheelStopsTheWholeBase) {
  this->stopTheWholeBaseBy(kFront);
}

TYPED_TEST(SteeredStops, WhatStopsASteeringAxisStopsTheWholeBase) {
  this->stopTheWholeBaseBy(kRearSteering);
}

/// What is asked for, or happens to the commands: the base brakes along its limit.
template <typename Bus>
class SteeredAskedStops : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.go(0.3, 0.4, 0.0, seconds{4});
    ASSERT_NEAR(0.4, robot_.body().angular(), 0.02);
  }
  void submit(cycle::RequestKind kind) {
    cycle::Request request;
    request.kind = kind;
    request.patience = seconds{20};
    robot_.ports().submit(request);
  }
  void expectRest(Word word) {
    EXPECT_TRUE(robot_.runUntil([this] {
      robot_.say(0.3, 0.4, 0.0);
      return robot_.standsStill();
    }));
    robot_.go(0.3, 0.4, 0.0, seconds{1});
    EXPECT_TRUE(robot_.standsStill());
    for (DriveIndex i = 0; i < kSteeredDrives; ++i) EXPECT_EQ(word, robot_.controlWord(i)) << i;
  }

  SteeredRobot<Bus> robot_;
};
TYPED_TEST_SUITE(SteeredAskedStops, EveryLift, BusName);

TYPED_TEST(SteeredAskedStops, Disable) {
  auto& robot = this->robot_;
  this->submit(cycle::RequestKind::kDisable);
  robot.go(0.3, 0.4, 0.0, milliseconds{200});
  EXPECT_NEAR(0.3 - 0.2 * 0.5 * 0.75, robot.body().linear(), 0.05) << "along the limit of 0.5";
  EXPECT_NEAR(0.4 / 0.3, robot.body().angular() / robot.body().linear(), 0.1) << "on its curve";
  this->expectRest(0x047E);
}

// OFF3 on all: the wheels brake on P426, and no axis goes on.
TYPED_TEST(SteeredAskedStops, QuickStop) {
  auto& robot = this->robot_;
  this->submit(cycle::RequestKind::kQuickStop);
  robot.step();
  robot.step();
  for (DriveIndex i = 0; i < kSteeredDrives; ++i) EXPECT_EQ(0x047B, robot.controlWord(i)) << i;
  EXPECT_TRUE(robot.runUntil([&] { return robot.standsStill(); }));
  robot.go(0.3, 0.4, 0.0, seconds{1});
  EXPECT_TRUE(robot.standsStill());
}

// A command too old: it brakes on its curve, stays enabled, and holds its wheels where they stand.
TYPED_TEST(SteeredAskedStops, CommandTimeOut) {
  auto& robot = this->robot_;
  const double angle = robot.angle(kFrontSteering);
  robot.run(seconds{3});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_NEAR(angle, robot.angle(kFrontSteering), 0.02);
  for (DriveIndex i = 0; i < kSteeredDrives; ++i) EXPECT_EQ(0x047F, robot.controlWord(i)) << i;
}

TYPED_TEST(SteeredAskedStops, ShutDown) {
  auto& robot = this->robot_;
  this->submit(cycle::RequestKind::kShutDown);
  this->expectRest(0x047E);
  EXPECT_TRUE(robot.snapshot().settled);
}

template <typename Bus>
class SteeredEnable : public ::testing::Test {};
TYPED_TEST_SUITE(SteeredEnable, EveryLift, BusName);

// One that cannot be enabled keeps all of them disabled: all or none.
TYPED_TEST(SteeredEnable, AllOrNone) {
  SteeredRobot<TypeParam> robot;
  ASSERT_TRUE(robot.bringUp());
  robot.unit(kRearSteering).inverter().trip(30, true);
  robot.run(milliseconds{200});
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive " + robot.nameOf(kRearSteering)));
  for (DriveIndex i = 0; i < kSteeredDrives; ++i) EXPECT_EQ(0x047E, robot.controlWord(i)) << i;
}

}  // namespace
}  // namespace nord_driver::test

// Whatever stops a drive of a steered base stops all of it, wheels and steering axes: the drive concerned gets the idle
// word, the other wheels setpoint 0 on their own ramp and then OFF1, the other steering axes OFF1; all of it latched.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>
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
    {"Fault", [](sim::DriveUnit& unit) { unit.inverter().trip(30, true); }, "a fault of the inverter"},
    {"LocalControl", [](sim::DriveUnit& unit) { unit.inverter().setLocalControl(true, 0.0); }, "local control"},
    {"Unplugged", [](sim::DriveUnit& unit) { unit.setPlugged(false); }, "silent"},
    {"NoPower", [](sim::DriveUnit& unit) { unit.setInverterPower(false); }, ""},
    {"LinkBroken", [](sim::DriveUnit& unit) { unit.setInverterLink(false); }, ""},
    {"Mute", [](sim::DriveUnit& unit) { unit.setMute(true); }, "silent"},
};

class SteeredStops : public ::testing::TestWithParam<std::tuple<DriveIndex, Cause>> {
 protected:
  DriveIndex at() const { return std::get<0>(GetParam()); }
  const Cause& cause() const { return std::get<1>(GetParam()); }
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.go(0.3, 0.4, 0.0, seconds{4});
    ASSERT_NEAR(0.3, robot_.body().linear(), 0.02);
    ASSERT_NEAR(0.4, robot_.body().angular(), 0.02);
    // On its way into another curve: the axes turn, too.
    robot_.go(0.3, -0.4, 0.0, milliseconds{200});
    ASSERT_GT(std::abs(robot_.unit(SteeredRobot::kFrontSteering).shaftSpeed()), 1.0);
  }
  void step() {
    robot_.say(0.3, -0.4, 0.0);  // somebody goes on commanding
    robot_.step();
  }
  bool known() {
    const cycle::DriveSnapshot& drive = robot_.drive(at());
    return !drive.online || drive.stopped;
  }

  SteeredRobot robot_;
};

TEST_P(SteeredStops, StopsTheWholeBase) {
  cause().make(robot_.unit(at()));
  for (int i = 0; i < kShowLimit && !known(); ++i) step();
  ASSERT_TRUE(known());
  for (int i = 0; i < kBound; ++i) step();
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) {
    if (SteeredRobot::isSteering(i) || i == at()) {
      EXPECT_EQ(0x047E, robot_.controlWord(i)) << "no axis goes on to a target, drive " << i;
    } else {
      EXPECT_EQ(0, robot_.setpoint(i)) << i;
    }
  }
  EXPECT_FALSE(robot_.snapshot().base.enabled);
  EXPECT_TRUE(robot_.snapshot().base.stopped);
  EXPECT_THAT(robot_.snapshot().base.text.str(), HasSubstr(cause().told));

  // Down to rest, and nothing moves again by itself, the cause gone or not.
  robot_.runUntil([this] {
    robot_.say(0.3, -0.4, 0.0);
    return robot_.standsStill();
  });
  EXPECT_TRUE(robot_.standsStill());
  std::vector<double> stood;
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) stood.push_back(robot_.unit(i).shaftAngle());
  for (int i = 0; i < 300; ++i) step();
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) {
    EXPECT_EQ(0x047E, robot_.controlWord(i) & 0xFFFE) << i;
    EXPECT_NE(0x047F, robot_.controlWord(i)) << i;
    EXPECT_NEAR(stood[i], robot_.unit(i).shaftAngle(), 0.3) << i;
  }
}

std::string nameOf(const ::testing::TestParamInfo<std::tuple<DriveIndex, Cause>>& test) {
  return std::string{std::get<1>(test.param).name} +
         (SteeredRobot::isSteering(std::get<0>(test.param)) ? "AtASteeringAxis" : "AtAWheel");
}

INSTANTIATE_TEST_SUITE_P(Profibus, SteeredStops,
                         ::testing::Combine(::testing::Values(SteeredRobot::kFront, SteeredRobot::kRearSteering),
                                            ::testing::ValuesIn(kCauses)),
                         nameOf);

/// What is asked for, or happens to the commands: the base brakes along its limit.
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
    for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) EXPECT_EQ(word, robot_.controlWord(i)) << i;
  }

  SteeredRobot robot_;
};

TEST_F(SteeredAskedStops, Disable) {
  submit(cycle::RequestKind::kDisable);
  robot_.go(0.3, 0.4, 0.0, milliseconds{200});
  EXPECT_NEAR(0.3 - 0.2 * 0.5 * 0.75, robot_.body().linear(), 0.05) << "along the limit of 0.5";
  EXPECT_NEAR(0.4 / 0.3, robot_.body().angular() / robot_.body().linear(), 0.1) << "on its curve";
  expectRest(0x047E);
}

// OFF3 on all: the wheels brake on P426, and no axis goes on.
TEST_F(SteeredAskedStops, QuickStop) {
  submit(cycle::RequestKind::kQuickStop);
  robot_.step();
  robot_.step();
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) EXPECT_EQ(0x047B, robot_.controlWord(i)) << i;
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  robot_.go(0.3, 0.4, 0.0, seconds{1});
  EXPECT_TRUE(robot_.standsStill());
}

// A command too old: it brakes on its curve, stays enabled, and holds its wheels where they stand.
TEST_F(SteeredAskedStops, CommandTimeOut) {
  const double angle = robot_.angle(SteeredRobot::kFrontSteering);
  robot_.run(seconds{3});
  EXPECT_TRUE(robot_.standsStill());
  EXPECT_NEAR(angle, robot_.angle(SteeredRobot::kFrontSteering), 0.02);
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) EXPECT_EQ(0x047F, robot_.controlWord(i)) << i;
}

TEST_F(SteeredAskedStops, ShutDown) {
  submit(cycle::RequestKind::kShutDown);
  expectRest(0x047E);
  EXPECT_TRUE(robot_.snapshot().settled);
}

// One that cannot be enabled keeps all of them disabled: all or none.
TEST(SteeredEnable, AllOrNone) {
  SteeredRobot robot;
  ASSERT_TRUE(robot.bringUp());
  robot.unit(SteeredRobot::kRearSteering).inverter().trip(30, true);
  robot.run(milliseconds{200});
  const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message.c_str(), HasSubstr("drive rear_steering"));
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) EXPECT_EQ(0x047E, robot.controlWord(i)) << i;
}

}  // namespace
}  // namespace nord_driver::test

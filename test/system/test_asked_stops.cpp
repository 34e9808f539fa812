// What stops the base because somebody wants it to: the first two rows of "What stops what" and quick stop. The end of the
// node from every moment is in test_node_ends.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

SimulatedRobot::Options withDeceleration(bool one_module) {
  SimulatedRobot::Options options;
  options.one_module = one_module;
  options.node = {{"linear/x/has_acceleration_limits", true}, {"linear/x/max_acceleration", 0.5}};
  return options;
}

/// With `true` four drives behind one module SK CU4.
class AskedStops : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUpAndEnable());
    robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
    ASSERT_EQ(0x2000, robot_.setpoint(0));
    ASSERT_EQ(-0x2000, robot_.setpoint(1));
  }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.segment().referee().report()); }

  void submit(cycle::RequestKind kind) {
    cycle::Request request;
    request.kind = kind;
    request.patience = std::chrono::seconds{3};
    robot_.ports().submit(request);
  }

  SimulatedRobot robot_{withDeceleration(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Modules, AskedStops, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "FourInvertersOnOne" : "OneEach"; });

// Command older than cmd_vel_timeout: at most two cycles to the first smaller setpoint, the ramp of the configuration
// down to zero, and the drives stay enabled.
TEST_P(AskedStops, ACommandThatIsTooOldRampsDownAndStaysEnabled) {
  robot_.command(kHalfSpeed);
  robot_.run(milliseconds{500});
  EXPECT_EQ(0x2000, robot_.setpoint(0)) << "not too old yet";
  robot_.step();
  robot_.step();
  EXPECT_LT(robot_.setpoint(0), 0x2000);
  std::int16_t before = robot_.setpoint(0);
  for (int i = 0; i < 100; ++i) {
    robot_.step();
    // 0.5 m/s2 are 0.005 m/s a cycle, or 104 of 16384.
    ASSERT_LE(before - robot_.setpoint(0), 106);
    ASSERT_EQ(robot_.setpoint(0), -robot_.setpoint(1)) << "the path does not bend";
    before = robot_.setpoint(0);
  }
  EXPECT_EQ(0, robot_.setpoint(0));
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }));
  EXPECT_EQ(0x047F, robot_.controlWord(0));
  EXPECT_TRUE(robot_.snapshot().base.enabled);
  robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{1});
  EXPECT_GT(robot_.setpoint(0), 0x1000) << "a new command is followed";
}

// `enable false`: the same ramp, whatever is commanded meanwhile, then OFF1 until "ready to switch on".
TEST_P(AskedStops, DisableRampsDownThenSaysOff1) {
  robot_.command(kHalfSpeed);
  submit(cycle::RequestKind::kDisable);
  robot_.step();
  robot_.step();
  EXPECT_LT(robot_.setpoint(0), 0x2000);
  EXPECT_EQ(0x047F, robot_.controlWord(0)) << "OFF1 only after the ramp";
  bool off1_while_fast = false;
  ASSERT_TRUE(robot_.runUntil([this, &off1_while_fast] {
    robot_.command(kHalfSpeed);  // is ignored
    off1_while_fast |= robot_.controlWord(0) == 0x047E && std::abs(robot_.unit(0).shaftSpeed()) > 5.0;
    return robot_.snapshot().settled;
  }));
  EXPECT_FALSE(off1_while_fast);
  EXPECT_EQ(0x047E, robot_.controlWord(0));
  EXPECT_EQ(0x0B31, robot_.statusWord(0));
  EXPECT_EQ(0x0B31, robot_.statusWord(1));
  const cycle::Completion again = robot_.ask(cycle::RequestKind::kEnable);
  EXPECT_FALSE(again.success) << "the newest command still moves";
  EXPECT_THAT(again.message.c_str(), StartsWith("the newest cmd_vel is not zero"));
}

// OFF3 on all drives at most two cycles later; ends in "switch-on disabled", then idle.
TEST_P(AskedStops, QuickStopSaysOff3ToAllDrives) {
  robot_.command(kHalfSpeed);
  submit(cycle::RequestKind::kQuickStop);
  robot_.step();
  EXPECT_EQ(0x047B, robot_.controlWord(0));
  EXPECT_EQ(0x047B, robot_.controlWord(1));
  const double way = robot_.unit(0).wheelAngle();
  ASSERT_TRUE(robot_.runUntil([this] { return robot_.snapshot().settled; }));
  EXPECT_LT((robot_.unit(0).wheelAngle() - way) * 0.1, 0.1) << "P426 is 0.1 s";
  robot_.drive(kHalfSpeed, 0.0, std::chrono::seconds{5});
  EXPECT_TRUE(robot_.standsStill()) << "and does not start again";
  EXPECT_EQ(0x047E, robot_.controlWord(0));
  EXPECT_THAT(robot_.snapshot().base.text.c_str(), HasSubstr("a quick stop was asked for"));
}

// The node's end: the way of disable, confirmed by "ready to switch on" with bit 10 set to the last telegram.
TEST_P(AskedStops, ShutDownRampsAndEndsInReadyToSwitchOn) {
  const cycle::Completion answer = robot_.ask(cycle::RequestKind::kShutDown);
  EXPECT_TRUE(answer.success) << answer.message.c_str();
  EXPECT_EQ(0x0B31, robot_.statusWord(0));
  EXPECT_EQ(0x0B31, robot_.statusWord(1));
  EXPECT_EQ(0x047E, robot_.unit(0).counters().last_control);
  EXPECT_EQ(0x047E, robot_.unit(1).counters().last_control);
  robot_.transport().close();
  robot_.segment().run(std::chrono::seconds{1});
  EXPECT_TRUE(robot_.standsStill());
}

// A ramp that does not end in shutdown_timeout becomes a quick stop.
TEST(ShutdownTimeout, TurnsTheRampIntoAQuickStop) {
  SimulatedRobot::Options options;
  options.node = {{"shutdown_timeout", 1.0}};
  options.parameters = {{103, 0, 0, 3000}};  // 30 s down
  SimulatedRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{3});
  bool quick_stop = false;
  cycle::Request request;
  request.kind = cycle::RequestKind::kShutDown;
  request.patience = std::chrono::seconds{5};
  robot.ports().submit(request);
  const Instant start = robot.transport().now();
  ASSERT_TRUE(robot.runUntil([&] {
    quick_stop |= robot.controlWord(0) == 0x047B;
    return quick_stop && robot.snapshot().settled;
  }));
  EXPECT_LT(toSeconds(robot.transport().now() - start), 1.5);
  EXPECT_TRUE(robot.runUntil([&] { return robot.standsStill(); }, std::chrono::seconds{5}));
  EXPECT_EQ("no rule broken", robot.segment().referee().report());
}

}  // namespace
}  // namespace nord_driver::test

// A CANopen node that is no longer heard, and hears: its drive is stopped by words before the node is reset.
#include <gtest/gtest.h>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// With and without SYNC.
class CanopenSilentNode : public ::testing::TestWithParam<bool> {
 protected:
  static CanRobot::Options options() {
    CanRobot::Options options;
    options.base = false;
    options.nodes = 1;
    options.bus = {{"sync", GetParam()}};
    options.drives = {{"error_control", std::string{"heartbeat"}}};
    return options;
  }
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUp());
    const cycle::Completion enabled = robot_.ask(cycle::RequestKind::kEnable);
    ASSERT_TRUE(enabled.success) << enabled.message.c_str();
    for (int i = 0; i < 300; ++i) step();
    ASSERT_NEAR(25.0, robot_.unit(0).inverter().frequency(), 0.5);
  }
  void step() {
    robot_.ports().commandDrive(0, {kFullTurn / 2, robot_.transport().now(), true});
    robot_.step();
  }
  bool slowsDown() { return robot_.unit(0).inverter().frequency() < 24.0; }

  static constexpr double kFullTurn = 7.853981633974483;  // rad/s of the joint: 50 Hz, two pole pairs, 20:1
  CanRobot robot_{options()};
};

TEST_P(CanopenSilentNode, IsToldToStopBeforeItIsReset) {
  const std::uint64_t boot_ups = robot_.node(0).counters().boot_ups;
  robot_.link().setDeaf(0x703);  // its heartbeat; it answers SDO all the time
  int cycles = 0;
  for (; cycles < 200 && !slowsDown(); ++cycles) {
    step();
    ASSERT_EQ(sim::NmtState::kOperational, robot_.node(0).state()) << "still at 25 Hz";
    ASSERT_EQ(boot_ups, robot_.node(0).counters().boot_ups);
  }
  EXPECT_LT(cycles, 60) << "heartbeat time-out, two cycles, and a ramp of P103 seen to begin";
  robot_.link().setDeaf(std::nullopt);
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.unit(0).inverter().frequency() == 0.0; }, seconds{10}));
  EXPECT_TRUE(robot_.runUntil([this] { return robot_.online(0); }, seconds{10}));
  EXPECT_GT(robot_.node(0).counters().boot_ups, boot_ups) << "it was led up anew";
  robot_.run(seconds{2});
  EXPECT_EQ(0.0, robot_.unit(0).inverter().frequency());
}

INSTANTIATE_TEST_SUITE_P(Sync, CanopenSilentNode, ::testing::Bool());

}  // namespace
}  // namespace nord_driver::test

// Two nodes with one id, by wrongly set switches or P515: both do what the one is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/can_text.h"
#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRight = 1;
constexpr std::size_t kTwin = 2;  // answers as the right one

CanRobot::Options withTwin() {
  CanRobot::Options options;
  options.simulate = [](sim::SimConfig& config) {
    sim::DriveConfig twin = config.drives[kRight];
    twin.name = "twin";
    twin.joint = "twin_joint";
    twin.bus.as<sim::CanDriveConfig>().doubled_id = true;
    config.drives.push_back(twin);
  };
  return options;
}

class DoubleId : public ::testing::TestWithParam<const char*> {
 protected:
  static CanRobot::Options options() {
    CanRobot::Options options = withTwin();
    options.drives = {{"error_control", std::string{GetParam()}}};
    return options;
  }
  void expectNothingMoves(Duration span) {
    for (const Instant end = robot_.transport().now() + span; robot_.transport().now() < end;) {
      robot_.command(kHalfSpeed);
      robot_.step();
      ASSERT_FALSE(robot_.snapshot().base.enabled);
      ASSERT_TRUE(robot_.standsStill());
      ASSERT_EQ(0.0, robot_.unit(kTwin).shaftSpeed());
    }
  }
  void expectNamed() {
    EXPECT_FALSE(robot_.online(kRight));
    EXPECT_TRUE(robot_.online(kLeft));
    EXPECT_THAT(robot_.text(kRight), HasSubstr("two nodes"));
    EXPECT_EQ("node 4: two nodes answer with this id: is it set twice, by switches or P515?", robot_.busText());
  }

  CanRobot robot_{options()};
};

// Named, not started, not enabled; when the other is gone it comes up by itself and may be enabled.
TEST_P(DoubleId, FromTheStartIsRefusedInWords) {
  robot_.run(seconds{3});
  expectNamed();
  EXPECT_EQ(0u, robot_.node(kRight).counters().rpdos);
  EXPECT_GT(robot_.snapshot().counters.value(bus_counter::kStale), 0u) << "SDO answers nobody waited for";
  EXPECT_FALSE(robot_.ask(cycle::RequestKind::kEnable).success);
  expectNothingMoves(seconds{10});
  EXPECT_THAT(robot_.text(kRight), HasSubstr("two nodes"));
  robot_.unit(kTwin).setPlugged(false);
  ASSERT_TRUE(robot_.runUntil([this] { return robot_.online(kRight); }, seconds{8}));
  robot_.run(seconds{1});
  EXPECT_STREQ("enabled", robot_.ask(cycle::RequestKind::kEnable).message.c_str());
  robot_.drive(kHalfSpeed, 0.0, seconds{3});
  EXPECT_NEAR(-25.0, robot_.unit(kRight).inverter().frequency(), 0.1);
}

// It is switched on while the base drives: its boot-up ends the drive. Both are started for as long as it takes to stop
// them, also where nothing but our word stops an inverter (`none`), and stay out from then on.
TEST_P(DoubleId, ThatComesLaterStopsTheBase) {
  robot_.unit(kTwin).setPlugged(false);
  ASSERT_TRUE(robot_.bringUpAndEnable());
  robot_.drive(kHalfSpeed, 0.0, seconds{3});
  robot_.unit(kTwin).setPlugged(true);
  robot_.drive(kHalfSpeed, 0.0, seconds{2});
  EXPECT_FALSE(robot_.snapshot().base.enabled);
  expectNamed();
  ASSERT_TRUE(robot_.runUntil([this] { return robot_.standsStill(); }, seconds{10}));
  expectNothingMoves(seconds{20});
  EXPECT_THAT(robot_.text(kRight), HasSubstr("two nodes"));
  const std::uint64_t before = robot_.node(kRight).counters().rpdos;
  robot_.run(seconds{5});
  EXPECT_EQ(before, robot_.node(kRight).counters().rpdos) << "out";
  robot_.unit(kTwin).setPlugged(false);
  ASSERT_TRUE(robot_.runUntil([this] { return robot_.online(kRight); }, seconds{8}));
  expectNothingMoves(seconds{3});
}

// One of them was not heard in the start-up. What stops the base is that they are noticed, not `drive_timeout`.
TEST(DoubleIdInOperation, StopsTheBaseAtOnce) {
  CanRobot::Options options;
  options.node = {{"drive_timeout", 10.0}};
  options.drives = {{"error_control", std::string{"heartbeat"}}, {"heartbeat_time", 0.1}};
  CanRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{3});
  const auto noticed = [&robot] { return robot.busText().find("two nodes") != std::string::npos; };
  for (int cycles = 0; cycles < 300 && !noticed(); ++cycles) {
    if (cycles % 10 == 0) robot.bus().inject(frame("704#05"));
    robot.command(kHalfSpeed);
    robot.step();
  }
  ASSERT_TRUE(noticed());
  ASSERT_NEAR(25.0, robot.unit(kLeft).inverter().frequency(), 0.5);
  robot.drive(kHalfSpeed, 0.0, milliseconds{20});
  EXPECT_FALSE(robot.snapshot().base.enabled);
  EXPECT_FALSE(robot.online(kRight));
  EXPECT_THAT(robot.text(kRight), HasSubstr("two nodes"));
  robot.drive(kHalfSpeed, 0.0, milliseconds{300});
  EXPECT_LT(robot.unit(kLeft).inverter().frequency(), 24.0);
  EXPECT_GT(robot.unit(kRight).inverter().frequency(), -24.0);
}

INSTANTIATE_TEST_SUITE_P(ErrorControl, DoubleId, ::testing::Values("guarding", "heartbeat", "none"));

}  // namespace
}  // namespace nord_driver::test

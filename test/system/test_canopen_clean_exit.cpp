// The clean end of the driver: each node is let go in the way it allows, and none misses us afterwards.
#include <gtest/gtest.h>

#include <ostream>

#include "system/can_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr DriveIndex kLeft = 0, kRight = 1;

struct Case {
  const char* error_control;
  const char* left_reset;
  const char* right_reset;
};
void PrintTo(const Case& one, std::ostream* out) {
  *out << one.error_control << ", boot_reset " << one.left_reset << " and " << one.right_reset;
}

class CanopenCleanExit : public ::testing::TestWithParam<Case> {
 protected:
  static CanRobot::Options options(const Case& of) {
    CanRobot::Options options;
    options.drives = {{"error_control", std::string{of.error_control}}};
    if (of.error_control == std::string{"heartbeat"}) {
      options.bus = {{"heartbeat", 0.05}};
      options.drives.insert({"watch_master", 0.2});
    }
    options.each = {{{"boot_reset", std::string{of.left_reset}}}, {{"boot_reset", std::string{of.right_reset}}}};
    return options;
  }
  static void driveAndStop(CanRobot& robot) {
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.drive(kHalfSpeed, 0.0, seconds{2});
    robot.run(milliseconds{600});
    ASSERT_TRUE(robot.ask(cycle::RequestKind::kShutDown).success);
  }
};

TEST_P(CanopenCleanExit, LeavesNoFaultInAnyDrive) {
  CanRobot robot{options(GetParam())};
  ASSERT_NO_FATAL_FAILURE(driveAndStop(robot));
  robot.transport().close();
  EXPECT_FALSE(robot.bus().isOpen());
  robot.bus().run(seconds{3});
  for (const DriveIndex drive : {kLeft, kRight}) {
    EXPECT_EQ(0u, robot.node(drive).counters().masters_lost) << drive;
    EXPECT_EQ(0, robot.unit(drive).inverter().faultNumber()) << drive;
    EXPECT_EQ(sim::NmtState::kPreOperational, robot.node(drive).state()) << drive;
  }
  const std::uint64_t boot_ups = robot.node(kLeft).counters().boot_ups;
  EXPECT_EQ(GetParam().left_reset == std::string{"none"} ? 1u : 3u, boot_ups) << "power on, our start, our end";
  EXPECT_EQ("no rule broken", robot.bus().referee().report());
}

// A node that hears nobody any more costs a second at most.
TEST_P(CanopenCleanExit, TakesNoLongerThanASecond) {
  CanRobot robot{options(GetParam())};
  ASSERT_NO_FATAL_FAILURE(driveAndStop(robot));
  robot.node(kLeft).setMute(true);
  robot.node(kRight).setMute(true);
  const Instant start = robot.bus().now();
  robot.transport().close();
  EXPECT_LE(toSeconds(robot.bus().now() - start), 1.1);
}

INSTANTIATE_TEST_SUITE_P(All, CanopenCleanExit,
                         ::testing::Values(Case{"guarding", "communication", "communication"},
                                           Case{"guarding", "communication", "none"}, Case{"guarding", "none", "node"},
                                           Case{"guarding", "none", "none"}, Case{"heartbeat", "communication", "none"},
                                           Case{"heartbeat", "none", "none"}, Case{"none", "none", "communication"}));

// The next driver finds them as it expects, and drives.
TEST(CanopenCleanExitAgain, TheNextStartFindsTheNodesAsBefore) {
  CanRobot::Options options;
  options.drives = {{"boot_reset", std::string{"none"}}};
  CanRobot first{options};
  ASSERT_TRUE(first.bringUpAndEnable());
  first.run(milliseconds{600});
  ASSERT_TRUE(first.ask(cycle::RequestKind::kShutDown).success);
  first.transport().close();
  CanRobot::Options again = options;
  again.beside = &first.bus();
  CanRobot second{again};
  ASSERT_TRUE(second.bringUp()) << second.text(kLeft) << second.busText();
  const cycle::Completion enabled = second.ask(cycle::RequestKind::kEnable);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  second.drive(kHalfSpeed, 0.0, seconds{2});
  EXPECT_NEAR(25.0, first.unit(kLeft).inverter().frequency(), 0.1);
  EXPECT_EQ(100u, first.node(kLeft).communication().guard_time);
  EXPECT_EQ(3u, first.node(kLeft).communication().life_factor);
}

}  // namespace
}  // namespace nord_driver::test

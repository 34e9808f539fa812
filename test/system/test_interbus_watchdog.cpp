// The computer dies while the wheels turn: which of the watchdog of the gateway, P513 and the profile stop the drives,
// and which do not (doc/interbus.md, "When this computer dies").
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/interbus_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DeadComputer : public ::testing::Test {
 protected:
  /// Drives at half speed; then nobody runs the driver any more, for longer than both times.
  void die(const InterbusRobot::Options& options) {
    robot_ = std::make_unique<InterbusRobot>(options);
    ASSERT_TRUE(robot_->bringUpAndEnable()) << robot_->busText();
    robot_->drive(kHalfSpeed, 0.0, seconds{3});
    ASSERT_TRUE(runs(0) && runs(1));
    robot_->gateway().run(milliseconds{390});
    EXPECT_TRUE(runs(0) && runs(1)) << "before both times are over";
    robot_->gateway().run(milliseconds{30});
  }
  bool runs(std::size_t drive) {
    const sim::InverterModel& inverter = robot_->unit(drive).inverter();
    return inverter.state() == sim::InverterState::kOperationEnabled && std::abs(inverter.frequency()) > 24.0;
  }
  std::string protectedBy() { return robot_->transport().identity(0).protected_by; }

  std::unique_ptr<InterbusRobot> robot_;
};

// The watchdog, 200 ms, ends the outputs, and P513, 0.2 s, misses valid words: E10, the motor coasts.
TEST_F(DeadComputer, TheWatchdogAndP513StopTheDrives) {
  ASSERT_NO_FATAL_FAILURE(die({}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(100, robot_->unit(i).inverter().faultNumber() / 10 * 10) << "E10";
    EXPECT_EQ(0.0, robot_->unit(i).inverter().frequency());
    EXPECT_GT(std::abs(robot_->unit(i).shaftSpeed()), 5.0) << "it coasts";
  }
  EXPECT_EQ(
      "watchdog of the gateway (register 300 = 200), which ends its outputs: with P513 > 0 the inverter trips E10 and "
      "the motor coasts",
      protectedBy());
}

// P513 watches what comes from the ring, and the gateway repeats the last words.
TEST_F(DeadComputer, P513AloneStopsNothing) {
  InterbusRobot::Options options;
  options.watchdog = false;
  ASSERT_NO_FATAL_FAILURE(die(options));
  robot_->gateway().run(seconds{10});
  EXPECT_TRUE(runs(0) && runs(1));
  EXPECT_THAT(protectedBy(), IsEmpty());
  EXPECT_THAT(robot_->transport().warnings(),
              ::testing::Contains(HasSubstr("a gateway that keeps its ring going repeats the last control words for "
                                            "ever, and P513 of the inverters does not notice")));
}

// A control word 0000 is ignored.
TEST_F(DeadComputer, TheWatchdogWithoutP513StopsNothing) {
  InterbusRobot::Options options;
  options.telegram_timeout = 0;
  ASSERT_NO_FATAL_FAILURE(die(options));
  robot_->gateway().run(seconds{10});
  EXPECT_TRUE(runs(0) && runs(1));
  EXPECT_EQ(1u, robot_->gateway().gateway().watchdogTrips());
}

// DRIVECOM's 0000 is "voltage disabled" (BU 0070 6.4.2): no P513 is needed, and none trips.
TEST(DeadComputerDrivecom, TheWatchdogStopsTheDrives) {
  for (const int p513 : {0, 2}) {
    InterbusRobot::Options options;
    options.drivecom = true;
    options.telegram_timeout = p513;
    InterbusRobot robot{options};
    ASSERT_TRUE(robot.bringUpAndEnable());
    robot.drive(kHalfSpeed, 0.0, seconds{3});
    EXPECT_FALSE(robot.transport().identity(0).timeout_needed);
    EXPECT_EQ(
        "watchdog of the gateway (register 300 = 200), which ends its outputs: zeros are DRIVECOM's \"voltage "
        "disabled\", "
        "and the motor coasts",
        robot.transport().identity(0).protected_by);
    robot.gateway().run(milliseconds{210});
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(sim::InverterState::kSwitchOnDisabled, robot.unit(i).inverter().state()) << p513;
      EXPECT_GT(std::abs(robot.unit(i).shaftSpeed()), 5.0) << "it coasts";
    }
    robot.gateway().run(seconds{2});
    EXPECT_EQ(0, robot.unit(0).inverter().faultNumber()) << p513;
  }
}

// After a clean exit nobody asks any more either: the drives stand still by then, and show E10 at the next start.
TEST(InterbusCleanExit, LeavesTheDrivesAtRestAndTimedOut) {
  InterbusRobot robot;
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.drive(kHalfSpeed, 0.0, seconds{2});
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kDisable).success);
  robot.run(seconds{2});
  robot.transport().close();
  EXPECT_TRUE(robot.standsStill());
  robot.gateway().run(seconds{1});
  EXPECT_EQ(sim::InverterState::kFault, robot.unit(0).inverter().state());
  EXPECT_TRUE(robot.standsStill());
  EXPECT_EQ("no rule broken", robot.referee());
}

}  // namespace
}  // namespace nord_driver::test

// auto_enable: by itself once, and only when it has heard for cmd_vel_timeout that nobody wants to move.
#include <gmock/gmock.h>

#include <cmath>

#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

constexpr double kSpeed = 0.2;            // m/s
const std::size_t kStatusMessages = 150;  // 3 s of the driver's life

bool isEnabled(const DriveStatus& status) {
  return status.state == DriveStatus::OPERATION_ENABLED;
}

class AutoEnable : public RobotTest {
 protected:
  void TearDown() override {
    if (driver_) endDriver();
    RobotTest::TearDown();
  }
  /// On drives without a fault: the watchdog that expired after the test before has left E10.2.
  void startDriverOverHealthyDrives() {
    ASSERT_NO_FATAL_FAILURE(switchDrivesOffAndOn());
    startDriver();
  }
  /// The true speed was never seen above a creep since `mark`.
  static bool stoodStill(std::size_t mark) {
    for (const auto& truth : robot().true_odom.since(mark)) {
      if (std::fabs(truth->twist.twist.linear.x) > 1e-3) return false;
    }
    return true;
  }
  static bool everEnabled(std::size_t mark) {
    for (const auto& status : robot().left.status.since(mark)) {
      if (isEnabled(*status) || status->control_word == 0x047F) return true;
    }
    return false;
  }
  /// Starts the driver under commands that move and watches it; true when it did nothing.
  bool restsUnderCommands() {
    robot().drive(kSpeed);
    const std::size_t truth = robot().true_odom.mark(), status = robot().left.status.mark();
    startDriverOverHealthyDrives();
    EXPECT_TRUE(eventually([&] { return robot().left.status.mark() >= status + kStatusMessages; }));
    return stoodStill(truth) && !everEnabled(status);
  }
};

TEST_F(AutoEnable, NeverMovesUnderACommanderThatTalksAlready) {
  bool rested = false;
  tryAgainOnlyIfStoodStill(
      commandTimeout(),  // a commander that is held up for so long has stopped talking
      [&] {
        robot().drive(kSpeed);
        ros::WallDuration(0.1).sleep();
        rested = restsUnderCommands();
      },
      [&] { return rested; },
      [&] {
        endDriver();
        driver_.reset();
      });
  ASSERT_TRUE(rested) << "it was enabled, or moved";
  // Its turn comes when the commander has said zero for cmd_vel_timeout.
  const std::size_t truth = robot().true_odom.mark();
  robot().drive(0.0);
  EXPECT_TRUE(robot().left.status.waitNext(isEnabled));
  EXPECT_TRUE(robot().right.status.waitNext(isEnabled));
  EXPECT_TRUE(stoodStill(truth));
}

TEST_F(AutoEnable, EnablesUnderZerosAndFollowsWhatComesAfterwards) {
  robot().drive(0.0);
  const std::size_t truth = robot().true_odom.mark();
  ASSERT_NO_FATAL_FAILURE(startDriverOverHealthyDrives());
  EXPECT_TRUE(robot().left.status.waitNext(isEnabled));
  EXPECT_TRUE(robot().right.status.waitNext(isEnabled));
  EXPECT_TRUE(stoodStill(truth));
  robot().drive(kSpeed);
  EXPECT_TRUE(robot().waitForTrueSpeed(0.9 * kSpeed));
  robot().drive(0.0);
  EXPECT_TRUE(robot().waitForStandstill());
}

TEST_F(AutoEnable, EnablesWithoutAnyCommandsAndNotAgainAfterAStop) {
  ASSERT_NO_FATAL_FAILURE(startDriverOverHealthyDrives());
  EXPECT_TRUE(robot().left.status.waitNext(isEnabled));
  EXPECT_TRUE(robot().right.status.waitNext(isEnabled));
  const Answer stopped = robot().enable(false);
  EXPECT_TRUE(stopped.success) << stopped;
  const std::size_t status = robot().left.status.mark();
  EXPECT_TRUE(eventually([&] { return robot().left.status.mark() >= status + kStatusMessages; }));
  EXPECT_FALSE(everEnabled(status));
}

}  // namespace
}  // namespace nord_driver::test

// One wheel's drive lost on the way: the other one stops too, and nothing moves again by itself.
#include <gmock/gmock.h>

#include <cmath>

#include "rostest/lived_time.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What a drive needs from the plug to its first status word: the simulated inverter charges for 0.3 s.
constexpr Seconds kBackOnline{2.0};
constexpr double kSpeed = 0.4;  // m/s

class DriveLost : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    enableAndDrive(kSpeed);
  }
  static void expectBackOnline(DriveTopics& drive, const LivedTime& since) {
    const auto back = drive.status.waitNext([](const DriveStatus& status) { return status.online != 0; });
    ASSERT_TRUE(back);
    EXPECT_LT(since.ofBoth(*back), kBackOnline + Seconds{bus().module_start});
  }
};

TEST_F(DriveLost, StopsTheBaseWhichStaysStoppedWhenTheDriveIsBack) {
  const std::size_t odom_from = robot().odom.mark();
  ASSERT_TRUE(robot().simulator("left/unplug", true).success);

  // The status says so, the diagnostics say why, and the other drive comes to rest and is disabled.
  EXPECT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& status) { return !status.online && status.state == DriveStatus::UNKNOWN; }));
  const auto error = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; };
  EXPECT_THAT(robot().waitForDiagnostics("base", error), AllOf(HasSubstr("drive left"), HasSubstr("silent")));
  EXPECT_NE(robot().waitForDiagnostics("drive left", error), "");
  const auto named = [](const BusStatus& status) { return status.offline == std::vector<std::string>{"left"}; };
  const auto bus = robot().bus_status.waitNext(named);
  ASSERT_TRUE(bus);
  EXPECT_THAT(bus->text, HasSubstr("left"));
  const auto at_rest = [](const SimDrive& truth) {
    return !truth.operation_enabled && isReadyToSwitchOn(truth.status_word) && truth.control_word == 0x047E &&
           std::fabs(truth.wheel_velocity) < 0.01;
  };
  EXPECT_TRUE(robot().right.truth.waitNext(at_rest));
  EXPECT_TRUE(robot().waitForStandstill()) << "the wheel without mains coasts to rest";

  // Plugged in again it is there within 2 s, and stays where it is although commands go on.
  const auto stood = robot().true_odom.next();
  const std::size_t left_from = robot().left.truth.mark();
  const std::size_t right_from = robot().right.truth.mark();
  ASSERT_TRUE(robot().simulator("left/unplug", false).success);
  ASSERT_NO_FATAL_FAILURE(expectBackOnline(robot().left, LivedTime{robot().left}));
  EXPECT_FALSE(robot().enable(true).success) << "the command still stands";
  ASSERT_TRUE(robot().waitForRest());
  for (const auto& truth : robot().left.truth.since(left_from)) EXPECT_FALSE(truth->operation_enabled);
  for (const auto& truth : robot().right.truth.since(right_from)) EXPECT_FALSE(truth->operation_enabled);
  EXPECT_NEAR(robot().true_odom.next()->pose.pose.position.x, stood->pose.pose.position.x, 1e-3);

  // Enabled again it drives again. There was no fault: the inverter was off.
  robot().drive(0.0);
  enableAndDrive(0.3);
  robot().silence();
  EXPECT_TRUE(robot().waitForStandstill());

  // The pose has gone on without a jump: never further than twice the speed allows in the time between two
  // measurements.
  const auto poses = robot().odom.since(odom_from);
  ASSERT_GT(poses.size(), 1u);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto& before = poses[i - 1]->pose.pose.position;
    const auto& after = poses[i]->pose.pose.position;
    const double span = (poses[i]->header.stamp - poses[i - 1]->header.stamp).toSec();
    ASSERT_GE(span, 0.0);
    EXPECT_LT(std::hypot(after.x - before.x, after.y - before.y), 0.01 + 2.0 * kSpeed * span);
  }
  EXPECT_GT(poses.back()->pose.pose.position.x, poses.front()->pose.pose.position.x);
}

// The module lives on 24 V and answers for an inverter that is off: "exchange works" is not "drive online" (BU 0020
// 2.1.3).
TEST_F(DriveLost, AnInverterWithoutMainsBehindAModuleThatAnswersIsOffline) {
  ASSERT_TRUE(robot().simulator("right/power_inverter", false).success);
  EXPECT_TRUE(robot().right.status.waitNext([](const DriveStatus& status) { return !status.online; }));
  const auto error = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; };
  EXPECT_THAT(robot().waitForDiagnostics("drive right", error), HasSubstr("mains"));
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_FALSE(robot().left.truth.next()->operation_enabled);
  ASSERT_TRUE(robot().simulator("right/power_inverter", true).success);
  ASSERT_NO_FATAL_FAILURE(expectBackOnline(robot().right, LivedTime{robot().right}));
  EXPECT_TRUE(robot().waitForRest());
}

}  // namespace
}  // namespace nord_driver::test

// The robot with the times a user has who configures none: drive_timeout 50 ms, cmd_vel_timeout 0.5 s, PROFIBUS's
// watchdog 0.2 s, CANopen's guarding 3 x 0.1 s.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "nord_driver/DeviceInfo.h"
#include "rostest/lived_time.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr double kSpeed = 0.4;                // m/s
constexpr double kWheelSpeed = kSpeed / 0.1;  // rad/s
constexpr Seconds kCommandTimeout{0.5};       // the default
constexpr Seconds kDriveTimeout{0.05};        // the default
/// A driver or simulator that stood still for that long has lost answers of so many cycles that a drive may be taken
/// for silent: the base stops, and rightly so.
constexpr Seconds kStopsTheBase = 0.5 * kDriveTimeout;

class Defaults : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  void TearDown() override {
    robot().silence();
    robot().enable(false);
    EXPECT_TRUE(robot().waitForRest());
    RobotTest::TearDown();
  }
  /// What a base that stopped unasked needs to be enabled: no command, no fault.
  static void recover() {
    robot().drive(0.0);
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(robot().waitForStandstill());
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().trigger("acknowledge_faults")).success; })) << answer;
  }
  /// Both drives answered and were enabled in all that was published from these marks on; else what was told instead.
  static std::string whatStopped(std::size_t left_from, std::size_t right_from) {
    for (const auto& [drive, from] : {std::make_pair(&robot().left, left_from), {&robot().right, right_from}}) {
      for (const auto& status : drive->status.since(from)) {
        if (!status->online) return status->name + " is offline";
        if (status->state != DriveStatus::OPERATION_ENABLED) {
          return status->name + " is in state " + std::to_string(status->state);
        }
      }
    }
    return "";
  }
};

TEST_F(Defaults, AreWhatIsDrivenWith) {
  std::vector<std::string> names;
  ASSERT_TRUE(ros::param::getParamNames(names));
  for (const std::string& name : names) {
    if (name.rfind("/nord_driver/", 0) != 0) continue;
    for (const char* time : {"timeout", "watchdog", "slot_time", "guard_time", "event_time", "heartbeat", "retries"}) {
      EXPECT_EQ(name.find(time), std::string::npos) << name << " is configured";
    }
  }
  EXPECT_EQ(commandTimeout(), kCommandTimeout);
  EXPECT_EQ(driveTimeout(), kDriveTimeout);
  ros::NodeHandle node;
  Topic<DeviceInfo> topic(node, "nord_driver/left/device_info");
  const auto info = topic.waitFrom(0, [](const DeviceInfo& device) { return !device.protected_by.empty(); });
  ASSERT_TRUE(info);
  EXPECT_THAT(info->protected_by, HasSubstr(bus().default_protection));
}

// Enabled, up to speed, a second of steady driving in which no drive is missed, and down again by ~enable: nothing but
// a machine that stood still may stop the base in between.
TEST_F(Defaults, CarryARobotFromEnableToDisable) {
  std::string stopped;
  const auto attempt = [&] {
    robot().drive(0.0);
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
    ASSERT_TRUE(robot().left.status.waitNext([](const DriveStatus& s) { return s.operation_enabled != 0; }));
    ASSERT_TRUE(robot().right.status.waitNext([](const DriveStatus& s) { return s.operation_enabled != 0; }));
    const std::size_t left_from = robot().left.status.mark(), right_from = robot().right.status.mark();
    std::size_t steady_from = 0;
    robot().drive(kSpeed);
    // The end of the ramp, and 50 messages; or a stop.
    eventually([&] {
      const auto seen = robot().left.status.since(left_from);
      const auto up = std::find_if(seen.begin(), seen.end(), [](const auto& status) {
        return status->velocity_command > 0.999 * kWheelSpeed && status->velocity > 0.9 * kWheelSpeed;
      });
      if (steady_from == 0 && up != seen.end()) steady_from = robot().left.status.mark();
      stopped = whatStopped(left_from, right_from);
      return !stopped.empty() || (steady_from != 0 && robot().left.status.mark() > steady_from + 50);
    });
    if (!stopped.empty()) return;
    ASSERT_NE(steady_from, 0u) << "the robot does not become as fast as commanded";
    for (const auto& status : robot().left.status.since(steady_from)) {
      EXPECT_NEAR(status->velocity_command, kWheelSpeed, 0.01);
    }
    EXPECT_TRUE(robot().waitForTrueSpeed(0.9 * kSpeed));
  };
  tryAgainOnlyIfStoodStill(
      kStopsTheBase, attempt, [&] { return stopped.empty(); }, recover);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_EQ(stopped, "") << robot().bus_status.next()->text;

  const Answer answer = robot().enable(false);
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_TRUE(robot().waitForRest());
}

// Half a second after the last command, not the second of the other rostests; the drives stay enabled.
TEST_F(Defaults, BrakeWhenTheCommandIsHalfASecondOld) {
  std::string stopped;
  Seconds lived{0.0}, age{0.0};
  const auto attempt = [&] {
    ASSERT_NO_FATAL_FAILURE(enableAndDrive(kSpeed));
    const std::size_t left_from = robot().left.status.mark(), right_from = robot().right.status.mark();
    const LivedTime since{robot().left};
    const ros::Time last = robot().silence();
    const auto slower = robot().left.status.waitFrom(
        left_from, [](const DriveStatus& status) { return status.velocity_command < 0.99 * kWheelSpeed; });
    ASSERT_TRUE(slower) << "no time-out";
    age = Seconds{(slower->header.stamp - last).toSec()};
    lived = since.ofDriver(*slower);
    ASSERT_TRUE(robot().waitForStandstill());
    stopped = whatStopped(left_from, right_from);
  };
  tryAgainOnlyIfStoodStill(
      kStopsTheBase, attempt, [&] { return stopped.empty(); }, recover);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_EQ(stopped, "") << robot().bus_status.next()->text;
  EXPECT_GT(age, 0.99 * kCommandTimeout);
  EXPECT_LT(lived, kCommandTimeout + Seconds{0.1}) << "counted in messages of the driver, of 20 ms each";
}

}  // namespace
}  // namespace nord_driver::test

// Parameter sets: switched at standstill only, confirmed, and every setpoint scaled by P105 of the set in force.
#include <gmock/gmock.h>

#include <cmath>

#include "nord_driver/SelectParameterSet.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kWheelRadius = 0.1;  // m, robot.yaml
constexpr double kSpeed = 0.2;        // m/s

class SetSwitch : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  void TearDown() override {
    disable();
    for (const char* drive : {"left", "right"}) {
      const Answer back = select(drive, 1);
      EXPECT_TRUE(back.success) << back;
    }
    RobotTest::TearDown();
  }
  void disable() {
    robot().silence();
    const Answer answer = robot().enable(false);
    EXPECT_TRUE(answer.success) << answer;
    EXPECT_TRUE(robot().waitForRest());
  }
  static Answer select(const std::string& drive, std::uint8_t set) {
    SelectParameterSet service;
    service.request.parameter_set = set;
    return callService("nord_driver/" + drive + "/select_parameter_set", service);
  }
  /// Setpoint 1 with which both wheels turn at kSpeed.
  int setpointAtSpeed() {
    enableAndDrive(kSpeed);
    for (DriveTopics* drive : {&robot().left, &robot().right}) {
      const auto turns = [](const SimDrive& truth) {
        return std::fabs(std::fabs(truth.wheel_velocity) - kSpeed / kWheelRadius) < 0.1;
      };
      EXPECT_TRUE(drive->truth.waitNext(turns)) << drive->truth.next()->wheel_velocity;
      const auto told = [](const DriveStatus& status) {
        return std::fabs(std::fabs(status.velocity) - kSpeed / kWheelRadius) < 0.02;
      };
      EXPECT_TRUE(drive->status.waitNext(told)) << drive->status.next()->velocity;
    }
    return robot().left.truth.next()->setpoint_1;
  }
};

// Set 3 has half of P105 (common.launch): the same cmd_vel takes twice the setpoint and moves at the same speed.
TEST_F(SetSwitch, ScalesTheSetpointByTheSetInForce) {
  const int in_set_1 = setpointAtSpeed();
  disable();
  for (const char* drive : {"left", "right"}) {
    const Answer answer = select(drive, 3);
    ASSERT_TRUE(answer.success) << answer;
    EXPECT_THAT(answer.message, HasSubstr("parameter set 3 is active"));
  }
  for (DriveTopics* drive : {&robot().left, &robot().right}) {
    // Confirmed: it is so when the answer is there.
    const auto truth = drive->truth.next();
    EXPECT_EQ(truth->parameter_set, 3);
    EXPECT_EQ(truth->control_word, 0x847E) << "and nothing is enabled";
    EXPECT_FALSE(truth->operation_enabled);
    EXPECT_TRUE(drive->status.waitNext([](const DriveStatus& status) { return status.parameter_set == 3; }));
  }
  // Half of P105 in the same time is half the ramp: slower than what the base's limits ask for.
  const auto slow = [](int level, const std::string& message) {
    return level == diagnostic_msgs::DiagnosticStatus::WARN && message.find("P102 of set 3 is 0.50 s") != message.npos;
  };
  EXPECT_NE(robot().waitForDiagnostics("drive left", slow), "");
  EXPECT_NEAR(setpointAtSpeed(), 2 * in_set_1, 2);
  EXPECT_EQ(robot().left.truth.next()->control_word, 0x847F);

  disable();
  for (const char* drive : {"left", "right"}) ASSERT_TRUE(select(drive, 1).success);
  EXPECT_EQ(robot().right.truth.next()->parameter_set, 1);
  EXPECT_NEAR(setpointAtSpeed(), in_set_1, 1);
}

TEST_F(SetSwitch, IsRefusedWhileTheDrivesAreEnabled) {
  const std::size_t from = robot().left.truth.mark();
  enableAndDrive(kSpeed);
  Answer answer = select("left", 2);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("at standstill only"), HasSubstr("drive left")));
  robot().drive(0.0);
  ASSERT_TRUE(robot().waitForStandstill());
  answer = select("left", 2);
  EXPECT_FALSE(answer.success) << "enabled, though at rest";
  ASSERT_TRUE(robot().left.truth.next());
  for (const auto& truth : robot().left.truth.since(from)) ASSERT_EQ(truth->parameter_set, 1);
  EXPECT_TRUE(robot().left.truth.next()->operation_enabled) << "a refusal stops nothing";
}

// The terminals may turn the motor: nothing of it is the driver's then.
TEST_F(SetSwitch, IsRefusedUnderLocalControl) {
  disable();
  ASSERT_TRUE(robot().simulator("left/local_control", true).success);
  ASSERT_TRUE(
      robot().left.status.waitNext([](const DriveStatus& status) { return status.online && !status.bus_control; }));
  const Answer answer = select("left", 2);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("drive left"), HasSubstr("local control")));
  ASSERT_TRUE(robot().simulator("left/local_control", false).success);
  ASSERT_TRUE(robot().waitForRest());
  EXPECT_EQ(robot().left.truth.next()->parameter_set, 1);
}

TEST_F(SetSwitch, KnowsSets1To4Only) {
  disable();
  for (const int set : {0, 5, 255}) {
    const Answer answer = select("left", static_cast<std::uint8_t>(set));
    EXPECT_FALSE(answer.success);
    EXPECT_THAT(answer.message, AllOf(HasSubstr("parameter set " + std::to_string(set)), HasSubstr("1 to 4")));
  }
  EXPECT_EQ(robot().left.truth.next()->parameter_set, 1);
}

TEST_F(SetSwitch, IsAlsoConfirmedWhereTheSetIsAlreadyActive) {
  disable();
  const auto before = robot().left.truth.next()->set_switches;
  const Answer answer = select("left", 1);
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_EQ(robot().left.truth.next()->set_switches, before);
}

}  // namespace
}  // namespace nord_driver::test

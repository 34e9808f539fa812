// What may be enabled, and what ends a command: ~enable never starts a motion by itself.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "nord_driver/DeviceInfo.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Enable : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    // What the test before has left: a command, or drives whose P105 has to be read again.
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
    answer = robot().enable(false);
    ASSERT_TRUE(answer.success) << answer;
    ASSERT_TRUE(robot().waitForRest());
    mark();
  }
  void mark() {
    left_from_ = robot().left.truth.mark();
    right_from_ = robot().right.truth.mark();
  }
  void TearDown() override {
    robot().silence();
    robot().enable(false);
    RobotTest::TearDown();
  }
  /// Commands until the driver has heard it: from then on enabling is refused.
  void commandUntilHeard(double linear) {
    robot().drive(linear);
    // A call may still come before the first command: then it enables, and is taken back.
    ASSERT_TRUE(eventually([] { return !robot().enable(true).success || !robot().enable(false).success; }));
    ASSERT_TRUE(robot().waitForRest());
    mark();
  }
  /// No drive was enabled or given a setpoint since `mark`.
  void expectNothingMoved() {
    for (const auto& [topic, from] :
         {std::make_pair(&robot().left.truth, left_from_), std::make_pair(&robot().right.truth, right_from_)}) {
      ASSERT_TRUE(topic->next());
      for (const auto& truth : topic->since(from)) {
        ASSERT_FALSE(truth->operation_enabled);
        ASSERT_EQ(truth->setpoint_1, 0);
      }
    }
  }

  std::size_t left_from_ = 0, right_from_ = 0;
};

// Enabling under a standing command would move the robot at once: refused, in words.
TEST_F(Enable, IsRefusedUnderAFreshCommandThatIsNotZero) {
  ASSERT_NO_FATAL_FAILURE(commandUntilHeard(0.2));
  const Answer answer = enableUnderCommand([this] { mark(); });
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("cmd_vel is not zero"), HasSubstr("0.200 m/s"), HasSubstr("send zero")));
  expectNothingMoved();
}

TEST_F(Enable, IsAllowedUnderACommandOfZero) {
  ASSERT_NO_FATAL_FAILURE(commandUntilHeard(0.2));
  robot().drive(0.0);
  Answer answer;
  EXPECT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
}

TEST_F(Enable, IsAllowedOnceTheCommandIsOlderThanItsTimeout) {
  ASSERT_NO_FATAL_FAILURE(commandUntilHeard(0.2));
  const ros::Time last_command = robot().silence();
  Answer answer;
  ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
  EXPECT_GE((ros::Time::now() - last_command).toSec(), 0.99 * commandTimeout().count());
  for (const auto& truth : robot().left.truth.since(left_from_)) EXPECT_EQ(truth->setpoint_1, 0);
}

// Trap of status bit 9: the terminals may turn the wheel.
TEST_F(Enable, IsRefusedUnderLocalControl) {
  ASSERT_TRUE(robot().simulator("left/local_control", true).success);
  ASSERT_TRUE(
      robot().left.status.waitNext([](const DriveStatus& status) { return status.online && !status.bus_control; }));
  const Answer answer = robot().enable(true);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("drive left"), HasSubstr("local control")));
  expectNothingMoved();
  const auto warned = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::WARN; };
  EXPECT_THAT(robot().waitForDiagnostics("drive left", warned), HasSubstr("drive left is under local control"));

  ASSERT_TRUE(robot().simulator("left/local_control", false).success);
  ASSERT_TRUE(robot().left.status.waitNext([](const DriveStatus& status) { return status.bus_control != 0; }));
  const Answer again = robot().enable(true);
  EXPECT_TRUE(again.success) << again;
}

// 100 % of a setpoint: P105, or what is configured where no channel reads it.
TEST_F(Enable, DeviceInfoTellsTheMaximumFrequency) {
  ros::NodeHandle node;
  Topic<DeviceInfo> topic(node, "nord_driver/left/device_info");
  const auto info = topic.waitFrom(0, [](const DeviceInfo& device) { return device.max_frequency.size() == 4; });
  ASSERT_TRUE(info);
  // In common.launch the inverters have another one in set 3.
  for (const std::size_t set : {0u, 1u, 3u}) EXPECT_EQ(50.0, info->max_frequency[set]) << set;
}

// All drives or none.
TEST_F(Enable, IsRefusedWhileADriveIsUnplugged) {
  ASSERT_TRUE(robot().simulator("left/unplug", true).success);
  ASSERT_TRUE(robot().left.status.waitNext([](const DriveStatus& status) { return !status.online; }));
  const Answer answer = robot().enable(true);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("drive left"), HasSubstr("does not answer")));
  expectNothingMoved();
}

// A command that is not renewed ends in a ramp to zero. The drives stay enabled, and the next command moves again.
TEST_F(Enable, ACommandTimesOutByARampAndTheDrivesStayEnabled) {
  enableAndDrive(0.4);
  const std::size_t from = robot().left.truth.mark();
  robot().silence();
  ASSERT_TRUE(robot().waitForStandstill());
  // The drive's topic may be behind the body's.
  ASSERT_TRUE(robot().left.truth.waitFrom(from, [](const SimDrive& truth) { return truth.setpoint_1 == 0; }));

  std::set<int> steps;
  int last = 1 << 15;
  for (const auto& truth : robot().left.truth.since(from)) {
    EXPECT_TRUE(truth->operation_enabled);
    EXPECT_LE(truth->setpoint_1, last);
    last = truth->setpoint_1;
    steps.insert(last);
  }
  EXPECT_EQ(last, 0);
  EXPECT_GE(steps.size(), 5u) << "a step, no ramp";
  EXPECT_EQ(robot().left.status.next()->state, DriveStatus::OPERATION_ENABLED);
  EXPECT_EQ(robot().right.status.next()->state, DriveStatus::OPERATION_ENABLED);

  robot().drive(0.3);
  EXPECT_TRUE(robot().waitForTrueSpeed(0.27));
}

// Local control of one drive while driving: the base stops, and when the bus has control again it stays stopped
// although commands went on all the time.
TEST_F(Enable, LocalControlWhileDrivingStopsTheBaseUntilItIsEnabledAgain) {
  enableAndDrive(0.4);
  ASSERT_TRUE(robot().simulator("right/local_control", true).success);
  ASSERT_TRUE(robot().waitForStandstill());
  const auto error = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; };
  EXPECT_THAT(robot().waitForDiagnostics("base", error), AllOf(HasSubstr("drive right"), HasSubstr("local control")));
  ASSERT_TRUE(robot().simulator("right/local_control", false).success);
  ASSERT_TRUE(robot().waitForRest());
  EXPECT_FALSE(enableUnderCommand([this] { mark(); }).success) << "the command still stands";
  expectNothingMoved();
}

}  // namespace
}  // namespace nord_driver::test

// A lift by its topics and services: three heights, every way of being stopped half-way, a reference run.
#include <gmock/gmock.h>
#include <nord_driver/ReadParameter.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt8.h>
#include <std_srvs/SetBool.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr double kRevolutionsPerMetre = 100.0;
constexpr double kStep = 1.01e-5;  // m, 0.001 revolutions

class Lift : public RobotTest {
 protected:
  Lift() : target_(node_.advertise<std_msgs::Float64>("/nord_driver/left/position_command", 1)) {}

  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(eventually([&] { return target_.getNumSubscribers() > 0; }));
  }
  void TearDown() override {
    enable(false);
    RobotTest::TearDown();
  }
  static Answer enable(bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    return callService("nord_driver/left/enable", service);
  }
  static bool isEnabled() {
    return eventually([] { return enable(true).success; });
  }
  /// The control takes a last step towards where it stands, which shows as a speed for a moment; a reference run begins
  /// at standstill only.
  static bool isEnabledAtRest() {
    constexpr double kStill = 0.001;  // m/s
    int still = 0;
    return isEnabled() && robot().left.status.waitNext([&still](const DriveStatus& told) {
      still = std::fabs(told.velocity) < kStill ? still + 1 : 0;
      return still == 10;
    }) != nullptr;
  }
  void goTo(double height) {
    std_msgs::Float64 message;
    message.data = height;
    target_.publish(message);
  }
  /// In truth; the message is still to come.
  static bool standsStill() {
    return robot().left.truth.waitNext([](const SimDrive& is) { return std::fabs(is.shaft_velocity) < 0.05; }) !=
           nullptr;
  }
  static double position() { return robot().left.truth.next()->position; }
  /// Nothing turns for a second.
  static bool stays() {
    const double before = position();
    const std::size_t from = robot().left.truth.mark();
    if (!eventually([&] { return robot().left.truth.mark() >= from + 50; })) return false;
    for (const auto& seen : robot().left.truth.since(from)) {
      if (std::fabs(seen->position - before) > 0.01) return false;
    }
    return true;
  }

  ros::NodeHandle node_;
  ros::Publisher target_;
};

TEST_F(Lift, GoesToThreeHeights) {
  ASSERT_TRUE(robot().left.status.waitNext([](const DriveStatus& status) { return std::isfinite(status.position); }))
      << "its position is told before it is enabled";
  ASSERT_TRUE(isEnabled());
  EXPECT_TRUE(stays()) << "enabling moves nothing";
  for (const double height : {0.8, -0.3, 0.25}) {
    goTo(height);
    const auto there = robot().left.status.waitNext([height](const DriveStatus& status) {
      return status.position_reached && std::fabs(status.position - height) < kStep;
    });
    ASSERT_TRUE(there) << height;
    EXPECT_NEAR(height * kRevolutionsPerMetre, position(), 0.003);
    EXPECT_TRUE(robot().joint_states.waitNext([height](const sensor_msgs::JointState& state) {
      for (std::size_t i = 0; i < state.name.size(); ++i) {
        if (state.name[i] == "lift_joint") return std::fabs(state.position[i] - height) < 2 * kStep;
      }
      return false;
    }));
  }
}

TEST_F(Lift, IsStoppedHalfWayAndForgetsItsTarget) {
  struct Cause {
    const char* name;
    std::function<void()> begin, end;
  };
  const auto nothing = [] {};
  const std::vector<Cause> causes{
      {"enable false", [] { EXPECT_TRUE(enable(false).success); }, nothing},
      {"quick stop", [] { EXPECT_TRUE(robot().trigger("left/quick_stop").success); }, nothing},
      {"fault", [] { robot().trip("left", 30, false); }, [] { robot().trigger("left/acknowledge_fault"); }},
      {"local control", [] { robot().simulator("left/local_control", true); },
       [] { robot().simulator("left/local_control", false); }},
      {"silence", [] { robot().simulator("left/unplug", true); }, [] { robot().simulator("left/unplug", false); }},
  };
  for (const Cause& cause : causes) {
    SCOPED_TRACE(cause.name);
    ASSERT_TRUE(isEnabled());
    const double far = robot().left.status.next()->position > 1.5 ? -0.9 : 3.9;
    goTo(far);
    ASSERT_TRUE(robot().left.truth.waitNext([](const SimDrive& is) { return std::fabs(is.shaft_velocity) > 20.0; }));
    cause.begin();
    ASSERT_TRUE(robot().left.status.waitNext(
        [](const DriveStatus& status) { return (status.control_word & 0x000Fu) != 0x000Fu || !status.online; }));
    ASSERT_TRUE(standsStill());
    cause.end();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    eventually([] { return robot().trigger("left/acknowledge_fault").success; });
    EXPECT_TRUE(stays()) << "nothing moves unasked";
    EXPECT_GT(std::fabs(position() - far * kRevolutionsPerMetre), 5.0) << "it was half-way";
    ASSERT_TRUE(isEnabled());
    EXPECT_TRUE(stays()) << "its target is forgotten";
    EXPECT_TRUE(enable(false).success);
  }
}

TEST_F(Lift, RefusesWhatIsBeyondItsLimits) {
  ASSERT_TRUE(isEnabled());
  goTo(4.1);
  const std::string told = robot().waitForDiagnostics(
      "drive left", [](int, const std::string& message) { return message.find("upper limit") != std::string::npos; });
  EXPECT_THAT(told, HasSubstr("the target 4.1 is not taken"));
  EXPECT_TRUE(stays());
}

TEST_F(Lift, IsTaughtItsPosition) {
  ASSERT_TRUE(isEnabled());
  EXPECT_THAT(robot().trigger("left/teach_position").message, HasSubstr("disable it first"));
  goTo(0.2);
  ASSERT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& told) { return told.position_reached && std::fabs(told.position - 0.2) < kStep; }));
  ASSERT_TRUE(enable(false).success);
  const Answer answer = robot().trigger("left/teach_position");
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_TRUE(stays());
  ReadParameter read;
  read.request.number = 613;
  read.request.index = 1;
  ASSERT_TRUE(callService("nord_driver/left/read_parameter", read).success);
  EXPECT_NEAR(20'000, read.response.raw, 1) << "0.001 revolutions; the control rests within a step";
  EXPECT_NEAR(position() * 1000.0, read.response.raw, 2.0);
  const bool whole = read.response.raw == 20'000;
  EXPECT_THAT(answer.message, HasSubstr(whole                        ? "P613[-01] is 20.0"
                                        : read.response.raw < 20'000 ? "P613[-01] is 19.999"
                                                                     : "P613[-01] is 20.001"));
}

TEST_F(Lift, GoesOnwardAndToAnElement) {
  auto onward = node_.advertise<std_msgs::Float64>("/nord_driver/left/position_increment", 1);
  auto element = node_.advertise<std_msgs::UInt8>("/nord_driver/left/position_element", 1);
  ASSERT_TRUE(eventually([&] { return onward.getNumSubscribers() > 0 && element.getNumSubscribers() > 0; }));
  const auto arrives = [](double height) {
    return robot().left.status.waitNext([height](const DriveStatus& told) {
      return told.position_reached && std::fabs(told.position - height) < 2 * kStep;
    }) != nullptr;
  };
  ASSERT_TRUE(isEnabled());
  goTo(0.1);
  ASSERT_TRUE(arrives(0.1));
  std_msgs::Float64 increment;
  increment.data = 0.25;
  onward.publish(increment);
  EXPECT_TRUE(arrives(0.35));
  ReadParameter read;
  read.request.number = 613;
  read.request.index = 1;
  ASSERT_TRUE(callService("nord_driver/left/read_parameter", read).success);
  std_msgs::UInt8 first;
  first.data = 1;
  element.publish(first);
  EXPECT_TRUE(arrives(read.response.raw / 1000.0 / kRevolutionsPerMetre)) << read.response.raw;
}

TEST_F(Lift, Homes) {
  EXPECT_THAT(robot().trigger("left/home").message, HasSubstr("not enabled"));
  ASSERT_TRUE(isEnabledAtRest());
  const Answer answer = robot().trigger("left/home");
  EXPECT_TRUE(answer.success) << answer;
  const auto status = robot().left.status.waitNext([](const DriveStatus& told) { return told.homed != 0; });
  ASSERT_TRUE(status);
  EXPECT_NEAR(0.0, status->position, 0.01);
  EXPECT_NEAR(0.0, position(), 1.0);
  EXPECT_TRUE(stays());
  goTo(0.1);
  EXPECT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& told) { return told.position_reached && std::fabs(told.position - 0.1) < kStep; }));
}

// A call that waited for the first one's end would start a run that nobody expects any more.
TEST_F(Lift, RefusesASecondReferenceRunWhileTheFirstRuns) {
  ASSERT_TRUE(isEnabledAtRest());
  Answer first;
  std::atomic<bool> ended{false};
  std::thread caller{[&] {
    first = robot().trigger("left/home");
    ended = true;
  }};
  EXPECT_TRUE(robot().left.truth.waitNext([](const SimDrive& is) { return std::fabs(is.shaft_velocity) > 1.0; }));
  const Answer second = robot().trigger("left/home");
  EXPECT_FALSE(second.success);
  EXPECT_THAT(second.message, HasSubstr("a reference run is under way already"));
  EXPECT_FALSE(ended) << "it was answered while the first one ran";
  caller.join();
  EXPECT_TRUE(first.success) << first;
  EXPECT_TRUE(stays()) << "once is enough";
}

TEST_F(Lift, SetsItsCountAnewWhereItStands) {
  ASSERT_TRUE(isEnabled());
  EXPECT_THAT(robot().trigger("left/reset_position").message, HasSubstr("disable it first"));
  goTo(0.15);
  EXPECT_TRUE(robot().left.status.waitNext([](const DriveStatus& told) { return told.position_following != 0; }));
  ASSERT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& told) { return told.position_reached && std::fabs(told.position - 0.15) < kStep; }));
  ASSERT_TRUE(enable(false).success);
  const Answer answer = robot().trigger("left/reset_position");
  EXPECT_TRUE(answer.success) << answer;
  const auto status = robot().left.status.waitNext([](const DriveStatus&) { return true; });
  EXPECT_NEAR(0.0, status->position, kStep);
  EXPECT_FALSE(status->position_following || status->position_at_limit);
  EXPECT_NEAR(0.0, position(), 0.002);
  EXPECT_TRUE(stays());
  ASSERT_TRUE(isEnabled());
  EXPECT_TRUE(stays()) << "it is held where it stands";
}

}  // namespace
}  // namespace nord_driver::test

#include "node/robot_under_test.h"

#include <signal.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <ostream>

#include "nord_driver/ReadParameter.h"
#include "nord_driver/SimTrip.h"

namespace nord_driver::test {

namespace {

constexpr double kCommandPeriod = 0.02;  // s
constexpr double kWheelRadius = 0.1;     // m, robot.yaml
constexpr double kStandstill = 1e-3;     // m/s

}  // namespace

std::ostream& operator<<(std::ostream& out, const Answer& answer) {
  return out << (answer.success ? "success: " : "refused: ") << answer.message;
}

RobotUnderTest::RobotUnderTest() : RobotUnderTest(ros::NodeHandle()) {}

RobotUnderTest::RobotUnderTest(ros::NodeHandle node)
    : left(node, "left"),
      right(node, "right"),
      odom(node, "odom"),
      true_odom(node, "nord_sim/truth/odom"),
      joint_states(node, "joint_states"),
      bus_status(node, "nord_driver/bus_status"),
      diagnostics(node, "/diagnostics"),
      command_publisher_(node.advertise<geometry_msgs::Twist>("cmd_vel", 1)) {
  const auto publish = [this](const ros::SteadyTimerEvent&) {
    const std::lock_guard<std::mutex> lock(command_mutex_);
    if (commanding_) command_publisher_.publish(command_);
  };
  command_timer_ = node.createSteadyTimer(ros::WallDuration(kCommandPeriod), publish);
}

Answer RobotUnderTest::setBool(const std::string& name, bool on) {
  std_srvs::SetBool service;
  service.request.data = on;
  return callService(name, service);
}

Answer RobotUnderTest::enable(bool on) {
  return setBool("nord_driver/enable", on);
}

Answer RobotUnderTest::simulator(const std::string& service, bool on) {
  return setBool("nord_sim/" + service, on);
}

Answer RobotUnderTest::callTrigger(const std::string& name) {
  std_srvs::Trigger service;
  return callService(name, service);
}

Answer RobotUnderTest::trigger(const std::string& service) {
  return callTrigger("nord_driver/" + service);
}

Answer RobotUnderTest::trip(const std::string& drive, std::uint16_t number, bool cause_stays) {
  SimTrip service;
  service.request.number = number;
  service.request.cause_stays = cause_stays;
  return callService("nord_sim/" + drive + "/trip", service);
}

Answer RobotUnderTest::clearCause(const std::string& drive) {
  return callTrigger("nord_sim/" + drive + "/clear_cause");
}

Answer RobotUnderTest::readParameter(const std::string& drive, std::uint16_t number) {
  ReadParameter service;
  service.request.number = number;
  return callService("nord_driver/" + drive + "/read_parameter", service);
}

Answer RobotUnderTest::referee() {
  return callTrigger("nord_sim/referee");
}

void RobotUnderTest::drive(double linear, double angular) {
  const std::lock_guard<std::mutex> lock(command_mutex_);
  command_.linear.x = linear;
  command_.angular.z = angular;
  commanding_ = true;
}

bool RobotUnderTest::waitForDrivesOnline(Seconds limit) {
  // The device information is complete, so that enabling is not refused for an unknown P105: frequencies are scaled.
  const auto online = [](const DriveStatus& status) { return status.online != 0; };
  return left.status.waitNext(online, limit) != nullptr && right.status.waitNext(online, limit) != nullptr;
}

bool RobotUnderTest::waitForRest(Seconds limit) {
  const auto seen = [](const DriveStatus& status) { return status.state == DriveStatus::READY_TO_SWITCH_ON; };
  const auto so = [](const SimDrive& drive) { return isReadyToSwitchOn(drive.status_word); };
  return left.status.waitNext(seen, limit) && right.status.waitNext(seen, limit) && left.truth.waitNext(so, limit) &&
         right.truth.waitNext(so, limit);
}

bool RobotUnderTest::waitForTrueSpeed(double linear, Seconds limit) {
  return true_odom.waitNext([&](const nav_msgs::Odometry& odometry) { return odometry.twist.twist.linear.x >= linear; },
                            limit) != nullptr;
}

bool RobotUnderTest::waitForStandstill(Seconds limit) {
  return true_odom.waitNext(
             [](const nav_msgs::Odometry& odometry) {
               return std::fabs(odometry.twist.twist.linear.x) < kStandstill &&
                      std::fabs(odometry.twist.twist.angular.z) < kStandstill;
             },
             limit) != nullptr;
}

std::string RobotUnderTest::waitForDiagnostics(const std::string& task,
                                               const std::function<bool(int, const std::string&)>& good,
                                               Seconds limit) {
  std::string found;
  diagnostics.waitNext(
      [&](const diagnostic_msgs::DiagnosticArray& array) {
        for (const auto& status : array.status) {
          if (status.name == "nord_driver: " + task && good(status.level, status.message)) found = status.message;
        }
        return !found.empty();
      },
      limit);
  return found;
}

RobotUnderTest& RobotTest::robot() {
  static RobotUnderTest robot;
  return robot;
}

void RobotTest::SetUp() {
  robot().silence();
}

void RobotTest::TearDown() {
  robot().silence();
  for (const char* drive : {"left", "right"}) {
    EXPECT_TRUE(robot().simulator(std::string(drive) + "/unplug", false).success);
    EXPECT_TRUE(robot().simulator(std::string(drive) + "/local_control", false).success);
  }
  if (HasFailure() && driver_) std::fputs(driver_->errorText().c_str(), stderr);
  driver_.reset();
  const Answer judgement = robot().referee();
  EXPECT_TRUE(judgement.success) << judgement;
}

void RobotTest::startDriver() {
  driver_ = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
  ASSERT_TRUE(robot().waitForDrivesOnline());
}

void RobotTest::endDriver() {
  robot().silence();
  driver_->signal(SIGTERM);
  EXPECT_TRUE(driver_->waitEnd(kPatience)) << "the driver does not end";
}

void RobotTest::switchDrivesOffAndOn() {
  for (const char* drive : {"left", "right"}) {
    ASSERT_TRUE(robot().simulator(std::string(drive) + "/unplug", true).success);
    ASSERT_TRUE(robot().simulator(std::string(drive) + "/unplug", false).success);
  }
}

void RobotTest::enableAndDrive(double linear) {
  // P105 is read in the first moments after a drive is there; before, enabling is refused.
  Answer answer;
  EXPECT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
  robot().drive(linear);
  const double wheel = linear / kWheelRadius;
  ASSERT_TRUE(robot().left.status.waitNext([&](const DriveStatus& status) {
    return status.velocity_command >= 0.999 * wheel;
  })) << "the ramp does not end";
  ASSERT_TRUE(robot().waitForTrueSpeed(0.9 * linear));
}

std::string RobotTest::refusalOfEnable() {
  Answer answer;
  EXPECT_TRUE(eventually([&] {
    answer = robot().enable(true);
    return answer.message.find("cmd_vel") == std::string::npos;
  })) << answer;
  EXPECT_FALSE(answer.success) << answer;
  return answer.message;
}

bool onCanopen() {
  return ros::param::param("nord_driver/transport", std::string{}) == "nord_driver/canopen";
}

bool isError(int level, const std::string&) {
  return level == diagnostic_msgs::DiagnosticStatus::ERROR;
}

bool eventually(const std::function<bool()>& condition, Seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    ros::WallDuration(0.02).sleep();
  }
  return true;
}

bool isReadyToSwitchOn(std::uint16_t status_word) {
  return (status_word & 0x006F) == 0x0021;
}

}  // namespace nord_driver::test

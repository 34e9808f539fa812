#include "rostest/robot_under_test.h"

#include <signal.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "nord_driver/ReadParameter.h"
#include "nord_driver/SimTrip.h"
#include "support/second_try.h"

namespace nord_driver::test {

namespace {

constexpr double kCommandPeriod = 0.02;  // s
constexpr double kWheelRadius = 0.1;     // m, robot.yaml
constexpr double kStandstill = 1e-3;     // m/s
const Seconds kMoment{0.5 * timeFactor()};

/// Whether a drive has been lost since this was made: to the driver, or the drive its master.
class DriveLoss {
 public:
  explicit DriveLoss(const DriveTopics& drive)
      : drive_(drive), status_from_(drive.status.mark()), truth_from_(drive.truth.mark()) {}
  bool happened() const {
    bool online = false;
    for (const auto& status : drive_.status.since(status_from_)) {
      if (online && !status->online) return true;
      online = status->online != 0;
    }
    const auto truths = drive_.truth.since(truth_from_);
    return !truths.empty() && truths.back()->watchdog_trips > truths.front()->watchdog_trips;
  }

 private:
  const DriveTopics& drive_;
  std::size_t status_from_, truth_from_;
};

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
    if (!commanding_) return;
    last_command_ = ros::Time::now();
    command_publisher_.publish(command_);
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
  geometry_msgs::Twist twist;
  twist.linear.x = linear;
  twist.angular.z = angular;
  command(twist);
}

ros::Time RobotUnderTest::command(const geometry_msgs::Twist& twist) {
  const std::lock_guard<std::mutex> lock(command_mutex_);
  command_ = twist;
  commanding_ = true;
  return last_command_;
}

ros::Time RobotUnderTest::silence() {
  const std::lock_guard<std::mutex> lock(command_mutex_);
  commanding_ = false;
  return last_command_;
}

ros::Time RobotUnderTest::lastCommand() const {
  const std::lock_guard<std::mutex> lock(command_mutex_);
  return last_command_;
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
  judgeWire();
}

void RobotTest::judgeWire() {
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
  std::string missing;
  const auto attempt = [&] {
    const DriveLoss left(robot().left), right(robot().right);
    const auto lost = [&] { return left.happened() || right.happened(); };
    missing = tryToDrive(linear, lost);
    if (!missing.empty() && lost()) missing += "; a drive was lost";
  };
  const auto prepare = [] {
    robot().drive(0.0);
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(robot().waitForStandstill());
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().trigger("acknowledge_faults")).success; })) << answer;
  };
  tryAgainOnlyIfStoodStill(
      0.5 * driveTimeout(), attempt, [&] { return missing.empty(); }, prepare);
  ASSERT_EQ(missing, "");
}

std::string RobotTest::tryToDrive(double linear, const std::function<bool()>& lost) {
  // P105 is read in the first moments after a drive is there; before, enabling is refused.
  Answer answer;
  eventually([&] { return (answer = robot().enable(true)).success || lost(); });
  if (!answer.success) return answer.message;
  robot().drive(linear);
  bool reached = false;
  const auto ramped = [&](const DriveStatus& status) {
    return status.velocity_command >= 0.999 * linear / kWheelRadius;
  };
  eventually([&] { return (reached = robot().left.status.waitNext(ramped, kMoment) != nullptr) || lost(); });
  if (!reached) return "the ramp does not end";
  eventually([&] { return (reached = robot().waitForTrueSpeed(0.9 * linear, kMoment)) || lost(); });
  return reached ? "" : "the robot does not become as fast as commanded";
}

Answer RobotTest::enableUnderCommand(const std::function<void()>& begin) {
  const auto take_back = [] {
    robot().enable(false);
    EXPECT_TRUE(robot().waitForRest());
  };
  return askUnderCommand([] { return robot().lastCommand(); }, [] { return robot().enable(true); }, take_back, begin);
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

Seconds commandTimeout() {
  return Seconds{ros::param::param("nord_driver/cmd_vel_timeout", 0.5)};
}

Seconds driveTimeout() {
  const double three_cycles = 3.0 / ros::param::param("nord_driver/cycle_rate", 100.0);
  return Seconds{ros::param::param("nord_driver/drive_timeout", std::max(three_cycles, 0.05))};
}

Answer askUnderCommand(const std::function<ros::Time()>& last_command, const std::function<Answer()>& ask,
                       const std::function<void()>& take_back, const std::function<void()>& begin) {
  const double just_now = 0.05 * commandTimeout().count();
  Answer answer;
  const auto attempt = [&] {
    begin();
    EXPECT_TRUE(eventually([&] { return (ros::Time::now() - last_command()).toSec() < just_now; })) << "no commands";
    answer = ask();
  };
  tryAgainOnlyIfStoodStill(
      0.5 * commandTimeout(), attempt, [&] { return !answer.success; }, take_back);
  return answer;
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

// The robot of the rostests as a user sees it (topics and services of driver) and as it really is (the simulator's
// truth).
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "nord_driver/BusStatus.h"
#include "nord_driver/DriveStatus.h"
#include "nord_driver/SimDrive.h"
#include "ros_support/service_call.h"
#include "rostest/bus_under_test.h"
#include "rostest/node_process.h"
#include "rostest/topic.h"

namespace nord_driver::test {

/// What a service answered.
struct Answer {
  bool success = false;
  std::string message;
};
std::ostream& operator<<(std::ostream& out, const Answer& answer);

/// Calls a service of any type that answers `success` and `message`; the rest of the answer is in `service`.
template <typename Service>
Answer callService(const std::string& name, Service& service) {
  if (!ros::service::waitForService(name, ros::Duration(kPatience.count()))) return {false, name + " does not exist"};
  if (!carryOut(name, service)) return {false, name + " was not carried out"};
  return {service.response.success != 0, service.response.message};
}

/// One side's drive.
struct DriveTopics {
  DriveTopics(ros::NodeHandle& node, const std::string& drive)
      : status(node, "nord_driver/" + drive + "/status"), truth(node, "nord_sim/truth/" + drive) {}
  Topic<DriveStatus> status;
  Topic<SimDrive> truth;
};

class RobotUnderTest {
 public:
  RobotUnderTest();

  /// ~enable of the driver.
  Answer enable(bool on);
  /// A std_srvs/Trigger service of the driver: "left/acknowledge_fault".
  Answer trigger(const std::string& service);
  /// A std_srvs/SetBool service of the simulator: "left/unplug".
  Answer simulator(const std::string& service, bool on);
  /// Lets a simulated inverter trip; `number` as P700 shows it. Without `cause_stays` it can be acknowledged at once.
  Answer trip(const std::string& drive, std::uint16_t number, bool cause_stays);
  Answer clearCause(const std::string& drive);
  /// ~<drive>/read_parameter of the driver.
  Answer readParameter(const std::string& drive, std::uint16_t number);
  /// The simulator's judgement of all that was on the bus.
  Answer referee();

  /// Publishes this velocity 50 times a second until the next call.
  void drive(double linear, double angular = 0.0);
  /// When the command before went out last: not before then does it begin to grow old.
  ros::Time command(const geometry_msgs::Twist& twist);
  /// No more commands; when the last one went out.
  ros::Time silence();
  ros::Time lastCommand() const;

  bool waitForDrivesOnline(Seconds limit = kPatience);
  /// Both drives "ready to switch on", in words of the driver and in truth.
  bool waitForRest(Seconds limit = kPatience);
  /// The true speed of the body along its x axis is at least `linear`, by now and from a message that is still to come.
  bool waitForTrueSpeed(double linear, Seconds limit = kPatience);
  bool waitForStandstill(Seconds limit = kPatience);
  /// The message of a task of /diagnostics ("base", "drive left") for which `good(level, message)` holds; empty when
  /// none comes.
  std::string waitForDiagnostics(const std::string& task, const std::function<bool(int, const std::string&)>& good,
                                 Seconds limit = kPatience);

  DriveTopics left, right;
  Topic<nav_msgs::Odometry> odom, true_odom;
  Topic<sensor_msgs::JointState> joint_states;
  Topic<BusStatus> bus_status;
  Topic<diagnostic_msgs::DiagnosticArray> diagnostics;

 private:
  explicit RobotUnderTest(ros::NodeHandle node);
  Answer setBool(const std::string& service, bool on);
  Answer callTrigger(const std::string& service);

  ros::Publisher command_publisher_;
  mutable std::mutex command_mutex_;
  bool commanding_ = false;
  geometry_msgs::Twist command_;
  ros::Time last_command_;
  ros::SteadyTimer command_timer_;
};

/// A test on a robot whose drives are there, idle, healthy and without commands; afterwards it is brought there again
/// and the referee must have nothing to say.
class RobotTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  /// What the referee of the bus has seen since the simulator began: nothing.
  virtual void judgeWire();
  /// The driver as a child, with the parameters of /nord_driver.
  void startDriver();
  /// Ends it cleanly: the drives at rest and without a fault.
  void endDriver();
  /// ~enable and a steady speed forward, the ramp behind it: what a test proves comes after it. Tried again where the
  /// machine stood still for so long that a drive may have been lost (support/second_try.h).
  void enableAndDrive(double linear);
  /// What ~enable answers while the robot's command is fresh.
  Answer enableUnderCommand(const std::function<void()>& begin = [] {});
  /// Why ~enable is refused once no cmd_vel that is not zero stands against it: there must be another reason.
  std::string refusalOfEnable();
  /// The mains of both: no fault survives that.
  void switchDrivesOffAndOn();

  /// Shared by all tests of a program.
  static RobotUnderTest& robot();
  std::unique_ptr<NodeProcess> driver_;

 private:
  /// Empty, or what has not come.
  std::string tryToDrive(double linear, const std::function<bool()>& lost);
};

/// cmd_vel_timeout of the driver.
Seconds commandTimeout();

/// drive_timeout of the driver.
Seconds driveTimeout();

/// What `ask` answers to while a command stands that was published last at `last_command()`: it must refuse. Where the
/// machine stood still for so long that the command may have been too old, what was granted is taken back and asked for
/// again (support/second_try.h); `begin` comes before each.
Answer askUnderCommand(
    const std::function<ros::Time()>& last_command, const std::function<Answer()>& ask,
    const std::function<void()>& take_back, const std::function<void()>& begin = [] {});

/// The level of a task of /diagnostics; for `waitForDiagnostics`.
bool isError(int level, const std::string& message);

/// Asks again and again until `condition` holds; false when it does not within `limit`.
bool eventually(const std::function<bool()>& condition, Seconds limit = kPatience);

/// The state bits 0, 1, 2, 3, 5 and 6 say "ready to switch on" (BU 2700 6.4.2: X01X0001).
bool isReadyToSwitchOn(std::uint16_t status_word);

}  // namespace nord_driver::test

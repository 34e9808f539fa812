// What stops what, while the robot drives and its commands go on: the words that go out, how soon, and that only
// ~enable moves again. Exact bounds are proven in simulated time; here they are seen through the topics of the real
// programs.
#include <gmock/gmock.h>
#include <rosgraph_msgs/Log.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "nord_driver/SimTerminals.h"
#include "rostest/cycles_until.h"
#include "rostest/lived_time.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using geometry_msgs::Twist;
using geometry_msgs::Vector3;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kSpeed = 0.4;                // m/s
constexpr double kWheelSpeed = kSpeed / 0.1;  // rad/s
/// Cycles that may still show the old word.
constexpr int kTwoCycles = 2;
/// The same from a call or a message on: the way through ROS comes before them.
constexpr int kWayAndTwoCycles = 2 + kTwoCycles;
const Seconds kCycle{0.01};

class Stops : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    driveAndMark();
  }
  void driveAndMark() {
    ASSERT_NO_FATAL_FAILURE(enableAndDrive(kSpeed));
    left_from_ = robot().left.status.mark();
    right_from_ = robot().right.status.mark();
  }
  void TearDown() override {
    robot().silence();
    terminals(false, false);
    robot().simulator("right/local_control", false);
    robot().enable(false);
    EXPECT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
    EXPECT_TRUE(robot().waitForRest());
    RobotTest::TearDown();
  }
  /// Inputs of the right drive.
  static void terminals(bool coast, bool quick_stop) {
    SimTerminals service;
    service.request.coast = coast;
    service.request.quick_stop = quick_stop;
    EXPECT_TRUE(callService("nord_sim/right/terminals", service).success);
  }
  Statuses left() const { return robot().left.status.since(left_from_); }
  Statuses right() const { return robot().right.status.since(right_from_); }
  /// Stopped, both drives idle, and so it stays although commands go on.
  void expectRestForGood() {
    EXPECT_TRUE(robot().waitForStandstill());
    EXPECT_FALSE(enableUnderCommand().success) << "the command still stands";
    for (DriveTopics* drive : {&robot().left, &robot().right}) {
      const auto idle = [](const SimDrive& truth) { return truth.control_word == 0x047E && !truth.operation_enabled; };
      ASSERT_TRUE(drive->truth.waitNext(idle));
      const std::size_t from = drive->truth.mark();
      ASSERT_TRUE(eventually([&] { return drive->truth.mark() >= from + 25; }));
      for (const auto& truth : drive->truth.since(from)) ASSERT_TRUE(idle(*truth));
    }
  }
  void expectDrivesAgain() {
    robot().drive(0.0);
    enableAndDrive(0.2);
  }
  /// Stops the base by a service of the driver. `expectStop` counts the cycles before it was heard. Lets it drive
  /// again.
  template <typename Service>
  void stopBy(const std::string& name, Service service, const std::string& said,
              const std::function<void(ros::Time asked, int& cycles)>& expectStop) {
    // Connected before, as any client that means it.
    ros::ServiceClient client = connectTo<Service>("nord_driver/" + name);
    int cycles = 0;
    const auto attempt = [&] {
      const ros::Time asked = ros::Time::now();
      ASSERT_TRUE(client.call(service));
      EXPECT_TRUE(service.response.success) << service.response.message;
      EXPECT_THAT(service.response.message, HasSubstr(said));
      cycles = 0;
      ASSERT_NO_FATAL_FAILURE(expectStop(asked, cycles));
      robot().drive(0.0);
    };
    // What holds up a thread on the way adds to the cycles that are counted.
    tryAgainOnlyIfStoodStill(
        kCycle, attempt, [&] { return cycles <= kWayAndTwoCycles; }, [this] { driveAndMark(); });
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_LE(cycles, kWayAndTwoCycles) << name;
    enableAndDrive(0.2);
  }

  std::size_t left_from_ = 0, right_from_ = 0;
};

/// Something at the right drive that stops the base.
struct Cause {
  std::string name;
  void (*act)();
  void (*take_back)();
  Condition seen;  ///< in the status of the right drive
  std::string said;
};

void PrintTo(const Cause& cause, std::ostream* out) {
  *out << cause.name;
}

class CauseAtADrive : public Stops, public ::testing::WithParamInterface<Cause> {
 public:
  static void trip() { EXPECT_TRUE(robot().trip("right", 21, true).success); }
  static void acknowledge() {
    EXPECT_TRUE(robot().clearCause("right").success);
    EXPECT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
  }
  static void takeOver() { EXPECT_TRUE(robot().simulator("right/local_control", true).success); }
  static void handBack() { EXPECT_TRUE(robot().simulator("right/local_control", false).success); }
  static void coast() { terminals(true, false); }
  static void quickStop() { terminals(false, true); }
  static void release() { terminals(false, false); }
};

// The idle word to that drive at most two cycles later; setpoint 0 to the other one, OFF1 when it is down.
TEST_P(CauseAtADrive, IdlesItAndRunsTheOtherOneDown) {
  const Cause& cause = GetParam();
  cause.act();
  const auto first = robot().right.status.waitFrom(right_from_, cause.seen);
  ASSERT_TRUE(first) << "the cause is not seen";
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_TRUE(robot().left.status.waitFrom(left_from_, [](const DriveStatus& status) {
    return status.control_word == 0x047E && status.ready_to_switch_on && !status.operation_enabled;
  }));

  const ros::Time seen = first->header.stamp;
  const int idled = cyclesUntil(right(), seen, [](const DriveStatus& s) { return s.control_word == 0x047E; });
  EXPECT_GE(idled, 0);
  EXPECT_LE(idled, kTwoCycles);
  const int zero = cyclesUntil(left(), seen, [](const DriveStatus& s) { return s.setpoints.at(0) == 0; });
  EXPECT_GE(zero, 0);
  EXPECT_LE(zero, kTwoCycles);
  bool at_zero = false, off = false;
  for (const auto& status : left()) {
    at_zero = at_zero || status->setpoints.at(0) == 0;
    off = off || status->control_word == 0x047E;
    if (at_zero) {
      EXPECT_EQ(status->setpoints.at(0), 0);
    }
    EXPECT_EQ(status->control_word, off ? 0x047E : 0x047F);
  }
  // Not OFF1 at once: the torque stays until the drive is down.
  const int off1 = cyclesUntil(left(), seen, [](const DriveStatus& s) { return s.control_word == 0x047E; });
  EXPECT_GT(off1, zero);
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("drive right"), HasSubstr(cause.said)));

  ASSERT_NO_FATAL_FAILURE(expectRestForGood());
  cause.take_back();
  ASSERT_NO_FATAL_FAILURE(expectRestForGood());
  expectDrivesAgain();
}

INSTANTIATE_TEST_SUITE_P(
    WhileDriving, CauseAtADrive,
    ::testing::Values(Cause{"Fault", &CauseAtADrive::trip, &CauseAtADrive::acknowledge,
                            [](const DriveStatus& status) { return status.fault != 0; }, "a fault of the inverter"},
                      Cause{"LocalControl", &CauseAtADrive::takeOver, &CauseAtADrive::handBack,
                            [](const DriveStatus& status) { return status.online && !status.bus_control; },
                            "local control"},
                      Cause{"Off2AtTheTerminals", &CauseAtADrive::coast, &CauseAtADrive::release,
                            [](const DriveStatus& status) { return !status.voltage_enabled; },
                            "OFF2 at the inverter's terminals"},
                      Cause{"Off3AtTheTerminals", &CauseAtADrive::quickStop, &CauseAtADrive::release,
                            [](const DriveStatus& status) { return !status.quick_stop_inactive; },
                            "OFF3 at the inverter's terminals"}),
    [](const ::testing::TestParamInfo<Cause>& test) { return test.param.name; });

class QuickStop : public Stops, public ::testing::WithParamInterface<const char*> {};

// OFF3 on all drives of the base, whichever was asked, held until "switch-on disabled" (BU 2700 6.4.1 bit 2).
TEST_P(QuickStop, SaysOff3ToAllDrivesUntilTheyAreDisabled) {
  const auto expectStop = [this](ros::Time asked, int& cycles) {
    ASSERT_TRUE(robot().waitForStandstill());
    ASSERT_NO_FATAL_FAILURE(expectRestForGood());
    for (const Statuses& statuses : {left(), right()}) {
      const int off3 = cyclesUntil(statuses, asked, [](const DriveStatus& s) { return s.control_word == 0x047B; });
      EXPECT_GE(off3, 0);
      cycles = std::max(cycles, off3);
      bool stopping = false, disabled = false;
      for (const auto& status : statuses) {
        stopping = stopping || status->control_word == 0x047B;
        // A state of one cycle can fall between two messages: then the next one is what shows that it was there.
        disabled =
            disabled || (stopping && (status->switch_on_disabled || status->state == DriveStatus::READY_TO_SWITCH_ON));
        if (stopping && !disabled) {
          EXPECT_EQ(status->control_word, 0x047B);
          EXPECT_EQ(status->setpoints.at(0), 0);
        }
      }
      EXPECT_TRUE(disabled);
    }
    EXPECT_THAT(robot().waitForDiagnostics("base", isError), HasSubstr("a quick stop was asked for"));
  };
  stopBy(GetParam(), std_srvs::Trigger{}, "stopped and disabled", expectStop);
}

INSTANTIATE_TEST_SUITE_P(OfTheBase, QuickStop, ::testing::Values("quick_stop", "left/quick_stop"),
                         [](const ::testing::TestParamInfo<const char*>& test) {
                           return std::string(test.param) == "quick_stop" ? "AllDrives" : "OneOfThem";
                         });

// Each of them waits in a thread of the driver until the drives are down; there are more than it has threads.
TEST_F(Stops, AQuickStopDoesNotWaitBehindManyCallsOfEnable) {
  constexpr std::size_t kCalls = 24;
  std::vector<ros::ServiceClient> clients;
  for (std::size_t i = 0; i < kCalls; ++i) clients.push_back(connectTo<std_srvs::SetBool>("nord_driver/enable"));
  ros::ServiceClient quick_stop = connectTo<std_srvs::Trigger>("nord_driver/quick_stop");
  bool turned = false;
  const auto attempt = [&] {
    const double cruising = std::abs(robot().left.status.next()->velocity);
    std::vector<std::thread> callers;
    for (ros::ServiceClient& client : clients) {
      callers.emplace_back([&client] {
        std_srvs::SetBool disable;
        EXPECT_TRUE(client.call(disable));
      });
    }
    const auto slower = robot().left.status.waitFrom(
        left_from_, [&](const DriveStatus& s) { return std::abs(s.velocity) < 0.95 * cruising; });
    EXPECT_TRUE(slower);
    std_srvs::Trigger service;
    EXPECT_TRUE(quick_stop.call(service));
    for (std::thread& caller : callers) caller.join();
    EXPECT_TRUE(robot().waitForStandstill());
    const Statuses statuses = left();
    const auto off3 =
        std::find_if(statuses.begin(), statuses.end(), [](const auto& s) { return s->control_word == 0x047B; });
    turned = off3 != statuses.end() && std::abs((*off3)->velocity) > 0.3 * cruising;
    robot().drive(0.0);
  };
  tryAgainOnlyIfStoodStill(
      kCycle, attempt, [&] { return turned; }, [this] { driveAndMark(); });
  EXPECT_TRUE(turned) << "OFF3 came when the ramp was over, or not at all";
}

// Down the deceleration limit with the drives enabled, then OFF1.
TEST_F(Stops, DisableRampsDownThenSaysOff1) {
  const int cruising = std::abs(int{robot().left.status.next()->setpoints.at(0)});
  const auto expectStop = [&](ros::Time asked, int& cycles) {
    ASSERT_NO_FATAL_FAILURE(expectRestForGood());
    const int slower =
        cyclesUntil(left(), asked, [&](const DriveStatus& s) { return std::abs(int{s.setpoints.at(0)}) < cruising; });
    EXPECT_GE(slower, 0);
    cycles = slower;
    int last = cruising;
    std::size_t steps = 0;
    for (const auto& status : left()) {
      if (status->header.stamp < asked) continue;
      const int setpoint = std::abs(int{status->setpoints.at(0)});
      EXPECT_LE(setpoint, last);
      steps += setpoint < last ? 1 : 0;
      last = setpoint;
      if (setpoint > 0) {
        EXPECT_EQ(status->control_word, 0x047F) << "no OFF1 above zero";
      }
    }
    EXPECT_EQ(last, 0);
    EXPECT_GE(steps, 5u) << "a step, no ramp";
  };
  stopBy("enable", std_srvs::SetBool{}, "", expectStop);  // its data is false
}

// The ramp begins with the time-out, neither before nor later, and the drives stay enabled.
TEST_F(Stops, ACommandThatIsNotRenewedIsBrakedAsSoonAsItIsTooOld) {
  int cycles = 0;
  const auto attempt = [&] {
    const ros::Time last = robot().silence();
    ASSERT_TRUE(robot().waitForStandstill());
    const auto slower = [](const DriveStatus& status) { return status.velocity_command < kWheelSpeed - 0.01; };
    cycles = cyclesUntil(left(), last + ros::Duration(commandTimeout().count()), slower);
    ASSERT_GE(cycles, 0);
    for (const auto& status : left()) {
      EXPECT_EQ(status->control_word, 0x047F);
      if ((status->header.stamp - last).toSec() < 0.99 * commandTimeout().count()) {
        EXPECT_FALSE(slower(*status)) << "the command is still fresh";
      }
    }
  };
  tryAgainOnlyIfStoodStill(
      kCycle, attempt, [&] { return cycles <= kWayAndTwoCycles; }, [this] { driveAndMark(); });
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LE(cycles, kWayAndTwoCycles);
  EXPECT_EQ(robot().left.status.next()->state, DriveStatus::OPERATION_ENABLED);
}

// drive_timeout decides, counted in what the driver lived: a cycle that waits for the silent station twice is longer.
// Two cycles after that the other drive is told.
TEST_F(Stops, ADriveThatFallsSilentStopsTheOtherAfterTheDriveTimeout) {
  constexpr Seconds kTwoSilentCycles{0.25};
  const ros::Time before = ros::Time::now();
  ASSERT_TRUE(robot().simulator("right/unplug", true).success);
  const LivedTime since{robot().right};
  const auto offline = robot().right.status.waitFrom(right_from_, [](const DriveStatus& s) { return !s.online; });
  ASSERT_TRUE(offline);
  EXPECT_LE(since.ofDriver(*offline), driveTimeout() + kTwoSilentCycles);
  EXPECT_GT((offline->header.stamp - before).toSec(), bus().shortest_silence * driveTimeout().count());
  ASSERT_TRUE(robot().waitForStandstill());
  const int zero =
      cyclesUntil(left(), offline->header.stamp, [](const DriveStatus& s) { return s.setpoints.at(0) == 0; });
  EXPECT_GE(zero, 0);
  EXPECT_LE(zero, kTwoCycles);
  EXPECT_TRUE(robot().left.truth.waitNext(
      [](const SimDrive& truth) { return truth.control_word == 0x047E && !truth.operation_enabled; }));

  ASSERT_TRUE(robot().simulator("right/unplug", false).success);
  ASSERT_TRUE(robot().waitForDrivesOnline());
  ASSERT_NO_FATAL_FAILURE(expectRestForGood());
  expectDrivesAgain();
}

struct BadCommand {
  std::string name;
  Twist twist;
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// 0.2 m/s forward, with one value spoilt.
BadCommand spoilt(const std::string& name, Vector3 Twist::*part, double Vector3::*axis, double value) {
  BadCommand command{name, {}};
  command.twist.linear.x = 0.2;
  command.twist.*part.*axis = value;
  return command;
}

class NotANumber : public Stops, public ::testing::WithParamInterface<BadCommand> {};

// No command at all: the one before stands until its time-out, then the base ramps down and stays enabled.
TEST_P(NotANumber, IsIgnoredAndCountedWhileTheTimeoutRuns) {
  ros::NodeHandle handle;
  Topic<rosgraph_msgs::Log> rosout(handle, "/rosout");
  const ros::Time last_good = robot().command(GetParam().twist);
  ASSERT_TRUE(robot().waitForStandstill());
  EXPECT_EQ(robot().left.status.next()->state, DriveStatus::OPERATION_ENABLED);
  EXPECT_EQ(robot().right.status.next()->state, DriveStatus::OPERATION_ENABLED);

  const ros::Duration followed(0.99 * commandTimeout().count());
  int while_fresh = 0;
  for (const auto& status : left()) {
    ASSERT_TRUE(std::isfinite(status->velocity_command));
    EXPECT_EQ(status->control_word, 0x047F);
    EXPECT_LE(std::fabs(status->velocity_command), 1.001 * kWheelSpeed);
    if (status->header.stamp < last_good || status->header.stamp > last_good + followed) continue;
    ++while_fresh;
    EXPECT_NEAR(status->velocity_command, kWheelSpeed, 0.01) << "the command before is still fresh";
  }
  EXPECT_GT(while_fresh, 5);
  EXPECT_TRUE(rosout.waitFrom(0, [](const rosgraph_msgs::Log& log) {
    return log.name == "/nord_driver" && log.msg.find("ignored (") != std::string::npos;
  })) << "not counted";
  EXPECT_TRUE(robot().diagnostics.waitNext([](const diagnostic_msgs::DiagnosticArray& array) {
    for (const auto& status : array.status) {
      for (const auto& value : status.values) {
        if (status.name == "nord_driver: base" && value.key == "commands ignored")
          return std::atoi(value.value.c_str()) > 0;
      }
    }
    return false;
  })) << "not in the diagnostics";
  robot().drive(0.2);
  EXPECT_TRUE(robot().waitForTrueSpeed(0.18)) << "a good command is followed again";
}

INSTANTIATE_TEST_SUITE_P(InACommand, NotANumber,
                         ::testing::Values(spoilt("LinearNan", &Twist::linear, &Vector3::x, kNan),
                                           spoilt("AngularInfinite", &Twist::angular, &Vector3::z, kInfinite),
                                           // Not used by this base; but whose rest is broken means nothing.
                                           spoilt("SidewaysNan", &Twist::linear, &Vector3::y, kNan),
                                           spoilt("RollInfinite", &Twist::angular, &Vector3::x, -kInfinite)),
                         [](const ::testing::TestParamInfo<BadCommand>& test) { return test.param.name; });

}  // namespace
}  // namespace nord_driver::test

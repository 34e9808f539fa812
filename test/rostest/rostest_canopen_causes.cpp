// What only CANopen has: how a node is lost, what an emergency says, and how SDOs fare while the robot drives.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <future>

#include "nord_driver/SimAnswerDelay.h"
#include "nord_driver/SimParameterChannel.h"
#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Seconds kBackOnline{
    2.0};  // found again, reset, set up and started; an SDO without an answer ends before that
constexpr std::uint16_t kRamp = 102;
constexpr std::uint16_t kMasterLost = 100;  // E10.0 as P700 shows it
constexpr std::uint16_t kOvercurrent = 30;  // E3.0
constexpr double kSpeed = 0.3;              // m/s

class CanopenCauses : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    enableAndDrive(kSpeed);
  }
  void TearDown() override {
    robot().silence();
    for (const char* drive : {"left", "right"}) {
      EXPECT_TRUE(robot().simulator(std::string(drive) + "/mute", false).success);
      EXPECT_TRUE(robot().clearCause(drive).success);
      parameterChannel(drive, {});
      delayParameters(drive, 1);
    }
    EXPECT_TRUE(robot().waitForDrivesOnline());
    EXPECT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
    EXPECT_TRUE(eventually([] { return robot().enable(false).success; }));
    EXPECT_TRUE(robot().waitForRest());
    RobotTest::TearDown();
  }

  static void parameterChannel(const std::string& drive, const SimParameterChannel::Request& request) {
    SimParameterChannel service;
    service.request = request;
    EXPECT_TRUE(callService("nord_sim/" + drive + "/parameter_channel", service).success);
  }
  static void delayParameters(const std::string& drive, std::uint16_t milliseconds) {
    SimAnswerDelay service;
    service.request.parameter_cycles = milliseconds;
    EXPECT_TRUE(callService("nord_sim/" + drive + "/answer_delay", service).success);
  }
  /// The answers of `drive` are lost: it is named with `what` was lost, and both wheels come to rest.
  void loseAndExpectStop(const std::string& drive, DriveTopics& topics, const std::string& what) {
    ASSERT_TRUE(robot().simulator(drive + "/mute", true).success);
    EXPECT_TRUE(topics.status.waitNext([](const DriveStatus& status) { return !status.online; }));
    EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("drive " + drive), HasSubstr("silent")));
    const auto told = robot().bus_status.waitNext([&](const BusStatus& status) {
      return status.offline == std::vector<std::string>{drive} && status.text.find(what) != std::string::npos;
    });
    ASSERT_TRUE(told) << "nobody says: " << what;
    EXPECT_THAT(told->text, HasSubstr("drive " + drive));
    EXPECT_THAT(robot().waitForDiagnostics("drive " + drive, isError), HasSubstr(what));
    EXPECT_TRUE(robot().waitForStandstill());
  }
  static Seconds sdoTimeout(const std::string& drive) {
    double timeout = 0.0;
    const std::string own = "nord_driver/drives/" + drive + "/sdo_timeout";
    EXPECT_TRUE(ros::param::get(own, timeout) || ros::param::get("nord_driver/bus/sdo_timeout", timeout));
    return Seconds{timeout};
  }
  /// Commands go on and do not move it.
  void expectLatched(const std::string& drive, DriveTopics& topics) {
    ASSERT_TRUE(robot().simulator(drive + "/mute", false).success);
    EXPECT_TRUE(topics.status.waitNext([](const DriveStatus& status) { return status.online != 0; },
                                       sdoTimeout(drive) + kBackOnline));
    for (DriveTopics* side : {&robot().left, &robot().right}) {
      EXPECT_FALSE(
          side->truth.waitNext([](const SimDrive& truth) { return truth.operation_enabled != 0; }, Seconds{0.5}));
    }
    EXPECT_THAT(robot().waitForDiagnostics("base", isError), HasSubstr("drive " + drive + " stopped"));
    robot().drive(0.0);
  }
  void expectBothStayed() {
    EXPECT_TRUE(robot().left.truth.next()->operation_enabled);
    EXPECT_TRUE(robot().right.truth.next()->operation_enabled);
    EXPECT_TRUE(robot().waitForTrueSpeed(0.9 * kSpeed));
  }
};

// The node sends its heartbeat by itself; nobody tells it that we are gone, so it has no fault afterwards.
TEST_F(CanopenCauses, AHeartbeatThatStopsStopsTheBase) {
  ASSERT_NO_FATAL_FAILURE(loseAndExpectStop("left", robot().left, "sent no heartbeat for 900 ms"));
  EXPECT_TRUE(robot().right.truth.waitNext(
      [](const SimDrive& truth) { return !truth.operation_enabled && isReadyToSwitchOn(truth.status_word); }));
  EXPECT_TRUE(robot().right.status.next()->online);
  const Answer refused = robot().enable(true);
  EXPECT_FALSE(refused.success);
  ASSERT_NO_FATAL_FAILURE(expectLatched("left", robot().left));
  EXPECT_TRUE(robot().waitForRest());
  enableAndDrive(kSpeed);
}

// Of a node that is not heard any more nobody asks the state: its own guarding ends, too, and the inverter trips E10.0.
TEST_F(CanopenCauses, AGuardedNodeThatDoesNotAnswerStopsTheBase) {
  const std::size_t from = robot().right.truth.mark();
  ASSERT_NO_FATAL_FAILURE(loseAndExpectStop("right", robot().right, "gave no good answer to guarding for 1200 ms"));
  EXPECT_TRUE(robot().left.truth.waitNext(
      [](const SimDrive& truth) { return !truth.operation_enabled && isReadyToSwitchOn(truth.status_word); }));
  EXPECT_TRUE(robot().right.truth.waitFrom(
      from, [](const SimDrive& truth) { return truth.fault_number == kMasterLost && !truth.operation_enabled; }));
  ASSERT_NO_FATAL_FAILURE(expectLatched("right", robot().right));
  EXPECT_THAT(refusalOfEnable(), AllOf(HasSubstr("drive right"), HasSubstr("fault")));
  const Answer answer = robot().trigger("acknowledge_faults");
  EXPECT_TRUE(answer.success) << answer;
  enableAndDrive(kSpeed);
}

// The emergency names a group of faults at once (BU 0060 p. 93: 2310h is E3.0 ..), P700 the one it is.
TEST_F(CanopenCauses, AnEmergencyIsToldAndP700SaysWhichFaultItIs) {
  const std::size_t from = robot().left.status.mark();
  ASSERT_TRUE(robot().trip("left", kOvercurrent, true).success);
  const auto told = robot().bus_status.waitNext(
      [](const BusStatus& status) { return status.text.find("EMCY") != std::string::npos; });
  ASSERT_TRUE(told);
  EXPECT_EQ(told->text, "drive left reports EMCY 2310h (E3.0, overcurrent at the output (I2t limit))");
  EXPECT_THAT(told->online, ElementsAre("left", "right"));
  const auto named = robot().left.status.waitFrom(from, [](const DriveStatus& status) {
    return status.state == DriveStatus::FAULT && status.fault_number == kOvercurrent;
  });
  ASSERT_TRUE(named);
  EXPECT_NE(named->fault_text, "");
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_FALSE(robot().right.truth.next()->operation_enabled);
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("drive left"), HasSubstr("a fault")));

  // Its end is an emergency, too (code 0000h).
  ASSERT_TRUE(robot().clearCause("left").success);
  robot().drive(0.0);
  const Answer acknowledged = robot().trigger("left/acknowledge_fault");
  EXPECT_TRUE(acknowledged.success) << acknowledged;
  EXPECT_TRUE(robot().bus_status.waitNext([](const BusStatus& status) { return status.text == "all drives answer"; }));
  enableAndDrive(kSpeed);
}

// 0602 0000h, no such object, and 0800 0020h, chosen at the simulator: the answer is there at once, and nothing stops.
TEST_F(CanopenCauses, AnSdoThatIsAbortedIsRefusedInWords) {
  Answer answer = robot().readParameter("left", 999);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("drive left refuses P999"), HasSubstr("SDO abort 0602 0000h")));
  SimParameterChannel::Request refuse;
  refuse.refuse = true;
  refuse.error = 101;
  refuse.number = kRamp;
  parameterChannel("left", refuse);
  answer = robot().readParameter("left", kRamp);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message,
              AllOf(HasSubstr("drive left refuses P102"), HasSubstr("the device cannot take or give the value")));
  parameterChannel("left", {});
  answer = robot().readParameter("left", kRamp);
  EXPECT_TRUE(answer.success) << answer;
  expectBothStayed();
}

// No answer at all ends with the time-out of the SDO (3 s here), counted; the other drive's parameters do not wait.
TEST_F(CanopenCauses, AnSdoServerThatIsSilentStopsNothing) {
  const std::uint64_t before = robot().bus_status.next()->timeouts;
  SimParameterChannel::Request silent;
  silent.silent = true;
  parameterChannel("left", silent);
  auto pending = std::async(std::launch::async, [] { return robot().readParameter("left", kRamp); });
  const Answer other = robot().readParameter("right", kRamp);
  EXPECT_TRUE(other.success) << other;
  EXPECT_EQ(pending.wait_for(Seconds{0.0}), std::future_status::timeout);
  const Answer answer = pending.get();
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("drive left gave no answer for P102"));
  EXPECT_TRUE(robot().bus_status.waitNext([&](const BusStatus& status) { return status.timeouts > before; }));
  parameterChannel("left", {});
  expectBothStayed();
}

/// Cycles around a parameter that is on its way for two seconds.
class SlowSdo : public CanopenCauses {
 protected:
  static constexpr Seconds kDelay{2.0};

  /// A new speed reaches the drives long before the parameter. The longest cycle of two whole seconds of statistics
  /// after the question.
  void askAndDrive(double speed, double& longest_cycle) {
    const std::size_t bus_from = robot().bus_status.mark();
    const std::size_t truth_from = robot().left.truth.mark();
    const auto asked = std::chrono::steady_clock::now();
    auto pending = std::async(std::launch::async, [] {
      const Answer answer = robot().readParameter("left", kRamp);
      return std::make_pair(answer, std::chrono::steady_clock::now());
    });
    const int before = robot().left.truth.next()->setpoint_1;
    robot().drive(speed);
    EXPECT_TRUE(robot().left.truth.waitFrom(
        truth_from, [&](const SimDrive& truth) { return std::abs(truth.setpoint_1 - before) > before / 5; }));
    EXPECT_EQ(pending.wait_for(Seconds{0.0}), std::future_status::timeout) << "the command waited for the parameter";
    const auto [answer, at] = pending.get();
    EXPECT_TRUE(answer.success) << answer;
    EXPECT_GE(at - asked, kDelay);

    ASSERT_TRUE(eventually([&] { return robot().bus_status.mark() >= bus_from + 3; }));
    const auto seconds = robot().bus_status.since(bus_from);
    longest_cycle = 0.0;
    for (const auto& second : seconds) {
      longest_cycle = std::max(longest_cycle, second->cycle_time_max);
      EXPECT_THAT(second->offline, ::testing::IsEmpty());
    }
    EXPECT_GT(seconds.back()->cycles, seconds.front()->cycles + 50);
  }
};

// Not by five cycles: one that waited would be as long as the delay.
TEST_F(SlowSdo, DelaysNoCycle) {
  const double longest_allowed = 0.05 * timeFactor();  // s
  delayParameters("left", 2000);
  double longest = 0.0, speed = 2.0 * kSpeed;
  const auto attempt = [&] { askAndDrive(speed, longest); };
  tryAgainOnlyIfStoodStill(
      Seconds{0.5 * longest_allowed}, attempt, [&] { return longest < longest_allowed; },
      [&] { speed = 3.0 * kSpeed - speed; });
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(longest, longest_allowed);
  expectBothStayed();
}

}  // namespace
}  // namespace nord_driver::test

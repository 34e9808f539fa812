// Faults as a user meets them: what stops, what is said, and what it takes to move again.
#include <gmock/gmock.h>
#include <rosgraph_msgs/Log.h>

#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::uint16_t kMotorHot = 21;    // E2.1 as P700 shows it
constexpr std::size_t kLongEnough = 25;    // messages in which a drive that wanted to move would have
constexpr Seconds kAcknowledged{5.0};      // the longest answer: service_timeout of robot.yaml
constexpr Seconds kLateForReaction{0.01};  // what holds the simulator up that long may spoil its 5 ms of fault reaction
const Seconds kVanished{1.0 * timeFactor()};

class Faults : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    enableAndDrive(0.4);
  }
  void TearDown() override {
    robot().silence();
    for (const char* drive : {"left", "right"}) EXPECT_TRUE(robot().clearCause(drive).success);
    robot().enable(false);
    EXPECT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
    EXPECT_TRUE(robot().waitForRest());
    RobotTest::TearDown();
  }
  /// A value of the task "drive left" of /diagnostics; empty when it never comes.
  std::string diagnosticsOfLeft(const std::string& key) {
    std::string value;
    robot().diagnostics.waitNext([&](const diagnostic_msgs::DiagnosticArray& array) {
      for (const auto& status : array.status) {
        if (status.name != "nord_driver: drive left") continue;
        for (const auto& pair : status.values) {
          if (pair.key == key) value = pair.value;
        }
      }
      return !value.empty();
    });
    return value;
  }
  /// Both drives have no voltage, for a while.
  void expectDisabled() {
    for (DriveTopics* drive : {&robot().left, &robot().right}) {
      const std::size_t from = drive->truth.mark();
      ASSERT_TRUE(eventually([&] { return drive->truth.mark() >= from + kLongEnough; }));
      for (const auto& truth : drive->truth.since(from)) ASSERT_FALSE(truth->operation_enabled);
    }
  }
};

// The whole way: stopped, named with cause and remedy, not to be acknowledged while the cause stands, acknowledged
// without moving, moving again by ~enable only.
TEST_F(Faults, AFaultStopsTheBaseAndIsAcknowledgedOnceItsCauseIsGone) {
  const std::size_t from = robot().left.status.mark();
  ASSERT_TRUE(robot().trip("left", kMotorHot, true).success);

  const auto faulty = robot().left.status.waitFrom(from, [](const DriveStatus& status) {
    return status.state == DriveStatus::FAULT && status.fault_number == kMotorHot;
  });
  ASSERT_TRUE(faulty);
  EXPECT_TRUE(faulty->fault);
  EXPECT_EQ(faulty->fault_text, "motor overtemperature (I2t)");
  EXPECT_EQ(faulty->control_word, 0x047E) << "the idle word";
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_TRUE(robot().right.truth.waitNext([](const SimDrive& truth) {
    return !truth.operation_enabled && isReadyToSwitchOn(truth.status_word) && truth.control_word == 0x047E;
  }));
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("drive left"), HasSubstr("a fault")));
  EXPECT_THAT(robot().waitForDiagnostics("drive left", isError), HasSubstr("E2.1: motor overtemperature (I2t)"));
  EXPECT_THAT(diagnosticsOfLeft("fault"), HasSubstr("E2.1"));
  EXPECT_THAT(diagnosticsOfLeft("likely cause"), HasSubstr("motor"));
  EXPECT_NE(diagnosticsOfLeft("remedy"), "");

  robot().drive(0.0);
  EXPECT_THAT(refusalOfEnable(), AllOf(HasSubstr("drive left"), HasSubstr("reports a fault")));

  for (const char* service : {"acknowledge_faults", "left/acknowledge_fault"}) {
    const auto asked = std::chrono::steady_clock::now();
    const Answer answer = robot().trigger(service);
    EXPECT_FALSE(answer.success) << service;
    EXPECT_THAT(answer.message, AllOf(HasSubstr("drive left"), HasSubstr("the cause of the fault still stands"),
                                      HasSubstr("drive left: E2.1, motor overtemperature (I2t); remedy: ")));
    EXPECT_LT(std::chrono::steady_clock::now() - asked, kAcknowledged);
    EXPECT_EQ(robot().left.truth.next()->fault_number, kMotorHot);
  }

  ASSERT_TRUE(robot().clearCause("left").success);
  const Answer answer = robot().trigger("acknowledge_faults");
  EXPECT_TRUE(answer.success) << answer;
  EXPECT_EQ(robot().left.truth.next()->fault_number, 0);
  const auto healthy = robot().left.status.waitNext(
      [](const DriveStatus& status) { return !status.fault && status.control_word == 0x047E; });
  ASSERT_TRUE(healthy) << "the acknowledge bit stands";
  EXPECT_EQ(healthy->fault_number, 0);
  EXPECT_EQ(healthy->fault_text, "");
  expectDisabled();

  enableAndDrive(0.3);
}

// Dropping the enable acknowledges in the inverter (BU 0020 8): without a standing cause the driver's own idle word
// lets the fault vanish. It is kept until the user has acknowledged it.
TEST_F(Faults, AFaultThatVanishesByItselfStaysLatched) {
  bool vanished = false;
  const auto attempt = [&] {
    const std::size_t from = robot().left.status.mark();
    ASSERT_TRUE(robot().trip("left", kMotorHot, false).success);
    ASSERT_TRUE(robot().left.status.waitFrom(from, [](const DriveStatus& status) { return status.fault != 0; }));
    const auto none = [](const SimDrive& truth) { return truth.fault_number == 0; };
    vanished = robot().left.truth.waitNext(none, kVanished) != nullptr;
  };
  const auto driveAgain = [this] {
    ASSERT_TRUE(robot().trigger("acknowledge_faults").success);
    enableAndDrive(0.4);
  };
  // A simulator that was held up takes the idle word before its "fault reaction active" is over: it ends nothing then.
  tryAgainOnlyIfStoodStill(
      kLateForReaction, attempt, [&] { return vanished; }, driveAgain);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_TRUE(vanished) << "in truth, by the idle word";
  EXPECT_TRUE(robot().waitForStandstill());
  robot().drive(0.0);
  ASSERT_TRUE(robot().waitForRest());

  EXPECT_THAT(refusalOfEnable(), AllOf(HasSubstr("drive left"), HasSubstr("has not been acknowledged")));
  EXPECT_THAT(robot().waitForDiagnostics("drive left", isError), HasSubstr("a fault of the inverter"));
  EXPECT_EQ(diagnosticsOfLeft("fault latched"), "True");
  EXPECT_NE(diagnosticsOfLeft("last fault"), "");
  expectDisabled();

  const Answer answer = robot().trigger("left/acknowledge_fault");
  EXPECT_TRUE(answer.success) << answer;
  expectDisabled();
  enableAndDrive(0.3);
}

// Nobody saw the fault bit fall: the drive was off. It is latched all the same, and told no longer.
TEST_F(Faults, AFaultThatMainsOffAndOnTookAwayIsNoErrorAnyMore) {
  ASSERT_TRUE(robot().trip("left", kMotorHot, true).success);
  ASSERT_TRUE(robot().left.status.waitNext([](const DriveStatus& status) { return status.fault_number == kMotorHot; }));
  EXPECT_TRUE(robot().waitForStandstill());
  robot().drive(0.0);
  ASSERT_TRUE(robot().simulator("left/unplug", true).success);
  const auto gone = robot().left.status.waitNext([](const DriveStatus& status) { return status.online == 0; });
  ASSERT_TRUE(gone);
  EXPECT_EQ(gone->fault_number, kMotorHot) << "the last one";
  EXPECT_FALSE(gone->fault || gone->ready_to_switch_on || gone->operation_enabled || gone->bus_control);
  ASSERT_TRUE(robot().clearCause("left").success);
  ASSERT_TRUE(robot().simulator("left/unplug", false).success);
  EXPECT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& status) { return status.online != 0 && status.fault_number == 0; }));
  EXPECT_THAT(refusalOfEnable(), HasSubstr("has not been acknowledged"));
  const Answer answer = robot().trigger("acknowledge_faults");
  EXPECT_TRUE(answer.success) << answer;
  enableAndDrive(0.3);
  EXPECT_EQ(robot().left.status.next()->fault_number, 0) << "while it drives";
  const auto no_error = [](int level, const std::string& message) { return !isError(level, message); };
  EXPECT_NE(robot().waitForDiagnostics("drive left", no_error), "");
}

// Who has the log only: what happened, why, which calls come next, and who has called them.
TEST_F(Faults, TheLogLeadsFromTheFaultToTheNextMotion) {
  using rosgraph_msgs::Log;
  ros::NodeHandle node;
  Topic<Log> log(node, "/rosout");
  const auto isSaid = [&](std::uint8_t level, const std::string& text) {
    for (const auto& line : log.since(0)) {
      if (line->name == "/nord_driver" && line->level == level && line->msg.find(text) != std::string::npos)
        return true;
    }
    return false;
  };
  ASSERT_TRUE(eventually([&] {  // from then on nothing is missed
    robot().trigger("acknowledge_faults");
    return isSaid(Log::INFO, "~acknowledge_faults: no fault stood, and nothing was done");
  }));
  ASSERT_TRUE(robot().trip("left", kMotorHot, true).success);
  ASSERT_TRUE(
      eventually([&] { return isSaid(Log::ERROR, "drive left: E2.1, motor overtemperature (I2t); likely cause: "); }));
  EXPECT_TRUE(isSaid(Log::ERROR, "; remedy: let it cool down"));
  EXPECT_TRUE(isSaid(Log::ERROR,
                     "rosservice call /nord_driver/acknowledge_faults and enable: rosservice call "
                     "/nord_driver/enable true"));
  robot().drive(0.0);
  EXPECT_THAT(refusalOfEnable(), HasSubstr("~acknowledge_faults"));
  EXPECT_TRUE(eventually([&] { return isSaid(Log::WARN, "~enable true is refused, or failed: drive left: "); }));
  ASSERT_TRUE(robot().clearCause("left").success);
  ASSERT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
  enableAndDrive(0.3);
  ASSERT_TRUE(robot().trigger("quick_stop").success);
  EXPECT_TRUE(eventually([&] { return isSaid(Log::INFO, "~quick_stop: stopped and disabled"); }));
  EXPECT_TRUE(isSaid(Log::INFO, "~enable true: enabled"));
  EXPECT_TRUE(eventually([&] { return isSaid(Log::INFO, "a quick stop was asked for"); }));
  EXPECT_FALSE(isSaid(Log::ERROR, "a quick stop was asked for"));
}

// Nothing to acknowledge is no failure, and does not disturb a robot that drives.
TEST_F(Faults, AcknowledgingWithoutAFaultSucceedsAndStopsNothing) {
  const std::size_t from = robot().left.truth.mark();
  const Answer answer = robot().trigger("acknowledge_faults");
  EXPECT_TRUE(answer.success) << answer;
  ASSERT_TRUE(eventually([&] { return robot().left.truth.mark() >= from + kLongEnough; }));
  for (const auto& truth : robot().left.truth.since(from)) {
    EXPECT_TRUE(truth->operation_enabled);
    EXPECT_EQ(truth->control_word, 0x047F);
  }
}

}  // namespace
}  // namespace nord_driver::test

// Four inverters behind one module, and one of them is not there.
#include <gmock/gmock.h>

#include "rostest/lived_time.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr Seconds kBackOnline{2.0};  // the inverter charges for 0.3 s
constexpr const char* kMissing = "rear_right";

class Gateway : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    power(true);
  }
  void TearDown() override {
    power(true);
    endDriver();
    RobotTest::TearDown();
  }
  static void power(bool on) { EXPECT_TRUE(robot().simulator(std::string(kMissing) + "/power_inverter", on).success); }
  /// Named where a technician looks, and the other three with fresh process data.
  void expectThreeOfFour() {
    const auto status = robot().bus_status.waitNext([](const BusStatus& bus) {
      return bus.offline == std::vector<std::string>{kMissing} && bus.online.size() == 3;
    });
    ASSERT_TRUE(status);
    EXPECT_THAT(status->online, UnorderedElementsAre("left", "right", "rear_left"));
    EXPECT_THAT(status->text, HasSubstr("drive rear_right"));
    EXPECT_THAT(robot().waitForDiagnostics("drive rear_right", isError), HasSubstr("mains"));
    EXPECT_TRUE(status->connected);
    const Answer parameter = robot().readParameter("rear_left", 102);
    EXPECT_TRUE(parameter.success) << parameter;
    EXPECT_FALSE(robot().readParameter(kMissing, 102).success);
  }
  void waitForAllFour() {
    const LivedTime since{rear_right_};
    const auto back = rear_right_.status.waitNext([](const DriveStatus& status) { return status.online != 0; });
    ASSERT_TRUE(back);
    EXPECT_LT(since.ofBoth(*back), kBackOnline);
    EXPECT_TRUE(robot().bus_status.waitNext([](const BusStatus& bus) { return bus.online.size() == 4; }));
  }
  void expectAllTurn() {
    for (DriveTopics* drive : {&robot().left, &robot().right, &rear_left_, &rear_right_}) {
      EXPECT_TRUE(drive->truth.waitNext([](const SimDrive& truth) { return truth.wheel_velocity > 2.7; }));
    }
  }

  ros::NodeHandle node_;
  DriveTopics rear_left_{node_, "rear_left"};
  DriveTopics rear_right_{node_, kMissing};
};

TEST_F(Gateway, AnInverterMissingFromTheStartIsNamedAndKeepsTheBaseFromMoving) {
  power(false);
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_NO_FATAL_FAILURE(expectThreeOfFour());
  const Answer refused = robot().enable(true);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, AllOf(HasSubstr("drive rear_right"), HasSubstr("does not answer")));
  for (DriveTopics* drive : {&robot().left, &robot().right, &rear_left_}) {
    EXPECT_FALSE(drive->truth.next()->operation_enabled);
  }
  power(true);
  ASSERT_NO_FATAL_FAILURE(waitForAllFour());
  enableAndDrive(0.3);
  expectAllTurn();
}

TEST_F(Gateway, AnInverterThatGoesOffStopsTheOtherThreeUntilTheyAreEnabledAgain) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_NO_FATAL_FAILURE(waitForAllFour());
  enableAndDrive(0.3);
  expectAllTurn();

  power(false);
  ASSERT_NO_FATAL_FAILURE(expectThreeOfFour());
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), AllOf(HasSubstr("drive rear_right"), HasSubstr("stopped")));
  for (DriveTopics* drive : {&robot().left, &robot().right, &rear_left_}) {
    EXPECT_TRUE(drive->truth.waitNext([](const SimDrive& truth) {
      return !truth.operation_enabled && isReadyToSwitchOn(truth.status_word) && truth.control_word == 0x047E;
    }));
  }
  EXPECT_TRUE(robot().waitForStandstill());

  // Back, with the command still standing: nothing moves.
  power(true);
  ASSERT_NO_FATAL_FAILURE(waitForAllFour());
  EXPECT_FALSE(
      robot().left.truth.waitNext([](const SimDrive& truth) { return truth.operation_enabled != 0; }, Seconds{0.5}));
  EXPECT_FALSE(rear_right_.truth.next()->operation_enabled);
  robot().drive(0.0);
  enableAndDrive(0.3);
  expectAllTurn();
}

}  // namespace
}  // namespace nord_driver::test

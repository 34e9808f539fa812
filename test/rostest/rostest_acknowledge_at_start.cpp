// auto_enable across restarts: a clean exit leaves E10.2 in the drives, and acknowledge_at_start takes it away.
#include <gmock/gmock.h>

#include <cmath>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr std::uint16_t kMasterLost = 102, kMotorHot = 21;
const std::size_t kStatusMessages = 150;  // 3 s of the driver's life

bool isEnabled(const DriveStatus& status) {
  return status.state == DriveStatus::OPERATION_ENABLED;
}

class AcknowledgeAtStart : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_NO_FATAL_FAILURE(switchDrivesOffAndOn());
  }
  void TearDown() override {
    if (driver_) endDriver();
    RobotTest::TearDown();
  }
  /// The driver runs and ends; its drives miss it.
  void leaveTimeOuts() {
    ASSERT_NO_FATAL_FAILURE(startDriver());
    ASSERT_TRUE(robot().left.status.waitNext(isEnabled));
    const std::size_t left = robot().left.truth.mark(), right = robot().right.truth.mark();
    endDriver();
    driver_.reset();
    const auto missed = [](const SimDrive& truth) { return truth.fault_number == kMasterLost; };
    ASSERT_TRUE(robot().left.truth.waitFrom(left, missed));
    ASSERT_TRUE(robot().right.truth.waitFrom(right, missed));
  }
};

TEST_F(AcknowledgeAtStart, ANodeThatIsStartedAgainEnables) {
  ASSERT_NO_FATAL_FAILURE(leaveTimeOuts());
  const std::size_t odom = robot().true_odom.mark();
  ASSERT_NO_FATAL_FAILURE(startDriver());
  EXPECT_TRUE(robot().left.status.waitNext(isEnabled));
  EXPECT_TRUE(robot().right.status.waitNext(isEnabled));
  for (const auto& truth : robot().true_odom.since(odom)) {
    ASSERT_LT(std::fabs(truth->twist.twist.linear.x), 1e-3) << "nothing moves by that";
  }
  robot().drive(0.2);
  EXPECT_TRUE(robot().waitForTrueSpeed(0.18));
  robot().drive(0.0);
  EXPECT_TRUE(robot().waitForStandstill());
  EXPECT_THAT(driver_->errorText(), ::testing::Not(HasSubstr("is not acknowledged")));
}

TEST_F(AcknowledgeAtStart, AnotherFaultStaysAndNothingIsEnabled) {
  ASSERT_TRUE(robot().trip("left", kMotorHot, false).success);
  const std::size_t left = robot().left.status.mark(), right = robot().right.status.mark();
  ASSERT_NO_FATAL_FAILURE(startDriver());
  EXPECT_TRUE(
      robot().left.status.waitFrom(left, [](const DriveStatus& status) { return status.fault_number == kMotorHot; }));
  EXPECT_TRUE(eventually([&] { return robot().left.status.mark() >= left + kStatusMessages; }));
  for (const auto& status : robot().right.status.since(right)) ASSERT_FALSE(isEnabled(*status));
  EXPECT_EQ(robot().left.truth.next()->fault_number, kMotorHot);
  EXPECT_THAT(refusalOfEnable(), HasSubstr("drive left: the inverter reports a fault"));
}

}  // namespace
}  // namespace nord_driver::test

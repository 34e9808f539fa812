// What only a drive in an InterBus ring behind a gateway meets: a ring that stands, and no parameters. That the
// gateway outlives this computer is in rostest_killed and rostest_clean_exit.
#include <gmock/gmock.h>
#include <nord_driver/DeviceInfo.h>

#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using InterbusRing = RobotTest;

// The 24 V of one technology unit: the whole ring stands, so both drives are gone, and the base stops for good.
TEST_F(InterbusRing, ThatStandsStopsTheBaseUntilItIsEnabledAgain) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
  ASSERT_TRUE(robot().simulator("left/power_module", false).success);
  EXPECT_TRUE(robot().right.status.waitNext([](const DriveStatus& status) { return !status.online; }));
  EXPECT_THAT(robot().waitForDiagnostics("base", isError), HasSubstr("without being asked"));
  const auto stands = [](const BusStatus& status) {
    return status.text.find("ring does not run") != std::string::npos;
  };
  EXPECT_TRUE(robot().bus_status.waitNext(stands));
  EXPECT_TRUE(robot().waitForStandstill()) << "the inverters' own P513";
  robot().drive(0.0);
  ASSERT_TRUE(robot().simulator("left/power_module", true).success);
  ASSERT_TRUE(robot().waitForDrivesOnline());
  EXPECT_FALSE(robot().right.truth.next()->operation_enabled);
  EXPECT_TRUE(eventually([] { return robot().trigger("acknowledge_faults").success; }));
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.2));
}

TEST_F(InterbusRing, CarriesNoParameters) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ASSERT_TRUE(robot().waitForDrivesOnline());
  const Answer answer = robot().readParameter("left", 102);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("no parameter channel reaches P102 of drive left"),
                                    HasSubstr("its gateway carries process data only")));
  ros::NodeHandle node;
  Topic<DeviceInfo> topic(node, "nord_driver/left/device_info");
  const auto info = topic.waitFrom(0, [](const DeviceInfo&) { return true; });
  ASSERT_TRUE(info);
  EXPECT_EQ("none", info->parameter_channel);
  EXPECT_THAT(info->protected_by, HasSubstr("watchdog of the gateway (register 300 = 1000)"));
}

}  // namespace
}  // namespace nord_driver::test

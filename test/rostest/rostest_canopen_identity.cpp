// Another device answers under the node id of a drive: it is never started.
#include <gmock/gmock.h>
#include <signal.h>

#include "nord_driver/DeviceInfo.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kVendorKey = "nord_driver/drives/right/vendor_id";
constexpr int kWrongVendor = 0x99;
constexpr int kSimulatedVendor = 0x4E;

class CanopenIdentity : public RobotTest {
 protected:
  void TearDown() override {
    ros::param::del(kVendorKey);
    endDriver();
    RobotTest::TearDown();
  }
};

TEST_F(CanopenIdentity, AWrongDeviceIsNamedAndNeverStarted) {
  ros::param::set(kVendorKey, kWrongVendor);
  driver_ = std::make_unique<NodeProcess>(kDriverProgram, std::vector<std::string>{"__name:=nord_driver"});
  const std::size_t from = robot().right.truth.mark();
  const auto left_only = robot().bus_status.waitNext(
      [](const BusStatus& status) { return status.online == std::vector<std::string>{"left"}; });
  ASSERT_TRUE(left_only);
  const auto told = robot().bus_status.waitNext(
      [](const BusStatus& status) { return status.text.find("drive right") != std::string::npos; });
  ASSERT_TRUE(told);
  EXPECT_THAT(told->text, AllOf(HasSubstr("vendor"), HasSubstr("99h"), HasSubstr("4Eh")));
  EXPECT_THAT(told->offline, ElementsAre("right"));
  EXPECT_THAT(robot().waitForDiagnostics("drive right", isError), HasSubstr("vendor"));
  EXPECT_FALSE(robot().right.status.next()->online);

  // All drives of the node or none.
  const Answer refused = robot().enable(true);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, HasSubstr("drive right"));
  EXPECT_TRUE(eventually([] { return robot().readParameter("left", 102).success; })) << "the other one is reachable";
  EXPECT_EQ(robot().left.truth.next()->control_word, 0x047E);
  for (const auto& truth : robot().right.truth.since(from)) {
    ASSERT_FALSE(truth->in_data_exchange);
    ASSERT_EQ(truth->control_word, 0) << "a control word for a device nobody knows";
  }
}

TEST_F(CanopenIdentity, TheRightDeviceIsStartedAndTold) {
  ros::param::set(kVendorKey, kSimulatedVendor);
  ASSERT_NO_FATAL_FAILURE(startDriver());
  ros::NodeHandle node;
  Topic<DeviceInfo> info(node, "nord_driver/right/device_info");
  const auto told = info.waitFrom(0, [](const DeviceInfo& device) { return device.ident != 0; });
  ASSERT_TRUE(told);
  EXPECT_EQ(told->ident >> 16, static_cast<std::uint32_t>(kSimulatedVendor));
  enableAndDrive(0.3);
}

}  // namespace
}  // namespace nord_driver::test

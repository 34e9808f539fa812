// From cmd_vel to odom over CANopen, on a virtual bus or on the kernel's.
#include <gmock/gmock.h>

#include "nord_driver/DeviceInfo.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class CanopenDrive : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
  }
  void TearDown() override {
    robot().silence();
    robot().enable(false);
    RobotTest::TearDown();
  }
};

// The wheels turn as commanded, odometry says so, and no rule of the bus was broken on the way.
TEST_F(CanopenDrive, ACommandMovesTheRobotAndComesBackAsOdometry) {
  Answer answer;
  ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
  const std::size_t from = robot().odom.mark();
  robot().drive(0.3);
  ASSERT_TRUE(robot().waitForTrueSpeed(0.27));
  EXPECT_TRUE(robot().odom.waitFrom(from, [](const nav_msgs::Odometry& odom) {
    return odom.twist.twist.linear.x > 0.27 && odom.pose.pose.position.x > 0.1;
  }));
  robot().silence();
  EXPECT_TRUE(robot().waitForStandstill());
  answer = robot().enable(false);
  EXPECT_TRUE(answer.success) << answer;
  answer = robot().referee();
  EXPECT_TRUE(answer.success) << answer;
}

TEST_F(CanopenDrive, DeviceInfoTellsHowItIsReachedAndWhatProtectsIt) {
  ros::NodeHandle node;
  Topic<DeviceInfo> topic(node, "nord_driver/left/device_info");
  const auto info = topic.waitFrom(0, [](const DeviceInfo& device) { return device.max_frequency.size() == 4; });
  ASSERT_TRUE(info);
  EXPECT_EQ(info->address, 3);
  EXPECT_EQ(info->parameter_channel, "SDO");
  EXPECT_THAT(info->protected_by, StartsWith("node guarding"));
  EXPECT_THAT(info->protected_by, HasSubstr("coasts"));
}

}  // namespace
}  // namespace nord_driver::test

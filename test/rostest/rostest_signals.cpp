// Signals and further setpoints by their topics: a lamp, a bit that P480 refuses, inputs, a torque limit.
#include <gmock/gmock.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>

#include "nord_driver/DeviceInfo.h"
#include "nord_driver/SimInputs.h"
#include "nord_driver/SimTerminals.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::ElementsAre;

class SignalTopics : public RobotTest {
 protected:
  SignalTopics()
      : lamp_(node_.advertise<std_msgs::Bool>("/nord_driver/left/signals/lamp", 1)),
        forbidden_(node_.advertise<std_msgs::Bool>("/nord_driver/left/signals/forbidden", 1)),
        allowed_(node_.advertise<std_msgs::Bool>("/nord_driver/left/signals/allowed", 1)),
        grip_(node_.advertise<std_msgs::Float64>("/nord_driver/left/setpoints/grip", 1)) {}

  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    Topic<DeviceInfo> info(node_, "/nord_driver/left/device_info");
    ASSERT_TRUE(info.waitFrom(0, [](const DeviceInfo& told) { return told.setpoint_names.size() == 3; }));
    for (const ros::Publisher& publisher : {lamp_, forbidden_, allowed_, grip_}) {
      ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; }));
    }
  }
  static void send(const ros::Publisher& publisher, bool on) {
    std_msgs::Bool message;
    message.data = on;
    publisher.publish(message);
  }
  template <typename Condition>
  bool truth(Condition condition) {
    return robot().left.truth.waitNext(condition) != nullptr;
  }

  ros::NodeHandle node_;
  ros::Publisher lamp_, forbidden_, allowed_, grip_;
};

TEST_F(SignalTopics, ALampFollowsItsTopicAndGoesOffByTimeOut) {
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.module_outputs == 0; }));
  send(lamp_, true);
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.module_outputs == 1; }));
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.module_outputs == 0; })) << "nobody renews it";
  send(lamp_, true);
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.module_outputs == 1; }));
  send(lamp_, false);
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.module_outputs == 0; }));
}

// Both are commanded, and only the one without a function goes high.
TEST_F(SignalTopics, ABitWithEnableRightIsRefused) {
  SimTerminals terminals;
  terminals.request.frequency = 20.0;
  ASSERT_TRUE(callService("nord_sim/left/terminals", terminals).success);
  send(forbidden_, true);
  send(allowed_, true);
  const std::size_t from = robot().left.truth.mark();
  ASSERT_TRUE(truth([](const SimDrive& drive) { return drive.bus_in_bits == 0x10; }));
  ASSERT_TRUE(eventually([&] { return robot().left.truth.mark() >= from + 50; }));
  for (const auto& seen : robot().left.truth.since(from)) {
    EXPECT_EQ(0, seen->bus_in_bits & 0x0F);
    EXPECT_EQ(0.0, seen->frequency);
  }
  send(allowed_, false);
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.bus_in_bits == 0; }));
}

TEST_F(SignalTopics, InputsArePublished) {
  Topic<std_msgs::Bool> door(node_, "/nord_driver/left/signals/door");
  Topic<std_msgs::Bool> limit_switch(node_, "/nord_driver/left/signals/switch");
  const auto is = [](bool on) { return [on](const std_msgs::Bool& told) { return (told.data != 0) == on; }; };
  EXPECT_TRUE(door.waitFrom(0, is(false)));
  EXPECT_TRUE(limit_switch.waitFrom(0, is(false)));
  SimInputs inputs;
  inputs.request.module_inputs = 2;
  inputs.request.digital_io = 4;
  ASSERT_TRUE(callService("nord_sim/left/inputs", inputs).success);
  EXPECT_TRUE(door.waitFrom(0, is(true)));
  EXPECT_TRUE(limit_switch.waitFrom(0, is(true)));
}

TEST_F(SignalTopics, ATorqueLimitIsSentAndGoesBackToItself) {
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.setpoint_3 == 13107; })) << "80 %";
  std_msgs::Float64 message;
  message.data = 25.0;
  grip_.publish(message);
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.setpoint_3 == 4096; }));
  EXPECT_TRUE(truth([](const SimDrive& drive) { return drive.setpoint_3 == 13107; })) << "nobody renews it";
}

TEST_F(SignalTopics, DeviceInfoNamesTheFunctions) {
  Topic<DeviceInfo> info(node_, "/nord_driver/left/device_info");
  const auto told = info.waitFrom(0, [](const DeviceInfo& message) { return message.setpoint_names.size() == 3; });
  ASSERT_TRUE(told);
  EXPECT_THAT(told->setpoint_names,
              ElementsAre("Setpoint frequency (16 bit)", "Bus I/O in bits 0...7", "Limiting torque current"));
  EXPECT_THAT(told->actual_value_names,
              ElementsAre("Actual frequency", "State of digital inputs and outputs", "Error number"));
}

}  // namespace
}  // namespace nord_driver::test

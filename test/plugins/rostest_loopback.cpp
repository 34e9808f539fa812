// A transport from another package (loopback/): its drive turns as any other, and what it has to tell reaches the user
// by the driver's own topics and services, which know nothing of it.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>

#include <cmath>
#include <string>

#include "nord_driver/ReadParameter.h"
#include "nord_driver/WriteParameter.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr double kVelocity = 3.0;  // rad/s

class ForeignTransport : public ::testing::Test {
 protected:
  ForeignTransport()
      : status_(node_, "nord_driver/belt/status"),
        joint_states_(node_, "joint_states"),
        bus_status_(node_, "nord_driver/bus_status"),
        diagnostics_(node_, "/diagnostics"),
        command_(node_.advertise<std_msgs::Float64>("nord_driver/belt/command", 1)) {
    timer_ = node_.createSteadyTimer(ros::WallDuration(0.02), [this](const ros::SteadyTimerEvent&) {
      std_msgs::Float64 message;
      message.data = velocity_;
      command_.publish(message);
    });
  }
  ~ForeignTransport() override { timer_.stop(); }
  void SetUp() override {
    ASSERT_TRUE(status_.waitNext([](const DriveStatus& status) { return status.online; }));
  }
  static Answer enable(bool on) {
    std_srvs::SetBool service;
    service.request.data = on;
    return callService("nord_driver/belt/enable", service);
  }
  /// The value of a line of a task of /diagnostics; empty when there is none.
  std::string diagnosticsOf(const std::string& task, const std::string& line) {
    std::string value;
    diagnostics_.waitNext([&](const diagnostic_msgs::DiagnosticArray& array) {
      for (const auto& told : array.status) {
        if (told.name.find(task) == std::string::npos) continue;
        for (const auto& item : told.values) {
          if (item.key == line) value = item.value;
        }
        return true;
      }
      return false;
    });
    return value;
  }

  ros::NodeHandle node_;
  Topic<DriveStatus> status_;
  Topic<sensor_msgs::JointState> joint_states_;
  Topic<BusStatus> bus_status_;
  Topic<diagnostic_msgs::DiagnosticArray> diagnostics_;
  ros::Publisher command_;
  ros::SteadyTimer timer_;
  std::atomic<double> velocity_{0.0};
};

TEST_F(ForeignTransport, ItsDriveFollowsAndStops) {
  ASSERT_TRUE(eventually([] { return enable(true).success; })) << enable(true);
  velocity_ = kVelocity;
  const auto follows = [](const DriveStatus& status) {
    return status.state == DriveStatus::OPERATION_ENABLED && std::abs(status.velocity - kVelocity) < 0.01;
  };
  EXPECT_TRUE(status_.waitNext(follows));
  EXPECT_TRUE(joint_states_.waitNext([](const sensor_msgs::JointState& state) {
    return state.name == std::vector<std::string>{"belt_joint"} && std::abs(state.velocity[0] - kVelocity) < 0.01;
  }));
  velocity_ = 0.0;
  EXPECT_TRUE(enable(false).success);
  EXPECT_TRUE(status_.waitNext([](const DriveStatus& status) {
    return status.state == DriveStatus::READY_TO_SWITCH_ON && status.velocity == 0.0;
  }));
}

TEST_F(ForeignTransport, ItsCountersAreShownByTheirNames) {
  const auto status = bus_status_.waitNext([](const BusStatus& bus) { return bus.connected && bus.cycles > 0; });
  ASSERT_TRUE(status);
  ASSERT_EQ(2u, status->counters.size());
  EXPECT_EQ("cycles", status->counters[0].name);
  EXPECT_EQ(status->cycles, status->counters[0].value);
  EXPECT_EQ("ignored_words", status->counters[1].name);
  EXPECT_GT(status->counters[1].value, 0u) << "the driver's first words command nothing";
  EXPECT_EQ("control words with bit 10 = 0, which a drive does not evaluate", status->counters[1].meaning);
  EXPECT_EQ(std::to_string(status->counters[1].value), diagnosticsOf("bus", "ignored words"));
}

// The launch argument bus:=B reached it, though no line of the driver knows a key "cable".
TEST_F(ForeignTransport, ItsEndPointIsTheOneOfTheLaunchFile) {
  EXPECT_EQ("B", diagnosticsOf("bus", "device"));
  EXPECT_EQ("loopback place 7", diagnosticsOf("drive belt", "address"));
}

TEST_F(ForeignTransport, ItsParameterErrorsAreToldInItsOwnWords) {
  ReadParameter read;
  read.request.number = 105;
  EXPECT_TRUE(callService("nord_driver/belt/read_parameter", read).success);
  EXPECT_DOUBLE_EQ(50.0, read.response.value);
  read.request.number = 999;
  const Answer unknown = callService("nord_driver/belt/read_parameter", read);
  EXPECT_FALSE(unknown.success);
  EXPECT_THAT(unknown.message, HasSubstr("loopback error 1, nobody has told this drive of such a parameter"));
  WriteParameter write;
  write.request.number = 102;
  write.request.value = 200.0;
  const Answer refused = callService("nord_driver/belt/write_parameter", write);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, HasSubstr("loopback error 2, that is more than this drive can remember"));
}

}  // namespace
}  // namespace nord_driver::test

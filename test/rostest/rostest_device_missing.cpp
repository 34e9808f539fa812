// The bus device is not there when the driver starts, comes, goes and comes again: never a reason to end.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include "rostest/lived_time.h"
#include "rostest/robot_under_test.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// The driver looks for its device at least every 2 s (INTERFACE: "retries"); the rest is start-up, charging included.
constexpr Seconds kFound{3.0};

class DeviceMissing : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(ros::param::get(std::string("nord_driver/bus/") + bus().end_point, device_)); }

  void startSimulator() {
    simulator_ = std::make_unique<NodeProcess>(kSimulatorProgram, std::vector<std::string>{"__name:=nord_sim"});
    // A virtual bus is nothing to be seen in a file system.
    struct stat info {};
    const auto is_there = [&] {
      return bus().end_point_is_file ? ::stat(device_.c_str(), &info) == 0
                                     : ros::service::exists("/nord_sim/referee", false);
    };
    ASSERT_TRUE(eventually(is_there)) << simulator_->errorText();
  }
  void expectAMissingDevice() {
    const auto missing = [](const BusStatus& status) { return !status.connected && status.offline.size() == 2; };
    const auto status = robot_.bus_status.waitNext(missing);
    ASSERT_TRUE(status);
    EXPECT_THAT(status->text, HasSubstr(device_));
    EXPECT_THAT(status->offline, UnorderedElementsAre("left", "right"));
    EXPECT_THAT(status->online, IsEmpty());
    const auto error = [](int level, const std::string&) { return level == diagnostic_msgs::DiagnosticStatus::ERROR; };
    EXPECT_THAT(robot_.waitForDiagnostics("bus", error), HasSubstr(device_));
    EXPECT_FALSE(robot_.left.status.next()->online);
    EXPECT_FALSE(robot_.right.status.next()->online);
  }

  void expectItFound() {
    const LivedTime left{robot_.left}, right{robot_.right};
    const auto online = [](const DriveStatus& status) { return status.online != 0; };
    const auto left_found = robot_.left.status.waitNext(online), right_found = robot_.right.status.waitNext(online);
    ASSERT_TRUE(left_found && right_found);
    EXPECT_LT(left.ofDriver(*left_found), kFound);
    EXPECT_LT(right.ofDriver(*right_found), kFound);
  }

  RobotUnderTest robot_;
  std::string device_;
  std::unique_ptr<NodeProcess> simulator_;
};

// One story: each part needs the one before.
TEST_F(DeviceMissing, IsSaidLookedForFoundAndLookedForAgain) {
  ASSERT_NO_FATAL_FAILURE(expectAMissingDevice());
  for (const char* service : {"enable", "quick_stop", "left/enable", "right/read_parameter"}) {
    EXPECT_TRUE(ros::service::exists(std::string("/nord_driver/") + service, false)) << service;
  }
  EXPECT_TRUE(robot_.joint_states.next());
  EXPECT_EQ(robot_.odom.mark(), 0u) << "no odometry before all drives of the base have answered";
  const Answer refused = robot_.enable(true);
  EXPECT_FALSE(refused.success);
  EXPECT_THAT(refused.message, HasSubstr("does not answer"));

  ASSERT_NO_FATAL_FAILURE(startSimulator());
  ASSERT_NO_FATAL_FAILURE(expectItFound());
  EXPECT_TRUE(robot_.odom.next());
  EXPECT_TRUE(robot_.waitForRest());
  EXPECT_TRUE(robot_.referee().success) << robot_.referee();

  // An adapter pulled out: its name goes, and its device hangs up. Were the name left, it would soon lead to the pty of
  // another test: the kernel gives the number of a pty that is closed to the next one.
  if (bus().end_point_is_file) {
    ASSERT_EQ(0, ::unlink(device_.c_str()));
  }
  simulator_->signal(SIGKILL);
  ASSERT_TRUE(simulator_->waitEnd(kPatience));
  ASSERT_NO_FATAL_FAILURE(expectAMissingDevice());

  // And plugged in again.
  ASSERT_NO_FATAL_FAILURE(startSimulator());
  ASSERT_NO_FATAL_FAILURE(expectItFound());
  Answer answer;
  EXPECT_TRUE(eventually([&] { return (answer = robot_.enable(true)).success; })) << answer;
  robot_.drive(0.3);
  EXPECT_TRUE(robot_.waitForTrueSpeed(0.27));
  answer = robot_.enable(false);
  EXPECT_TRUE(answer.success) << answer;
  answer = robot_.referee();
  EXPECT_TRUE(answer.success) << answer;
  simulator_->signal(SIGINT);
  EXPECT_TRUE(simulator_->waitEnd(kPatience)) << "the simulator takes its link away";
}

// A driver that has never seen its bus ends at once when it is asked to.
TEST_F(DeviceMissing, ANodeWithoutItsDeviceEndsCleanly) {
  XmlRpc::XmlRpcValue parameters;
  ASSERT_TRUE(ros::param::get("nord_driver", parameters));
  ros::param::set("lonely_driver", parameters);
  NodeProcess driver(kDriverProgram, {"__name:=lonely_driver"});
  ASSERT_TRUE(eventually([&] { return driver.errorText().find(device_) != std::string::npos; }));
  driver.signal(SIGINT);
  const auto end = driver.waitEnd(kPatience);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, 0) << driver.errorText();
}

}  // namespace
}  // namespace nord_driver::test

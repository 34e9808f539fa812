// The parameter tool against the simulator on a pty: what a technician sees who has no ROS running.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nord_driver/sim/pty_bus.h"
#include "nord_driver/tools/parameter_tool.h"
#include "nord_driver/transport/profibus_dp.h"

namespace nord_driver::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const char* const kRobot =
    "{bus: {baud_rate: 500000, watchdog: 0.5, slot_time: 0.05}, cycle_rate: 100, left_wheel: left_wheel_joint,"
    " drives: {left: {address: 3, series: sk5xxe, pole_pairs: 2, joint: left_wheel_joint}}}";

sim::SimConfig simulated() {
  sim::SimConfig config;
  sim::DriveConfig drive;
  drive.name = "left";
  drive.slave.address = 3;
  config.drives.push_back(drive);
  return config;
}

class ParameterToolTest : public ::testing::Test {
 protected:
  static YamlSettings settings(const std::string& device) {
    YAML::Node node = YAML::Load(kRobot);
    node["bus"]["device"] = device;
    return YamlSettings{"", node};
  }
  sim::PtyBus bus_{simulated(), "/tmp/nord_param_test." + std::to_string(::getpid())};
  ParameterTool tool_{settings(bus_.linkPath()), std::make_unique<ProfibusDpTransport>()};
};

TEST_F(ParameterToolTest, ReadsWritesAndNamesWhatIsWrong) {
  const DriveIndex left = tool_.driveNamed("left");
  ASSERT_TRUE(tool_.waitForDrive(left, std::chrono::seconds{20})) << tool_.trouble(left);
  const ParameterAnswer read = tool_.read(left, {105, 0, 0});
  EXPECT_EQ("P105 = 50 Hz (raw 500) Maximum frequency", answerText({105, 0, 0}, read));

  const ParameterAnswer written = tool_.write(left, {102, 2, 0}, {1.5, false, false});
  EXPECT_TRUE(written.success) << written.message;
  EXPECT_EQ(150, written.raw);
  EXPECT_DOUBLE_EQ(1.5, tool_.read(left, {102, 2, 0}).value);
  EXPECT_NE(1.5, tool_.read(left, {102, 1, 0}).value);

  EXPECT_THAT(answerText({513, 0, 0}, tool_.write(left, {513, 0, 0}, {200.0, false, false})),
              StartsWith("P513: the value 200 cannot be written"));
  EXPECT_THAT(tool_.write(left, {420, 0, 0}, {1.0, false, false}).message, HasSubstr("not in the catalogue"));
  EXPECT_THAT(tool_.read(left, {999, 0, 0}).message, HasSubstr("no parameter of this number"));
  EXPECT_THAT(tool_.read(left, {105, 5, 0}).message, HasSubstr("parameter set 5 does not exist"));
  EXPECT_THROW(tool_.driveNamed("lift"), ConfigError);
  // Idle from the first word on: nothing was enabled.
  bus_.withModel([](sim::RobotSim& robot) {
    EXPECT_EQ(0x047E, robot.drive(0).slave().counters().last_control);
    EXPECT_EQ("no rule broken", robot.referee().report());
    return 0;
  });
}

TEST(ParameterTool, SaysWhatIsMissing) {
  YAML::Node node = YAML::Load(kRobot);
  node["bus"]["device"] = "/dev/does_not_exist";
  ParameterTool tool{YamlSettings{"", node}, std::make_unique<ProfibusDpTransport>()};
  EXPECT_FALSE(tool.waitForDrive(0, std::chrono::milliseconds{200}));
  EXPECT_THAT(tool.trouble(0), HasSubstr("/dev/does_not_exist"));
}

}  // namespace
}  // namespace nord_driver::tools

// nord_param as a technician runs it, against simulated drives on a pty: one simulator for a suite of tests.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tools/program.h"

namespace nord_driver::test {

// Driver, simulator and program read the same file. Times are generous: this runs on loaded machines.
constexpr char kRobotOnPty[] = R"(
cycle_rate: 250.0
bus: {baud_rate: 500000, watchdog: 0.6, slot_time: 0.05}
drives:
  left:  {address: 3, series: sk5xxe, ppo_type: 1, joint: left_wheel_joint,  gear_ratio: 20.0, pole_pairs: 2}
  right: {address: 4, series: sk5xxe, ppo_type: 1, joint: right_wheel_joint, gear_ratio: 20.0, pole_pairs: 2}
left_wheel: left_wheel_joint
right_wheel: right_wheel_joint
wheel_separation: 0.5
wheel_radius: 0.1
)";

class ParamOnPty : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string base = ::testing::TempDir() + "nord_param_" + std::to_string(::getpid());
    config_ = base + ".yaml";
    dump_ = base + "_dump.yaml";
    device_ = base + "_bus";
    std::ofstream(config_) << kRobotOnPty;
    ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
    simulator_ =
        std::make_unique<Program>(std::vector<std::string>{NORD_SIM_PROGRAM, "--config", config_, "--device", device_});
    ASSERT_TRUE(simulator_->saysSomething(std::chrono::seconds{30})) << simulator_->errors();
  }
  static void TearDownTestSuite() {
    simulator_->signal(SIGTERM);
    EXPECT_EQ(0, simulator_->wait(std::chrono::seconds{30}));
    EXPECT_THAT(simulator_->output(), ::testing::HasSubstr("referee: no rule broken"));
    simulator_.reset();
    ::unlink(config_.c_str());
    ::unlink(dump_.c_str());
  }
  static Ended run(const std::vector<std::string>& words, const std::string& device = device_) {
    std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", config_, "--device", device};
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  }

  inline static std::string config_, dump_, device_;
  inline static std::unique_ptr<Program> simulator_;
};

}  // namespace nord_driver::test

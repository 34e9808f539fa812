// nord_param check as a technician runs it, against simulated drives on a pty.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <memory>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Driver, simulator and program read the same file. Left is factory-new, of right the EEPROM is off.
constexpr char kRobot[] = R"(
cycle_rate: 250.0
bus: {baud_rate: 500000, watchdog: 0.6, slot_time: 0.05}
drives:
  left:  {address: 3, series: sk2xxe, ppo_type: 1, joint: l, gear_ratio: 20.0, pole_pairs: 2, parameters: {P509: 0}}
  right: {address: 4, series: sk5xxe, ppo_type: 1, joint: r, gear_ratio: 20.0, pole_pairs: 2, parameters: {P560: 0}}
left_wheel: l
right_wheel: r
wheel_separation: 0.5
wheel_radius: 0.1
linear/x: {has_velocity_limits: true, max_velocity: 0.7}
)";

class CheckCommand : public ::testing::Test {
 protected:
  CheckCommand() {
    std::ofstream(config_) << kRobot;
    ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
    simulator_ =
        std::make_unique<Program>(std::vector<std::string>{NORD_SIM_PROGRAM, "--config", config_, "--device", device_});
    EXPECT_TRUE(simulator_->saysSomething(seconds{30})) << simulator_->errors();
  }
  ~CheckCommand() override {
    simulator_->signal(SIGTERM);
    EXPECT_EQ(0, simulator_->wait(seconds{30}));
    EXPECT_THAT(simulator_->output(), HasSubstr("referee: no rule broken"));
    ::unlink(config_.c_str());
  }
  Ended run(const std::vector<std::string>& words) const {
    std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", config_, "--device", device_, "check"};
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  }

  std::string base_ = ::testing::TempDir() + "check_command_" + std::to_string(::getpid());
  std::string config_ = base_ + ".yaml", device_ = base_ + "_bus";
  std::unique_ptr<Program> simulator_;
};

// Exit code 1 with findings; nothing is written without a yes; afterwards there is nothing to find, and the exit code 0.
TEST_F(CheckCommand, FindsAndFixes) {
  const Ended found = run({});
  EXPECT_EQ(1, found.code) << found.errors;
  EXPECT_THAT(found.output,
              AllOf(HasSubstr("drive left (PROFIBUS station 3, inverter 1), sk2xxe: 3 findings\n"),
                    HasSubstr("P509 Control word source = 0 Control terminals or keyboard"),
                    HasSubstr("P480[-01] Function of bus I/O in bits, Bus I/O in bit 0 = 1 Enable right"),
                    HasSubstr("drive right (PROFIBUS station 4), sk5xxe: 1 finding\n"),
                    HasSubstr("P560 Save in EEPROM = 0 RAM only"), HasSubstr("4 findings in 2 drives\n")));
  EXPECT_THAT(found.errors, IsEmpty());

  const Ended one = run({"right", "--json"});
  EXPECT_EQ(1, one.code);
  EXPECT_THAT(one.output, AllOf(HasSubstr(R"("rule": "writes_saved")"), Not(HasSubstr("left"))));

  const Ended unasked = run({"--fix"});
  EXPECT_EQ(1, unasked.code);
  EXPECT_THAT(unasked.errors,
              AllOf(HasSubstr("write left: P509 Control word source: 0 Control terminals or keyboard -> 3"),
                    HasSubstr("nothing was written")));
  EXPECT_EQ(found.output, run({}).output);

  const Ended fixed = run({"--fix", "--yes"});
  EXPECT_EQ(0, fixed.code) << fixed.errors;
  EXPECT_THAT(fixed.output, HasSubstr("0 findings in 2 drives\n"));
  const Ended again = run({"left"});
  EXPECT_EQ(0, again.code);
  EXPECT_EQ("drive left (PROFIBUS station 3, inverter 1), sk2xxe: nothing found\n0 findings in 1 drive\n",
            again.output);
}

TEST_F(CheckCommand, RefusesWhatMakesNoSense) {
  const Ended unknown = run({"lift"});
  EXPECT_EQ(2, unknown.code);
  EXPECT_EQ("nord_param: drive \"lift\" is not in the configuration, expected one of left, right\n", unknown.errors);
  const Ended persistent = run({"--persistent"});
  EXPECT_EQ(2, persistent.code);
  EXPECT_EQ("nord_param: --persistent belongs to --fix\n", persistent.errors);
}

// The others are asked all the same.
TEST_F(CheckCommand, TellsOfADriveThatDoesNotAnswer) {
  const std::string more = base_ + "_more.yaml";
  std::ofstream(more) << "drives: {arm: {address: 9, series: sk5xxe, joint: a, pole_pairs: 2}}\n";
  const Ended found = run({"--timeout", "3", "--config", more, "arm", "right"});
  EXPECT_EQ(1, found.code);
  EXPECT_THAT(found.output, AllOf(HasSubstr("drive arm (PROFIBUS station 9), sk5xxe: could not be asked: "),
                                  HasSubstr("1 finding in 1 drive\n")));
  ::unlink(more.c_str());
}

}  // namespace
}  // namespace nord_driver::test

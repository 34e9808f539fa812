// The simulator's program as a user runs it. What it simulates is tested in test/sim.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class NordSim : public ::testing::Test {
 protected:
  NordSim() { std::ofstream(config_) << "drives: {left: {address: 3}}\n"; }
  ~NordSim() override { ::unlink(config_.c_str()); }
  Ended run(std::vector<std::string> words) const {
    words.insert(words.begin(), {NORD_SIM_PROGRAM, "--config", config_, "--device", base_ + "_bus"});
    return runProgram(words);
  }

  std::string base_ = ::testing::TempDir() + "nord_sim_" + std::to_string(::getpid());
  std::string config_ = base_ + ".yaml";
};

// 0 done, 1 failed, 2 wrong usage, as the other programs of this package.
TEST_F(NordSim, ItsExitCodeTellsWrongUsageFromFailure) {
  const Ended done = run({"--duration", "0.01"});
  EXPECT_EQ(0, done.code) << done.errors;
  EXPECT_THAT(done.output, StartsWith(base_ + "_bus\nreferee: "));
  EXPECT_EQ(0, run({"--help"}).code);
  EXPECT_EQ(0, run({"--version"}).code);
  EXPECT_EQ(2, run({"--duration", "soon"}).code);
  EXPECT_EQ(2, run({"--no_such_option"}).code);
  EXPECT_EQ(2, runProgram({NORD_SIM_PROGRAM}).code) << "--config is required";
  const Ended missing = runProgram({NORD_SIM_PROGRAM, "--config", base_ + "_is_not_there"});
  EXPECT_EQ(1, missing.code);
  EXPECT_THAT(missing.errors, StartsWith("nord_sim: --config " + base_ + "_is_not_there: "));
  EXPECT_THAT(missing.output, IsEmpty());
}

TEST_F(NordSim, SaysWhatIsWrongWithItsFile) {
  EXPECT_EQ("nord_sim: --config /tmp: it is a folder, expected groups of keys and values\n",
            runProgram({NORD_SIM_PROGRAM, "--config", "/tmp"}).errors);
  std::ofstream(config_) << "[1, 2]\n";
  EXPECT_EQ("nord_sim: --config " + config_ + ": it has no keys, expected groups of keys and values\n",
            run({"--duration", "0.01"}).errors);
  std::ofstream(config_) << "{transport: canopn, drives: {left: {address: 3}}}\n";
  const Ended misspelt = run({"--duration", "0.01"});
  EXPECT_EQ(1, misspelt.code);
  EXPECT_THAT(misspelt.errors, ::testing::HasSubstr("transport: canopn is not valid"));
  EXPECT_THAT(misspelt.errors, ::testing::HasSubstr("profibus_dp, canopen, devicenet, interbus"));
}

// By its aliases a file of one line can be a tree without end.
TEST_F(NordSim, AFileThatHoldsItselfIsRefused) {
  std::ofstream(config_) << "drives: &all {left: *all}\n";
  const Ended refused = run({"--duration", "0.01"});
  EXPECT_EQ(1, refused.code);
  EXPECT_THAT(refused.errors,
              StartsWith("nord_sim: --config " + config_ + ": it is more than 50 groups and lists deep"));
}

// As rosparam reads the file for the simulator's node: without the merge both drives would have the key "<<" and no address.
TEST_F(NordSim, ResolvesMergeKeys) {
  std::ofstream(config_) << "drives: {left: &wheel {address: 3, series: sk2xxe}, right: {<<: *wheel, address: 4}}\n";
  const Ended done = run({"--duration", "0.01"});
  EXPECT_EQ(0, done.code);
  EXPECT_EQ("", done.errors);
  std::ofstream(config_) << "drives: {left: {<<: wheel, address: 3}}\n";
  const Ended refused = run({"--duration", "0.01"});
  EXPECT_EQ(1, refused.code);
  EXPECT_EQ("nord_sim: --config " + config_ +
                ": line 1: <<: \"wheel\" is not valid, expected a group or a list of groups, whose keys are taken\n",
            refused.errors);
}

// Shorter than a range with all its digits, and nan is no time.
TEST_F(NordSim, ATimeThatIsNoneIsRefusedInShortWords) {
  for (const char* const wrong : {"-1", "0", "nan", "soon"}) {
    const Ended refused = run({"--duration", wrong});
    EXPECT_EQ(2, refused.code);
    EXPECT_THAT(refused.errors,
                StartsWith(std::string("--duration: ") + wrong + " is not valid, expected more than 0 s\n"));
  }
  const Ended endless = run({"--duration", "inf"});
  EXPECT_EQ(2, endless.code);
  EXPECT_THAT(endless.errors, StartsWith("--duration: inf is not valid, expected at most 1000000000 s\n"));
}

// --bus and the key bus_end_point say it for every kind of bus.
TEST_F(NordSim, IsFoundWhereTheBusOptionSays) {
  const auto start = [&](const std::vector<std::string>& words) {
    std::vector<std::string> command{NORD_SIM_PROGRAM, "--config", config_, "--duration", "0.01"};
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  };
  EXPECT_THAT(start({"--bus", base_ + "_pty"}).output, StartsWith(base_ + "_pty\n"));
  std::ofstream(config_) << "{transport: canopen, drives: {left: {address: 3}}}\n";
  EXPECT_THAT(start({"--bus", "virtual:" + std::to_string(::getpid())}).output,
              StartsWith("virtual:" + std::to_string(::getpid()) + "\n"));
  std::ofstream(config_) << "{bus_end_point: " << base_ << "_key, drives: {left: {address: 3}}}\n";
  EXPECT_THAT(start({}).output, StartsWith(base_ + "_key\n"));
}

// What simulate.launch gives the driver: never less than its configuration asks for, or can have.
TEST_F(NordSim, TellsAPatientDriveTimeout) {
  const auto told = [&](const std::string& keys) {
    std::ofstream(config_) << "{" << keys << "drives: {left: {address: 3}}}\n";
    return runProgram({NORD_SIM_PROGRAM, "--config", config_, "--drive-timeout"}).output;
  };
  EXPECT_EQ("0.2500", told(""));
  EXPECT_EQ("0.6000", told("cycle_rate: 5, "));
  EXPECT_EQ("1.5000", told("cycle_rate: 5, drive_timeout: 1.5, "));
  EXPECT_EQ("0.2500", told("drive_timeout: 0.05, "));
}

TEST_F(NordSim, ThePortOfTheOtherTransportIsRefused) {
  const Ended profibus = run({"--interface", "virtual:x", "--duration", "0.01"});
  EXPECT_EQ(2, profibus.code);
  EXPECT_EQ("nord_sim: --interface does not fit the transport profibus_dp, expected --device\n", profibus.errors);
  const Ended both = run({"--bus", "/tmp/x", "--duration", "0.01"});
  EXPECT_EQ(2, both.code);
  EXPECT_EQ("nord_sim: --bus and --device both say where the bus is, expected one of them\n", both.errors);
  std::ofstream(config_) << "{transport: canopen, drives: {left: {address: 3}}}\n";
  const Ended canopen = run({"--duration", "0.01"});
  EXPECT_EQ(2, canopen.code);
  EXPECT_EQ("nord_sim: --device does not fit the transport canopen, expected --interface\n", canopen.errors);
}

}  // namespace
}  // namespace nord_driver::test

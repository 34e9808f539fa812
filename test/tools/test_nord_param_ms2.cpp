// nord_param over MS2: what a PROFIBUS module tells that is not in data exchange.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "tools/program.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr char kModuleWithoutAnAddress[] = R"(
cycle_rate: 100.0
bus: {baud_rate: 500000, slot_time: 0.05}
drives: {left: {address: 126, series: sk2xxe, joint: l, gear_ratio: 20.0, pole_pairs: 2}}
)";

// A PROFIBUS module as it comes from the factory: nobody can exchange data with the address 126.
TEST(NordParamOverMs2, ReadsFromAModuleWithoutAnAddress) {
  const std::string base = ::testing::TempDir() + "nord_param_ms2_" + std::to_string(::getpid());
  const std::string config = base + ".yaml", over_ms2 = base + "_over.yaml", device = base + "_bus";
  std::ofstream(config) << kModuleWithoutAnAddress;
  std::ofstream(over_ms2) << "transport: profibus_ms2\n";
  Program simulator({NORD_SIM_PROGRAM, "--config", config, "--device", device});
  ASSERT_TRUE(simulator.saysSomething(seconds{30})) << simulator.errors();
  const std::vector<std::string> words{"--device", device, "--timeout", "20", "read", "left", "P105"};
  std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", config};
  command.insert(command.end(), words.begin(), words.end());
  EXPECT_THAT(runProgram(command).errors, HasSubstr("126 is what a module has from the factory"));
  command.insert(command.begin() + 3, {"--config", over_ms2});
  const Ended read = runProgram(command);
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ("P105 set 1 Maximum frequency = 50.0 Hz (raw 500)\n", read.output);
  simulator.signal(SIGTERM);
  EXPECT_EQ(0, simulator.wait(seconds{30}));
  EXPECT_THAT(simulator.output(), HasSubstr("referee: no rule broken"));
  ::unlink(config.c_str());
  ::unlink(over_ms2.c_str());
}

// One line in a second file, and nothing is opened: neither for the list, nor where a node has the bus.
TEST(NordParamOverMs2, ListsAndAsksANode) {
  const std::string base = ::testing::TempDir() + "nord_param_ms2_node_" + std::to_string(::getpid());
  const std::string config = base + ".yaml", over_ms2 = base + "_over.yaml";
  std::ofstream(config) << kModuleWithoutAnAddress;
  std::ofstream(over_ms2) << "transport: profibus_ms2\n";
  ::setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);  // nobody there
  const auto over = [&](const std::vector<std::string>& words) {
    std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", config, "--config", over_ms2};
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  };
  const Ended list = over({"list"});
  EXPECT_EQ(0, list.code) << list.errors;
  EXPECT_THAT(list.output, HasSubstr("parameter channel: DP-V1 records, MS2\n"));
  for (const std::vector<std::string>& asked : {std::vector<std::string>{"read", "left", "P105"}, {"watch", "left"}}) {
    std::vector<std::string> words{"--device", "/dev/null", "--node", "/nord_driver"};
    words.insert(words.end(), asked.begin(), asked.end());
    EXPECT_THAT(over(words).errors, HasSubstr("no ROS master answers")) << asked[0];
  }
  EXPECT_THAT(over({"check-config"}).output, HasSubstr("expected nord_driver/profibus_dp for a driver"));
  ::unlink(config.c_str());
  ::unlink(over_ms2.c_str());
}

}  // namespace
}  // namespace nord_driver::test

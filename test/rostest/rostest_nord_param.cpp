// nord_param beside the driver: through its node, which it finds by the bus the node has.
#include <gmock/gmock.h>
#include <nord_driver/ProcessData.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "rostest/robot_under_test.h"
#include "tools/program.h"

namespace nord_driver::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr char kThroughNode[] = "nord_param: through node /nord_driver, which has the bus\n";

class NordParamBesideTheDriver : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(ros::param::get("nord_driver/bus/device", device_));
  }
  /// With the driver's file and the bus it has.
  Ended run(const std::vector<std::string>& words, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", NORD_ROBOT_FILE, "--bus", device_};
    command.insert(command.end(), options.begin(), options.end());
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  }

  std::string device_;
};

TEST_F(NordParamBesideTheDriver, ReadsThroughItsNode) {
  const Ended read = run({"read", "left", "P105"});
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ("P105 set 1 Maximum frequency = 50.0 Hz (raw 500)\n", read.output);
  EXPECT_EQ(kThroughNode, read.errors);
  EXPECT_EQ("P105 set 3 Maximum frequency = 25.0 Hz (raw 250)\n", run({"read", "left", "P105", "--set", "3"}).output);
  const Ended unknown = run({"read", "left", "999"});
  EXPECT_EQ(1, unknown.code);
  EXPECT_THAT(unknown.errors, HasSubstr("drive left refuses P999"));
}

TEST_F(NordParamBesideTheDriver, FindsTheBusByAnotherNameOfTheSameDevice) {
  const std::string link = ::testing::TempDir() + "nord_param_" + std::to_string(::getpid());
  ASSERT_EQ(0, ::symlink(device_.c_str(), link.c_str()));
  device_ = link;
  const Ended read = run({"read", "left", "P105"});
  EXPECT_EQ(kThroughNode, read.errors);
  ::unlink(link.c_str());
}

TEST_F(NordParamBesideTheDriver, AsksTheNodeThatIsNamedWhateverBusTheFileSays) {
  device_ = "/dev/no_such_device";
  const Ended read = run({"read", "right", "P105"}, {"--node", "/nord_driver"});
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ(kThroughNode, read.errors);
  const Ended none = run({"read", "right", "P105"}, {"--node", "/nobody"});
  EXPECT_EQ(1, none.code);
  EXPECT_THAT(none.errors, HasSubstr("no service /nobody/right/read_parameter"));
}

// A bus nobody has is opened, and no node is asked.
TEST_F(NordParamBesideTheDriver, LeavesANodeOfAnotherBusAlone) {
  device_ = "/dev/no_such_device";
  const Ended read = run({"read", "left", "P105"}, {"--timeout", "0.2"});
  EXPECT_EQ(1, read.code);
  EXPECT_THAT(read.errors, AllOf(Not(HasSubstr("node /nord_driver")), HasSubstr("/dev/no_such_device")));
}

TEST_F(NordParamBesideTheDriver, WritesToRamAndIsRefusedWhileItMoves) {
  const std::uint64_t before = robot().left.truth.next()->eeprom_writes;
  const Ended written = run({"write", "left", "P102", "0.6"});
  EXPECT_EQ(0, written.code) << written.errors;
  EXPECT_EQ("P102 set 1 Acceleration time = 0.60 s (raw 60), in RAM: lost at power off\n", written.output);
  EXPECT_EQ(before, robot().left.truth.next()->eeprom_writes);
  EXPECT_EQ(0, run({"write", "left", "P102", "0.5"}).code);

  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
  const Ended refused = run({"write", "left", "P105", "40"});
  EXPECT_EQ(1, refused.code);
  EXPECT_THAT(refused.output, IsEmpty());
  EXPECT_EQ(std::string(kThroughNode) +
                "nord_param: P105 decides what setpoints and actual values mean: disable drive left first\n",
            refused.errors);
}

TEST_F(NordParamBesideTheDriver, DumpsAndCompares) {
  const Ended dump = run({"dump", "left"});
  ASSERT_EQ(0, dump.code) << dump.errors;
  EXPECT_THAT(dump.output,
              AllOf(HasSubstr("# What nord_param read from drive left"), HasSubstr("\"P105 set 1\": {raw: 500")));
  const std::string file = ::testing::TempDir() + "nord_param_dump_" + std::to_string(::getpid());
  std::ofstream(file) << dump.output;
  const Ended same = run({"compare", "left", file});
  EXPECT_EQ(0, same.code) << same.output << same.errors;
  EXPECT_THAT(same.output, HasSubstr("0 of "));
  ::unlink(file.c_str());
}

// Through the node as over the bus: what is written to one wheel of a base that drives is none of its own.
TEST_F(NordParamBesideTheDriver, RestoresADriveAtRestOnly) {
  const std::string file = ::testing::TempDir() + "nord_param_restore_" + std::to_string(::getpid());
  std::ofstream(file) << "series: sk5xxe\nsettings: {\"P102 set 1\": {raw: 70}}\n";
  const std::vector<std::string> words{"restore", "left", file, "--yes", "--journal", file + ".journal"};
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
  const Ended refused = run(words);
  EXPECT_EQ(1, refused.code);
  EXPECT_THAT(refused.errors, HasSubstr("drive left is enabled, and was left as it is: disable it first"));
  EXPECT_EQ("P102 set 1 Acceleration time = 0.50 s (raw 50)\n", run({"read", "left", "P102"}).output);
  ASSERT_TRUE(robot().enable(false).success);
  std::vector<std::string> same = words;
  same.insert(same.end(), {"--persistent", "--save-same"});
  EXPECT_THAT(run(same).errors, HasSubstr("--save-same does not go through the node"));
  const Ended restored = run(words);
  EXPECT_EQ(0, restored.code) << restored.errors;
  EXPECT_THAT(restored.output, HasSubstr("1 written and read back"));
  const Ended back = run({"restore", "left", "--take-back", "--yes", "--journal", file + ".journal"});
  EXPECT_EQ(0, back.code) << back.errors;
  EXPECT_EQ("P102 set 1 Acceleration time = 0.50 s (raw 50)\n", run({"read", "left", "P102"}).output);
  ::unlink(file.c_str());
  ::unlink((file + ".journal").c_str());
}

// Refused by the node after the first value, it would take the whole restore back.
TEST_F(NordParamBesideTheDriver, LeavesOutOfARestoreWhatTheNodeDoesNotWrite) {
  const std::string file = ::testing::TempDir() + "nord_param_fence_" + std::to_string(::getpid());
  std::ofstream(file) << "series: sk5xxe\nsettings: {\"P102 set 1\": {raw: 70}, \"P103 set 1\": {raw: 70}}\n";
  const Ended restored = run({"restore", "left", file, "--yes", "--journal", file + ".journal"});
  EXPECT_EQ(0, restored.code) << restored.errors;
  EXPECT_THAT(restored.output, AllOf(HasSubstr("P103 may not be written: writable_parameters allows P102, P105"),
                                     HasSubstr("1 written and read back")));
  EXPECT_THAT(run({"read", "left", "P103"}).output, HasSubstr("Deceleration time = 0.50 s"));
  EXPECT_EQ(0, run({"restore", "left", "--take-back", "--yes", "--journal", file + ".journal"}).code);
  ::unlink(file.c_str());
  ::unlink((file + ".journal").c_str());
}

// Sent in ms, 2500 would be 2500 s there.
TEST_F(NordParamBesideTheDriver, WritesNothingThatTheNodeUnderstandsOtherwise) {
  const std::string own = ::testing::TempDir() + "nord_param_own_" + std::to_string(::getpid()) + ".yaml";
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n  - {number: 102, unit: ms, resolution: 10}\n";
  const Ended refused = run({"--parameter-files", own, "write", "left", "P102", "2500"});
  EXPECT_EQ(1, refused.code) << refused.output;
  EXPECT_THAT(refused.errors, HasSubstr("knows P102 otherwise than this program: the raw value 50 is 0.5 s there and "
                                        "500 ms here; give both the same parameter_files"));
  EXPECT_EQ("P102 set 1 Acceleration time = 0.50 s (raw 50)\n", run({"read", "left", "P102"}).output);
  ::unlink(own.c_str());
}

// A drive that moves, which over the bus itself would be left alone.
TEST_F(NordParamBesideTheDriver, WatchesADriveThatMoves) {
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
  const Ended watched = run({"watch", "left", "right", "--parameter", "P102", "--once", "--json"});
  EXPECT_EQ(0, watched.code) << watched.errors;
  EXPECT_EQ(kThroughNode, watched.errors);
  EXPECT_THAT(watched.output,
              AllOf(HasSubstr("\"drive\": \"left\", \"online\": true"), HasSubstr("\"state\": \"operation enabled\""),
                    HasSubstr("\"P102 Acceleration time\": \"0.50 s\""), HasSubstr("\"drive\": \"right\"")));
  const auto truth = robot().left.truth.next();
  const std::size_t at = watched.output.find("\"frequency\": ");
  ASSERT_NE(std::string::npos, at);
  EXPECT_NEAR(truth->frequency, std::stod(watched.output.substr(at + 13)), 1.0);
}

/// The cycles of `told` that have these times, in s since the first of them, one after the other: how many.
std::size_t cyclesAt(const std::vector<double>& times, const std::vector<Topic<ProcessData>::Pointer>& told) {
  constexpr double kRounding = 2e-6;
  std::size_t most = 0;
  for (std::size_t first = 0; first < told.size(); ++first) {
    std::size_t same = 0;
    while (same < times.size() && first + same < told.size() &&
           told[first + same]->cycle == told[first]->cycle + same &&
           std::fabs(told[first + same]->time - told[first]->time - times[same]) < kRounding) {
      ++same;
    }
    most = std::max(most, same);
  }
  return most;
}

// Every cycle the node has had meanwhile, however many those are, each with what was sent in it.
TEST_F(NordParamBesideTheDriver, WritesEveryCycle) {
  ros::NodeHandle node;
  Topic<ProcessData> told{node, "nord_driver/left/process_data"};
  ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
  ASSERT_TRUE(told.next());
  const Ended scope = run({"scope", "left", "--duration", "3"});
  ASSERT_TRUE(told.next()) << "whatever the scope was told has come here, too";
  EXPECT_EQ(0, scope.code) << scope.errors;
  EXPECT_EQ(kThroughNode, scope.errors);
  std::istringstream lines{scope.output};
  std::vector<double> times;
  std::size_t enabled = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    times.push_back(std::stod(line));
    if (line.find(",1,047F,") != std::string::npos) ++enabled;
  }
  ASSERT_FALSE(times.empty());
  EXPECT_EQ(times.size(), cyclesAt(times, told.since(0)));
  EXPECT_EQ(times.size(), enabled) << "enabled all the time";
  EXPECT_THAT(scope.output, HasSubstr("# P105: 50 Hz\n"));
  EXPECT_NEAR(3.0, times.back(), 0.2);
}

TEST_F(NordParamBesideTheDriver, ScansWhatTheNodeKnows) {
  const Ended scan = run({"scan"});
  EXPECT_EQ(0, scan.code) << scan.errors;
  EXPECT_EQ(kThroughNode, scan.errors);
  EXPECT_THAT(scan.output,
              AllOf(HasSubstr("node /nord_driver (profibus_dp):\n"), HasSubstr("ident 7531h"), HasSubstr("sk5xxe"),
                    HasSubstr("drive left, online"), HasSubstr("drive right, online")));
  EXPECT_TRUE(robot().simulator("right/unplug", true).success);
  EXPECT_TRUE(
      eventually([this] { return run({"scan"}).output.find("drive right, does not answer") != std::string::npos; }));
  EXPECT_TRUE(robot().simulator("right/unplug", false).success);
}

}  // namespace
}  // namespace nord_driver::test

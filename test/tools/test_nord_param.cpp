// The program as a technician runs it, against simulated drives on a pty. No ROS master is asked for.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>

#include "core/version.h"
#include "link/can/virtual_can.h"
#include "support/second_try.h"
#include "tools/param_on_pty.h"
#include "tools/program.h"

namespace nord_driver::test {
namespace {

using std::chrono::seconds;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class NordParam : public ParamOnPty {};

// Neither file nor command line names a device.
TEST_F(NordParam, ListsDrivesAndCatalogueWithoutABus) {
  const Ended list = runProgram({NORD_PARAM_PROGRAM, "--config", config_, "list"});
  EXPECT_EQ(0, list.code) << list.errors;
  EXPECT_THAT(list.output, HasSubstr("left         PROFIBUS station 3       sk5xxe   parameter channel: PKW\n"));
  EXPECT_THAT(list.output, HasSubstr("P102  Acceleration time                 0 to 655.35 s          sets 1 to 4\n"));
  EXPECT_EQ(list.output, run({"list"}, "/dev/is_not_there").output);
  EXPECT_EQ(2, runProgram({NORD_PARAM_PROGRAM, "--config", config_, "read", "left", "P105"}).code) << "needs a device";
}

// The value, its unit and the set it is of.
TEST_F(NordParam, ReadsAParameter) {
  const Ended read = run({"read", "left", "P105"});
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ("P105 set 1 Maximum frequency = 50.0 Hz (raw 500)\n", read.output);
  EXPECT_THAT(read.errors, IsEmpty());
  EXPECT_EQ("P700[-01] Current error = 0.0 no fault (raw 0)\n", run({"read", "left", "P700[-01]"}).output)
      << "the end of the run before is no fault";
}

// The names in the files of the series, for parameters and for values.
TEST_F(NordParam, TakesAndTellsNames) {
  EXPECT_EQ("P105 set 3 Maximum frequency = 50.0 Hz (raw 500)\n",
            run({"read", "left", "maximum frequency", "--set", "3"}).output);
  EXPECT_EQ("P740[-02] Process data bus in, Setpoint 1 = 0000h (raw 0)\n",
            run({"read", "left", "Process data bus in[-02]"}).output);
  const Ended written = run({"write", "right", "Setpoint source[-02]", "profibus"});
  EXPECT_EQ(0, written.code) << written.errors;
  EXPECT_THAT(written.output, StartsWith("P510[-02] Setpoint source"));
  EXPECT_THAT(written.output, HasSubstr("= 4 PROFIBUS (raw 4), in RAM"));
  const Ended slip = run({"write", "right", "P509", "PROFIBAS"});
  EXPECT_EQ(2, slip.code);
  EXPECT_EQ("nord_param: P509: \"PROFIBAS\" is not valid, expected perhaps \"PROFIBUS\"\n", slip.errors);
  const Ended read_only = run({"write", "right", "P743", "1"});
  EXPECT_EQ(1, read_only.code);
  EXPECT_EQ("nord_param: P743 Inverter power can only be read\n", read_only.errors);
}

// Laid over the project's, from the command line or the configuration; a wrong one is told with its line.
TEST_F(NordParam, TakesFilesOfTheUser) {
  const std::string own = config_ + "_own.yaml";
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n  - {number: 105, name: Top frequency, unit: 1/s}\n";
  EXPECT_EQ("P105 set 1 Top frequency = 50.0 1/s (raw 500)\n",
            run({"--parameter-files", own, "read", "left", "Top frequency"}).output);
  const std::string naming = config_ + "_naming.yaml";
  std::ofstream(naming) << "parameter_files: [" << own << "]\n";
  EXPECT_THAT(runProgram({NORD_PARAM_PROGRAM, "--config", config_, "--config", naming, "list"}).output,
              HasSubstr("  P105  Top frequency "));
  std::ofstream(own) << "devices: [sk5xxe]\nparameters:\n  - {number: 105, units: Hz}\n";
  const Ended wrong = run({"--parameter-files", own, "list"});
  EXPECT_EQ(2, wrong.code);
  EXPECT_EQ("nord_param: " + own + ":3: number 105: units is not a key of this file, expected perhaps \"unit\"\n",
            wrong.errors);
  ::unlink(own.c_str());
  ::unlink(naming.c_str());
}

TEST_F(NordParam, DescribesOneParameter) {
  const Ended described = runProgram({NORD_PARAM_PROGRAM, "--config", config_, "list", "--parameter", "P509"});
  EXPECT_EQ(0, described.code) << described.errors;
  EXPECT_THAT(described.output, StartsWith("sk5xxe (left, right): P509 Source control word\n  range      0 to 10\n"));
  EXPECT_THAT(described.output, HasSubstr("    4        PROFIBUS\n"));
}

// The EEPROM is spared, the value stays for the next run, and what is there already is not written again; saving it is
// another matter: nobody can see whether it is in the RAM only.
TEST_F(NordParam, WritesIntoTheRamAndNotTwice) {
  const Ended first = run({"write", "right", "102", "2.5", "--set", "2"});
  EXPECT_EQ(0, first.code) << first.errors;
  EXPECT_EQ("P102 set 2 Acceleration time = 2.50 s (raw 250), in RAM: lost at power off\n", first.output);
  const Ended again = run({"write", "right", "102", "250", "--raw", "--set", "2"});
  EXPECT_EQ(0, again.code) << again.errors;
  EXPECT_THAT(again.output, HasSubstr("the inverter has this value already: nothing was written"));
  EXPECT_EQ("P102 set 2 Acceleration time = 2.50 s (raw 250), in the EEPROM\n",
            run({"write", "right", "102", "2.5", "--set", "2", "--persistent"}).output);
}

TEST_F(NordParam, NamesWhatTheInverterRefuses) {
  const Ended read = run({"read", "left", "P999"});
  EXPECT_EQ(1, read.code);
  EXPECT_EQ("nord_param: drive left refuses P999: PKW error 0, the inverter has no parameter of this number\n",
            read.errors);
  const Ended write = run({"write", "left", "P105", "6000"});
  EXPECT_EQ(1, write.code);
  EXPECT_THAT(write.errors, StartsWith("nord_param: drive left refuses P105: PKW error 2, "));
}

TEST_F(NordParam, RefusesAValueBeyondTheCatalogue) {
  const Ended write = run({"write", "left", "P513", "-0.2"});
  EXPECT_EQ(1, write.code);
  EXPECT_EQ("nord_param: the value -0.2 cannot be written to P513, expected -0.1 to 100 s\n", write.errors);
}

TEST_F(NordParam, SaysWhatIsWrongWithTheCommandLine) {
  const Ended drive = run({"read", "lift", "P105"});
  EXPECT_EQ(2, drive.code);
  EXPECT_EQ("nord_param: drive \"lift\" is not in the configuration, expected one of left, right\n", drive.errors);
  const Ended interface = run({"--interface", "can0", "read", "left", "P105"});
  EXPECT_EQ(2, interface.code);
  EXPECT_EQ("nord_param: --interface does not fit the transport profibus_dp, expected --device\n", interface.errors);
  EXPECT_EQ(2, run({"read", "left"}).code);
  EXPECT_EQ(2, run({"read", "left", "P105", "--set", "5"}).code);
  EXPECT_EQ(2, run({}).code);
  const Ended timeout = run({"--timeout", "0", "read", "left", "P105"});
  EXPECT_EQ(2, timeout.code);
  EXPECT_THAT(timeout.errors, StartsWith("--timeout: 0 is not valid, expected more than 0 s\n"));
  const Ended unknown = run({"write", "left", "P210", "1"});
  EXPECT_EQ(2, unknown.code);
  EXPECT_THAT(unknown.errors, HasSubstr("write the raw value with --raw"));
}

// A script gives every command the same options; where nothing is asked --yes changes nothing.
TEST_F(NordParam, TakesJsonAndYesForEveryCommand) {
  const std::string scope = NORD_CONFIG_FOLDER "/../doc/pictures/scope.csv";
  const std::string config = NORD_CONFIG_FOLDER "/demo.yaml";
  const std::vector<std::vector<std::string>> commands{{"list"},
                                                       {"read", "left", "P105"},
                                                       {"write", "right", "P102", "2.5"},
                                                       {"dump", "left"},
                                                       {"compare", "left", "right"},
                                                       {"restore", "left", dump_},
                                                       {"watch", "left", "--once"},
                                                       {"scan"},
                                                       {"scope", "left", "--from", scope},
                                                       {"faults", "left"},
                                                       {"check", "left"},
                                                       {"check-config", config}};
  std::ofstream(dump_) << run({"dump", "left"}).output;
  for (std::vector<std::string> words : commands) {
    SCOPED_TRACE(words.front());
    words.insert(words.end(), {"--json", "--yes"});
    const Ended ended = run(words);
    EXPECT_NE(2, ended.code) << ended.errors;
    EXPECT_EQ('{', ended.output.empty() ? '?' : ended.output.front()) << ended.output;
  }
}

TEST_F(NordParam, NamesAFileThatIsMissing) {
  const Ended list = runProgram({NORD_PARAM_PROGRAM, "--config", "/tmp/is_not_there.yaml", "list"});
  EXPECT_EQ(2, list.code);
  EXPECT_EQ("nord_param: --config /tmp/is_not_there.yaml: there is no such file\n", list.errors);
  const Ended dump = run({"compare", "left", "/tmp/is_not_there.yaml"});
  EXPECT_EQ(2, dump.code);
  EXPECT_EQ("nord_param: /tmp/is_not_there.yaml: there is no such file\n", dump.errors);
}

TEST_F(NordParam, NamesAFolderThatIsNoFile) {
  const Ended list = runProgram({NORD_PARAM_PROGRAM, "--config", "/tmp", "list"});
  EXPECT_EQ(2, list.code);
  EXPECT_EQ("nord_param: --config /tmp: it is a folder\n", list.errors);
  const Ended compared = run({"compare", "left", "/tmp"});
  EXPECT_EQ(2, compared.code);
  EXPECT_EQ("nord_param: /tmp: it is a folder\n", compared.errors);
}

TEST_F(NordParam, NamesADeviceThatIsMissing) {
  const Ended read = run({"--timeout", "0.2", "read", "left", "P105"}, "/dev/is_not_there");
  EXPECT_EQ(1, read.code);
  EXPECT_THAT(read.errors, StartsWith("nord_param: /dev/is_not_there"));
}

// A driver that runs has the device: nothing of ours gets on the wire.
TEST_F(NordParam, LeavesADeviceInUseAlone) {
  const int driver = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_EQ(0, ::flock(driver, LOCK_EX | LOCK_NB));
  // At once: what would be waited for does not come.
  const Ended read = run({"--timeout", "1000", "read", "left", "P105"});
  EXPECT_EQ(1, read.code);
  EXPECT_EQ(
      "nord_param: " + device_ + " is in use by test_nord_param (process " + std::to_string(::getpid()) +
          "): end it first; or ask the driver while it runs: rosservice call /nord_driver/left/read_parameter, or "
          "write_parameter\n",
      read.errors);
  ::close(driver);
}

// Exit code 1, and a line for each setting that differs.
TEST_F(NordParam, DumpsAndCompares) {
  const Ended dump = run({"dump", "left"});
  ASSERT_EQ(0, dump.code) << dump.errors;
  EXPECT_THAT(dump.output,
              HasSubstr("  \"P105 set 1\": {raw: 500, value: 50, unit: \"Hz\", name: \"Maximum frequency\"}\n"));
  EXPECT_THAT(dump.output, Not(HasSubstr("P152")));
  std::ofstream(dump_) << dump.output;
  const Ended same = run({"compare", "left", dump_});
  EXPECT_EQ(0, same.code) << same.output << same.errors;
  EXPECT_THAT(same.output, StartsWith("0 of "));
  ASSERT_EQ(0, run({"write", "left", "P103", "1.5", "--set", "3"}).code);
  const Ended different = run({"compare", "left", dump_});
  EXPECT_EQ(1, different.code);
  EXPECT_THAT(different.output,
              StartsWith("P103 set 3 Deceleration time: 2.00 s in the file, 1.50 s in the drive\n1 of "));
}

/// One node on a CAN bus between processes.
class NordParamOnCan : public ::testing::Test {
 protected:
  NordParamOnCan() {
    std::ofstream(config_)
        << "transport: canopen\ncycle_rate: 100.0\nbus: {interface: \"" << interface_ << "\"}\n"
        << "drives: {left: {address: 3, series: sk5xxe, joint: l, gear_ratio: 20.0, pole_pairs: 2}}\n";
    simulator_ = std::make_unique<Program>(std::vector<std::string>{NORD_SIM_PROGRAM, "--config", config_});
    EXPECT_TRUE(simulator_->saysSomething(seconds{30})) << simulator_->errors();
  }
  ~NordParamOnCan() override {
    simulator_->signal(SIGTERM);
    EXPECT_EQ(0, simulator_->wait(seconds{30}));
    ::unlink(config_.c_str());
  }
  std::vector<std::string> command(std::vector<std::string> words) const {
    words.insert(words.begin(), {NORD_PARAM_PROGRAM, "--config", config_});
    return words;
  }
  Ended run(const std::vector<std::string>& words) const { return runProgram(command(words)); }

  std::string interface_ = "virtual:nord_param_" + std::to_string(::getpid());
  std::string config_ = ::testing::TempDir() + "nord_param_can_" + std::to_string(::getpid()) + ".yaml";
  std::unique_ptr<Program> simulator_;
};

// The end of a run leaves no fault and a bus that is free. The referee is not asked: it never saw the node reset,
// and the 0000 of the next run comes after valid words.
TEST_F(NordParamOnCan, ReadsAndWrites) {
  const Ended read = run({"read", "left", "P105"});
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ("P105 set 1 Maximum frequency = 50.0 Hz (raw 500)\n", read.output);
  const Ended written = run({"write", "left", "P102", "2.5"});
  EXPECT_EQ(0, written.code) << written.errors;
  EXPECT_THAT(written.output, StartsWith("P102 set 1 Acceleration time = 2.50 s (raw 250)"));
  EXPECT_EQ("P700[-01] Current error = 0.0 no fault (raw 0)\n", run({"read", "left", "P700[-01]"}).output);
}

// The file's own interface has no node.
TEST_F(NordParamOnCan, TakesTheInterfaceOfTheCommandLine) {
  const std::string other = config_ + "_other";
  std::ofstream(other) << "bus: {interface: \"virtual:nobody\"}\n";
  const std::vector<std::string> both{NORD_PARAM_PROGRAM, "--config", config_, "--config", other};
  const auto with = [&](const char* option, const std::string& value) {
    std::vector<std::string> words = both;
    words.insert(words.end(), {option, value, "read", "left", "P105"});
    return runProgram(words);
  };
  const Ended read = with("--interface", interface_);
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_EQ("P105 set 1 Maximum frequency = 50.0 Hz (raw 500)\n", read.output);
  EXPECT_EQ(read.output, with("--bus", interface_).output);
  const Ended device = with("--device", "/dev/ttyUSB0");
  EXPECT_EQ(2, device.code);
  EXPECT_EQ("nord_param: --device does not fit the transport canopen, expected --interface\n", device.errors);
  ::unlink(other.c_str());
}

/// What became of nord_param on a bus with a driver.
struct BesideADriver {
  int code = -2;
  std::string errors;
  std::vector<std::uint32_t> seen;  ///< identifiers, by the driver
};

BesideADriver readBesideADriver(const std::string& interface, const std::vector<std::string>& command) {
  BesideADriver end;
  link::CanSettings settings;
  settings.interface = interface;
  link::VirtualCan driver{settings};
  EXPECT_TRUE(driver.open()) << driver.lastError();
  Program reader{command};
  link::ReceivedCanFrame received;
  for (int i = 0; i < 6000 && end.code == -2; ++i) {
    driver.send(dataFrame(0x203, ByteView{FixedBytes<4>{0x7E, 0x04, 0x00, 0x00}}));
    end.code = reader.wait(seconds{0});
    driver.waitReadable(driver.now() + std::chrono::milliseconds{10});
    while (driver.receive(received)) end.seen.push_back(received.frame.id);
  }
  end.errors = reader.errors();
  return end;
}

// CAN locks nothing: a driver on the same interface is heard by its words. One that the machine keeps from talking for
// that long cannot be heard.
TEST_F(NordParamOnCan, LeavesABusInUseAlone) {
  constexpr std::chrono::duration<double> kLongestSilence{0.25};
  BesideADriver end;
  const auto attempt = [&] {
    end = readBesideADriver(interface_, command({"--timeout", "2", "read", "left", "P105"}));
  };
  tryAgainOnlyIfStoodStill(kLongestSilence, attempt, [&] { return end.code == 1; });
  EXPECT_EQ(1, end.code);
  EXPECT_THAT(end.errors, StartsWith("nord_param: the bus is in use: 203h was seen; "));
  EXPECT_THAT(end.seen, Each(0x703u)) << "only the node's own boot-up";
}

TEST_F(NordParam, TellsItsVersionAndWhatRestoreLeavesOut) {
  EXPECT_EQ(std::string("nord_param ") + kVersion + "\n", runProgram({NORD_PARAM_PROGRAM, "--version"}).output);
  const Ended help = runProgram({NORD_PARAM_PROGRAM, "--help"});
  EXPECT_EQ(0, help.code);
  EXPECT_THAT(help.output, HasSubstr("restore writes what a drive can lose without being lost itself"));
}

// In an InterBus ring behind a gateway, where the parameters go by Compact PCP.
TEST(NordParamOnAGateway, ShowsTheImageAndReadsParameters) {
  const std::string config = ::testing::TempDir() + "nord_param_gateway_" + std::to_string(::getpid()) + ".yaml";
  std::ofstream(config) << R"(
transport: interbus
bus: {outputs: {address: 100}, running: {address: 200}, watchdog: {address: 300, value: 500},
      pcp: {invoke: {address: 500}, result: {address: 600}}}
drives:
  left:  {address: 1, series: sk5xxe, joint: left_wheel_joint,  gear_ratio: 20.0, pole_pairs: 2}
  right: {address: 2, series: sk5xxe, joint: right_wheel_joint, gear_ratio: 20.0, pole_pairs: 2, parameters: {P105: 60.0}}
)";
  Program simulator({NORD_SIM_PROGRAM, "--config", config, "--bus", "127.0.0.1:0"});
  ASSERT_TRUE(simulator.saysSomething(seconds{30})) << simulator.errors();
  const std::string gateway = simulator.output().substr(0, simulator.output().find('\n'));
  EXPECT_THAT(gateway, StartsWith("127.0.0.1:")) << "a free port, printed";
  const auto run = [&](const std::vector<std::string>& words) {
    std::vector<std::string> command{NORD_PARAM_PROGRAM, "--config", config, "--bus", gateway, "--timeout", "20"};
    command.insert(command.end(), words.begin(), words.end());
    return runProgram(command);
  };
  const Ended image = run({"image", "--once"});
  EXPECT_EQ(0, image.code) << image.errors;
  EXPECT_THAT(image.output, HasSubstr("Inputs of " + gateway + ", function 4, registers 0 to 3; nothing is written\n"));
  EXPECT_THAT(image.output, HasSubstr("   right         actual value 1\n"));
  const Ended many = run({"image", "--once", "--json", "--count", "3"});
  EXPECT_THAT(many.output, HasSubstr("\"register\": 3")) << "up to the last word of a drive " << many.errors;
  const Ended read = run({"read", "right", "P105", "--set", "1"});
  EXPECT_EQ(0, read.code) << read.errors;
  EXPECT_THAT(read.output, HasSubstr("P105 set 1 Maximum frequency = 60.0 Hz (raw 600)"));
  EXPECT_EQ(0, run({"write", "right", "P105", "55", "--set", "1"}).code);
  EXPECT_THAT(run({"read", "left", "P105", "--set", "1"}).output, HasSubstr("= 50.0 Hz (raw 500)"));
  EXPECT_THAT(run({"read", "right", "P105", "--set", "1"}).output, HasSubstr("= 55.0 Hz (raw 550)"));
  EXPECT_THAT(run({"read", "left", "P999"}).errors, HasSubstr("refuses P999: PCP error 6/7"));
  simulator.signal(SIGTERM);
  EXPECT_EQ(0, simulator.wait(seconds{30}));
  EXPECT_THAT(simulator.output(), HasSubstr("referee: no rule broken"));
  ::unlink(config.c_str());
}

}  // namespace
}  // namespace nord_driver::test

// The simulated gateway, asked by Modbus clients nobody here has written: pymodbus and mbpoll, of Debian. The registers
// hold what BU 0070 7 says. Where a client is missing its test is skipped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>
#include <string>
#include <vector>

#include "sim/interbus/gateway_bus.h"
#include "tools/program.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GatewayClients : public ::testing::Test {
 protected:
  static sim::SimConfig ring() {
    sim::IbsBusConfig bus;
    bus.output_address = 100;
    bus.running = sim::IbsRunning{200, 1, 1};
    bus.watchdog = 300;
    sim::SimConfig config;
    config.bus = bus;
    for (std::uint8_t place = 1; place <= 2; ++place) {
      sim::DriveConfig drive;
      drive.name = place == 1 ? "left" : "right";
      drive.address = place;
      drive.parameters = {{102, 0, 0, 5}};  // 0.05 s to P105
      drive.motor.slip = 0.001;
      drive.bus = sim::IbsDriveConfig{};
      config.drives.push_back(drive);
    }
    return config;
  }
  std::string port() const { return bus_.where().substr(bus_.where().find(':') + 1); }
  Word status(std::size_t drive) {
    return bus_.withModel([&](sim::RobotSim& robot) { return robot.drive(drive).inverter().statusWord(); });
  }
  bool waitForStatus(Word word) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds{20};
    while (status(0) != word && std::chrono::steady_clock::now() < end) ::usleep(2000);
    return status(0) == word;
  }
  /// What the client says to each request, a line each.
  std::vector<std::string> ask(const std::vector<std::string>& requests) {
    std::vector<std::string> command{"/usr/bin/python3", NORD_DRIVER_PYMODBUS_CLIENT, port()};
    command.insert(command.end(), requests.begin(), requests.end());
    const Ended ended = runProgram(command);
    no_client_ = ended.code == 77;
    EXPECT_TRUE(ended.code == 0 || no_client_) << ended.errors;
    std::vector<std::string> lines;
    std::istringstream text(ended.output);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  sim::GatewayBus bus_{ring()};
  bool no_client_ = false;
};

// BU 0070 7.1, 7.2: 0B70, 047E, 0B31, 047F 2000, 0F37 (bit 10 is of a relay: 0B37).
TEST_F(GatewayClients, PymodbusMovesAnInverterByTheTelegramsOfTheManual) {
  ASSERT_TRUE(waitForStatus(0x0B70));
  const auto first = ask({"input:0:4", "holding:200:1", "write:100:047E,0000,0000,0000"});
  if (no_client_) GTEST_SKIP() << "python3-pymodbus is not installed, or older than 3.0";
  EXPECT_THAT(first, ElementsAre("0B70 0000 0B70 0000", "0001", "written"));
  ASSERT_TRUE(waitForStatus(0x0B31));
  EXPECT_THAT(ask({"input:0:4", "holding:100:4", "write:100:047F,2000"}),
              ElementsAre("0B31 0000 0B70 0000", "047E 0000 0000 0000", "written"));
  ASSERT_TRUE(waitForStatus(0x0B37));
  EXPECT_THAT(ask({"input:0:2", "both:0:4:102:047E,0000", "holding:100:4"}),
              ElementsAre("0B37 2000", "0B37 2000 0B70 0000", "047F 2000 047E 0000"));
}

TEST_F(GatewayClients, PymodbusUnderstandsItsWatchdogAndItsExceptions) {
  const auto said = ask({"write:300:01F4", "holding:300:1", "input:100:1", "write:104:0000"});
  if (no_client_) GTEST_SKIP() << "python3-pymodbus is not installed, or older than 3.0";
  EXPECT_THAT(said, ElementsAre("written", "01F4", "exception 2", "exception 2"));
}

// The command of doc/interbus.md, "How to find the offsets without moving anything".
TEST_F(GatewayClients, MbpollShowsTheImage) {
  if (::access("/usr/bin/mbpoll", X_OK) != 0) GTEST_SKIP() << "mbpoll is not installed";
  ASSERT_TRUE(waitForStatus(0x0B70));
  const Ended ended = runProgram({"/usr/bin/mbpoll", "-m", "tcp", "-a", "1", "-0", "-t", "3:hex", "-r", "0", "-c", "4",
                                  "-1", "-p", port(), "127.0.0.1"});
  EXPECT_EQ(0, ended.code) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("[0]: \t0x0B70\n[1]: \t0x0000\n[2]: \t0x0B70\n[3]: \t0x0000"));
}

}  // namespace
}  // namespace nord_driver::test

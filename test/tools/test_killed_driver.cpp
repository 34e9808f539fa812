// nord_param behind a driver that was killed with a turning wheel: the watchdog in the module still stops it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/profibus/dp_station.h"
#include "tools/linked_drive.h"

namespace nord_driver::tools {
namespace {

using sim::InverterState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

/// Of the bus of a LinkedDrive: what the killed driver was configured with, and nord_param is.
YAML::Node withWatchdog(double watchdog) {
  YAML::Node file = LinkedDrive::file();
  file["bus"]["watchdog"] = watchdog;
  return file;
}

/// What master 1 sends to station 3: its last telegram but for the answer.
class KilledDriver {
 public:
  explicit KilledDriver(LinkedDrive& drive) : drive_(drive) {}

  /// The left wheel turns with 25 Hz, and its module has a watchdog of so many tenths of a second.
  void leavesTheWheelTurning(std::uint8_t watchdog) {
    send(0x6D, 61, {0x88, watchdog, 10, 0x0B, 0x75, 0x31, 0x00});
    send(0x5D, 62, {0xF3, 0xF1});
    for (int i = 0; i < 10; ++i) exchange(0x7E, 0);
    for (int i = 0; i < 40; ++i) exchange(0x7F, 0x20);
    ASSERT_EQ(sim::SlaveState::kDataExchange, drive_.segment().station(0).state());
    ASSERT_EQ(InverterState::kOperationEnabled, drive_.left().inverter().state());
    ASSERT_DOUBLE_EQ(25.0, drive_.left().inverter().frequency());
  }

 private:
  void exchange(int control_low, int setpoint_high) {
    send(even_ ? 0x5D : 0x7D, std::nullopt, {0, 0, 0, 0, 0, 0, 0, 0, 0x04, control_low, setpoint_high, 0});
    even_ = !even_;
    drive_.segment().run(milliseconds{100});
  }
  void send(std::uint8_t function, std::optional<std::uint8_t> access_point, const std::vector<int>& data) {
    sim::Telegram request;
    request.destination = 3;
    request.source = 1;
    request.function = function;
    request.destination_sap = access_point;
    if (access_point) request.source_sap = 62;
    for (const int byte : data) request.data.push_back(static_cast<std::uint8_t>(byte));
    drive_.segment().station(0).handle(request);
  }

  LinkedDrive& drive_;
  bool even_ = false;
};

void expectTripped(LinkedDrive& drive) {
  EXPECT_EQ(1u, drive.segment().station(0).counters().watchdog_trips);
  EXPECT_NE(InverterState::kOperationEnabled, drive.left().inverter().state());
  EXPECT_DOUBLE_EQ(0.0, drive.left().inverter().frequency());
}

// Nothing is sent before the watchdog has run out: it was told to the module by the same file.
TEST(KilledDriver, ItsWatchdogRunsOutBeforeAnythingIsSent) {
  LinkedDrive drive{withWatchdog(2.0)};
  KilledDriver{drive}.leavesTheWheelTurning(20);
  EXPECT_EQ("", drive.trouble());
  expectTripped(drive);
  EXPECT_EQ(0x47Eu, drive.left().counters().last_control);
}

// The longest time there is to listen, longer than nord_param waits for an answer.
TEST(KilledDriver, ALongWatchdogIsWaitedFor) {
  LinkedDrive drive{withWatchdog(9.0)};
  KilledDriver{drive}.leavesTheWheelTurning(90);
  EXPECT_EQ("", drive.trouble());
  expectTripped(drive);
}

// That of another configuration: found running, it is told and not fed.
TEST(KilledDriver, AWatchdogThatStillRunsIsLeftToRunOut) {
  LinkedDrive drive{withWatchdog(0.2)};
  KilledDriver{drive}.leavesTheWheelTurning(40);
  EXPECT_THAT(drive.trouble(), HasSubstr("PROFIBUS station 3 (left) was left in data exchange by its master, and its "
                                         "watchdog runs: wait until that has run out"));
  expectTripped(drive);
}

}  // namespace
}  // namespace nord_driver::tools

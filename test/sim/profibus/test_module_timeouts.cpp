#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

const char* const kStandby = "047E 0000 047E 0000";
const char* const kDriving = "047F 2000 047F 2000";
const char* const kInvalid = "0000 0000 0000 0000";

SimConfig twoInverters(std::int32_t p151, std::int32_t p513 = 0) {
  SimConfig config = oneModule(2);
  for (DriveConfig& drive : config.drives) {
    ParameterPreset acknowledge_input;  // else 047F becoming 047E would acknowledge (BU 0020 8)
    acknowledge_input.number = 420;
    acknowledge_input.element = 2;
    acknowledge_input.raw = 12;
    drive.parameters.push_back(acknowledge_input);
    ParameterPreset telegram_timeout;
    telegram_timeout.number = 513;
    telegram_timeout.raw = p513;
    drive.parameters.push_back(telegram_timeout);
  }
  ModuleConfig module;
  module.settings.address = 8;
  ParameterPreset timeout;
  timeout.number = 151;
  timeout.raw = p151;
  module.parameters.push_back(timeout);
  config.bus.as<DpBusConfig>().modules.push_back(module);
  return config;
}

class DrivingModule {
 public:
  explicit DrivingModule(std::int32_t p151, unsigned watchdog_factor = 20, std::int32_t p513 = 0)
      : bus{twoInverters(p151, p513)} {
    bus.startUpModule({0x00, 0xF1, 0xF1}, watchdog_factor);
    bus.outputsFor(kStandby, milliseconds(20));
    bus.outputsFor(kDriving, seconds(2.0));
  }
  InverterModel& inverter(std::size_t place) { return bus.segment.drive(place).inverter(); }
  ModuleStation& module() { return bus.segment.stations().module(0); }

  Conversation bus;
};

enum class Cause { kInvalidControlWords, kMasterLost, kLinkInterrupted };

struct Row {
  std::int32_t p151;  // ms
  std::int32_t p513;  // 0.1 s
  Cause cause;
  std::uint16_t fault;  // 0: "frequency inverter continues operation"
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << "P151 " << row.p151 << ", P513 " << row.p513 << ", cause " << static_cast<int>(row.cause);
}

class ModuleTimeoutTable : public ::testing::TestWithParam<Row> {};

// BU 2700 7.1.1, the table of settings and causes, each row with both settings it prints, for P151 in the module; the
// link is watched by P120 in the inverter (8.1), which says E10.9 (8.3).
TEST_P(ModuleTimeoutTable, OverTheBus) {
  const Row row = GetParam();
  DrivingModule driving{row.p151, 20, row.p513};
  ASSERT_EQ(25.0, driving.inverter(0).frequency());
  switch (row.cause) {
    case Cause::kInvalidControlWords:
      driving.bus.outputsFor(kInvalid, seconds(0.95));
      EXPECT_EQ(25.0, driving.inverter(0).frequency());
      driving.bus.outputsFor(kInvalid, seconds(2.0));
      break;
    case Cause::kMasterLost:
      driving.bus.segment.run(seconds(3.0));
      EXPECT_EQ(SlaveState::kWaitParameters, driving.module().state());
      break;
    case Cause::kLinkInterrupted:
      driving.module().setInverterLink(false);
      EXPECT_EQ("00 00 00 00 00 00 00 00", driving.bus.outputsFor(kDriving, seconds(3.0)));
      break;
  }
  for (std::size_t place : {0u, 1u}) {
    EXPECT_EQ(row.fault, driving.inverter(place).faultNumber());
    EXPECT_EQ(row.fault == 0 ? 25.0 : 0.0, driving.inverter(place).frequency());
    EXPECT_EQ(row.fault == 0 ? InverterState::kOperationEnabled : InverterState::kFault,
              driving.inverter(place).state());
  }
}

INSTANTIATE_TEST_SUITE_P(Bu2700, ModuleTimeoutTable,
                         ::testing::Values(Row{-1, -1, Cause::kInvalidControlWords, 0},
                                           Row{-1, -1, Cause::kMasterLost, 0}, Row{-1, -1, Cause::kLinkInterrupted, 0},
                                           Row{0, 0, Cause::kInvalidControlWords, 0},
                                           Row{0, 0, Cause::kMasterLost, 102}, Row{0, 0, Cause::kLinkInterrupted, 109},
                                           Row{1000, 10, Cause::kInvalidControlWords, 103},
                                           Row{1000, 10, Cause::kMasterLost, 102},
                                           Row{1000, 10, Cause::kLinkInterrupted, 109}));

// P120[-01] = 0: the inverter does not watch the system bus and goes on.
TEST(ModuleTimeout, LinkIsNotWatchedWithoutP120) {
  DrivingModule driving{0};
  driving.bus.segment.drive(0).parameters().preset(120, 0, 0, 0);
  driving.module().setInverterLink(0, false);
  driving.bus.outputsFor(kDriving, seconds(1.0));
  EXPECT_EQ(0, driving.inverter(0).faultNumber());
  EXPECT_EQ(25.0, driving.inverter(0).frequency());
  EXPECT_EQ(0, driving.inverter(1).faultNumber());
}

// The module without its 24 V is a missing module: E10.9.
TEST(ModuleTimeout, ModuleWithoutSupplyIsMissing) {
  DrivingModule driving{0};
  driving.module().setPowered(false);
  driving.bus.segment.run(milliseconds(20));
  EXPECT_EQ(109, driving.inverter(0).faultNumber());
  EXPECT_EQ(109, driving.inverter(1).faultNumber());
}

// One valid control word is enough: P151 fires when all of them are invalid (BU 0220 4.2.3.2).
TEST(ModuleTimeout, OneValidControlWordIsEnough) {
  DrivingModule driving{500};
  driving.bus.outputsFor("0000 0000 047F 2000", seconds(3.0));
  EXPECT_EQ(0, driving.inverter(0).faultNumber());
  EXPECT_EQ(25.0, driving.inverter(0).frequency());
}

// A word for an inverter that is off is a word, too: the module looks at what its master sends, not at who would take
// it.
TEST(ModuleTimeout, ControlWordsOfAbsentInvertersCountToo) {
  DrivingModule driving{200};
  for (const std::size_t place : {0u, 1u}) driving.bus.segment.drive(place).setInverterPower(false);
  driving.bus.outputsFor(kStandby, seconds(1.0));
  EXPECT_FALSE(driving.module().timedOut());
  driving.bus.outputsFor("0000 0000 047E 0000", seconds(1.0));
  EXPECT_FALSE(driving.module().timedOut());
  driving.bus.outputsFor(kInvalid, milliseconds(300));
  EXPECT_TRUE(driving.module().timedOut());
  EXPECT_EQ(1020, driving.module().parameters().value(170, 0, 0));
  EXPECT_EQ(0x0F0A, driving.module().parameters().value(173));  // both lost or switched off, time-out, operational
}

// Behind this module it is P151 that counts, not P513 of the inverter (BU 2700 8.1).
TEST(ModuleTimeout, P513DoesNotCount) {
  DrivingModule driving{0};
  driving.bus.segment.drive(0).parameters().preset(513, 0, 0, 5);
  driving.bus.outputsFor(kInvalid, seconds(2.0));
  EXPECT_EQ(0, driving.inverter(0).faultNumber());
  EXPECT_EQ(25.0, driving.inverter(0).frequency());
}

// P151 begins with the first valid telegram, not before.
TEST(ModuleTimeout, BeginsWithTheFirstValidTelegram) {
  Conversation bus{twoInverters(100)};
  bus.startUpModule({0x00, 0xF1, 0xF1});
  bus.outputsFor(kInvalid, seconds(2.0));
  EXPECT_EQ(0, bus.drive().inverter().faultNumber());
  bus.outputs(kStandby);
  bus.outputsFor(kInvalid, milliseconds(150));
  EXPECT_EQ(103, bus.drive().inverter().faultNumber());
}

// The module stays in its time-out until every inverter is acknowledged: until then the one that is cannot be switched
// on, and the outputs are off (BU 0220 4.2.3.2).
TEST(ModuleTimeout, LocksUntilEveryInverterIsAcknowledged) {
  DrivingModule driving{200};
  Conversation& bus = driving.bus;
  bus.outputsFor(kInvalid, milliseconds(300));
  ASSERT_EQ(103, driving.inverter(0).faultNumber());
  ASSERT_EQ(103, driving.inverter(1).faultNumber());
  EXPECT_TRUE(driving.module().timedOut());
  EXPECT_EQ(1020, driving.module().parameters().value(170, 0, 0));
  EXPECT_EQ(0x0A0A, driving.module().parameters().value(173));  // FI1 and FI2 online, time-out, operational

  EXPECT_EQ("0B 31 00 00 0B 38 00 00", bus.outputsFor("04FE 0000 047E 0000", milliseconds(20)));
  EXPECT_EQ("0B 31 00 00 0B 38 00 00", bus.outputsFor("047E 0000 047E 0000", milliseconds(20)));
  EXPECT_EQ("0B 31 00 00 0B 38 00 00", bus.outputsFor("047F 2000 047E 0000", seconds(1.0)));
  EXPECT_EQ(0.0, driving.inverter(0).frequency());
  EXPECT_TRUE(driving.module().timedOut());

  EXPECT_EQ("0B 31 00 00 0B 31 00 00", bus.outputsFor("047E 0000 04FE 0000", milliseconds(20)));
  EXPECT_FALSE(driving.module().timedOut());
  EXPECT_EQ(0, driving.module().parameters().value(170, 0, 0));
  EXPECT_EQ(1020, driving.module().parameters().value(170, 0, 1));
  EXPECT_EQ("0B 37 20 00 0B 31 00 00", bus.outputsFor("047F 2000 047E 0000", seconds(2.0)));
}

// The same after the PROFIBUS watchdog; an inverter that was switched off meanwhile has nothing to acknowledge.
TEST(ModuleTimeout, LocksAfterTheWatchdogToo) {
  DrivingModule driving{0, 10};
  driving.bus.segment.run(milliseconds(200));
  ASSERT_EQ(102, driving.inverter(0).faultNumber());
  EXPECT_EQ(5020, driving.module().parameters().value(170, 0, 0));
  EXPECT_EQ(0x0A05, driving.module().parameters().value(173));
  driving.bus.startUpModule({0x00, 0xF1, 0xF1});
  driving.bus.outputsFor("04FE 0000 047E 0000", milliseconds(20));
  EXPECT_TRUE(driving.module().timedOut());
  driving.bus.segment.drive(1).setInverterPower(false);
  driving.bus.outputsFor("047E 0000 0000 0000", milliseconds(20));
  EXPECT_FALSE(driving.module().timedOut());
  EXPECT_EQ(0x0E02, driving.module().parameters().value(173));  // FI2 lost or switched off
}

// The counters of a drive behind a module are its own.
TEST(ModuleTimeout, EveryDriveHasItsOwnCounters) {
  DrivingModule driving{0, 10};
  driving.bus.outputs("047F 2000 047E 1000");
  driving.bus.segment.run(milliseconds(200));
  EXPECT_EQ(0x047F, driving.bus.segment.drive(0).counters().control_before_loss);
  EXPECT_EQ(0x047E, driving.bus.segment.drive(1).counters().control_before_loss);
  EXPECT_EQ(0x0B37, driving.bus.segment.drive(0).counters().status_at_loss);
  EXPECT_EQ(1u, driving.bus.segment.drive(1).counters().watchdog_trips);
}

}  // namespace
}  // namespace nord_driver::sim

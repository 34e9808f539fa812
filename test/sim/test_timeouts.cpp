#include <gtest/gtest.h>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

enum class Cause { kInvalidControlWord, kMasterLost, kLinkInterrupted };

struct Row {
  double p513;  // s
  Cause cause;
  std::uint16_t fault;  // 0: "frequency inverter continues operation"
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << "P513 " << row.p513 << ", cause " << static_cast<int>(row.cause);
}

class TimeoutTable : public ::testing::TestWithParam<Row> {};

// BU 2700 7.1.1, the table of settings and causes, as a master sees it over the bus; P513 for the SK TU3 (8.1).
TEST_P(TimeoutTable, OverTheBus) {
  const Row row = GetParam();
  SimConfig config = oneDrive();
  // An input with function 12: else the fault would be acknowledged by 047F becoming 047E (BU 0020 8).
  for (const auto& [number, raw] :
       {std::pair<std::uint16_t, std::int32_t>{420, 12}, {513, static_cast<std::int32_t>(row.p513 * 10.0)}}) {
    ParameterPreset preset;
    preset.number = number;
    preset.raw = raw;
    config.drives[0].parameters.push_back(preset);
  }
  Conversation bus{config};
  bus.startUp(20);  // watchdog 0.2 s
  bus.pzdFor("047E 0000", milliseconds(20));
  ASSERT_EQ("0B 37 20 00", bus.pzdFor("047F 2000", seconds(2.0)));
  const InverterModel& inverter = bus.drive().inverter();

  switch (row.cause) {
    case Cause::kInvalidControlWord:
      bus.pzdFor("0000 0000", seconds(0.95));
      EXPECT_EQ(25.0, inverter.frequency());
      bus.pzdFor("0000 0000", seconds(2.0));
      break;
    case Cause::kMasterLost:
      bus.segment.run(seconds(3.0));
      EXPECT_EQ(SlaveState::kWaitParameters, bus.station().state());
      break;
    case Cause::kLinkInterrupted:
      bus.station().setInverterLink(false);
      EXPECT_EQ("00 00 00 00", bus.pzdFor("047F 2000", seconds(3.0)));
      break;
  }
  EXPECT_EQ(row.fault, inverter.faultNumber());
  EXPECT_EQ(row.fault, bus.drive().parameters().value(700));
  if (row.fault == 0) {
    EXPECT_EQ(25.0, inverter.frequency());
    return;
  }
  EXPECT_EQ(InverterState::kFault, inverter.state());
  EXPECT_EQ(0.0, inverter.frequency());

  // The cause is gone with the next good telegram; an edge of bit 7 acknowledges, 047E is ready to be switched on.
  bus.station().setInverterLink(true);
  if (row.cause == Cause::kMasterLost) bus.startUp(20);
  EXPECT_EQ("0B 38 00 00", bus.pzdFor("047E 0000", milliseconds(10)));
  EXPECT_EQ("0B 31 00 00", bus.pzdFor("04FE 0000", milliseconds(10)));
}

INSTANTIATE_TEST_SUITE_P(Bu2700, TimeoutTable,
                         ::testing::Values(Row{-0.1, Cause::kInvalidControlWord, 0}, Row{-0.1, Cause::kMasterLost, 0},
                                           Row{-0.1, Cause::kLinkInterrupted, 0}, Row{0, Cause::kInvalidControlWord, 0},
                                           Row{0, Cause::kMasterLost, 102}, Row{0, Cause::kLinkInterrupted, 108},
                                           Row{1, Cause::kInvalidControlWord, 103}, Row{1, Cause::kMasterLost, 102},
                                           Row{1, Cause::kLinkInterrupted, 108}));

// Held up by the machine: the wheel turns on, along its ramp as well, and nobody is to blame for the silence.
TEST(RunOnUnheard, TheWheelTurnsOnAndNothingTimesOut) {
  SimConfig config = oneDrive();
  ParameterPreset preset;
  preset.number = 513;
  preset.raw = 10;  // 1 s
  config.drives[0].parameters.push_back(preset);
  Conversation bus{config};
  bus.startUp(20);  // watchdog 0.2 s
  bus.pzdFor("047E 0000", milliseconds(20));
  bus.pzdFor("047F 2000", seconds(3.0));
  const InverterModel& inverter = bus.drive().inverter();
  ASSERT_EQ(25.0, inverter.frequency());
  const double before = bus.drive().wheelAngle();
  const double speed = bus.drive().wheelSpeed();
  ASSERT_GT(speed, 1.0);

  bus.segment.robot().runOnUnheard(seconds(3.0));
  EXPECT_NEAR(before + 3.0 * speed, bus.drive().wheelAngle(), 0.01 * speed);
  EXPECT_EQ(25.0, inverter.frequency());
  EXPECT_EQ(0, inverter.faultNumber());
  EXPECT_EQ("0B 37 20 00", bus.pzdFor("047F 2000", milliseconds(20))) << "the watchdog has not run out";

  bus.pzdFor("047F 0000", milliseconds(20));
  bus.segment.robot().runOnUnheard(seconds(3.0));
  EXPECT_EQ(0.0, inverter.frequency()) << "a ramp goes on";
  bus.pzdFor("0000 0000", seconds(1.1));
  EXPECT_EQ(103, inverter.faultNumber()) << "what is silent afterwards times out";
}

}  // namespace
}  // namespace nord_driver::sim

#include "sim/inverter/inverter_fixture.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

// A fault passes "reaction active" (0F) to "fault" (08); the voltage is off and the wheel coasts.
TEST_F(Inverter, FaultCoasts) {
  enable();
  const double speed = motor.speed();
  model.trip(30, false);
  EXPECT_EQ("0B3F", status());
  model.advance(milliseconds(10));
  EXPECT_EQ("0B38", status());
  EXPECT_EQ(30, parameters.value(700, 0, 0));
  EXPECT_EQ(30, parameters.value(701, 0, 0));
  EXPECT_GT(motor.speed(), 0.9 * speed);
}

// Acknowledge: on the 0 -> 1 edge of bit 7, and only when the cause is gone.
TEST_F(Inverter, AcknowledgesOnTheEdge) {
  send(0x04FE);
  model.trip(21, true);
  model.advance(milliseconds(10));
  send(0x04FE);
  EXPECT_EQ("0B38", status());  // no edge
  send(0x047E);
  send(0x04FE);
  EXPECT_EQ("0B38", status());  // the cause stands
  model.clearCause();
  hold(0x04FE, 0, 0.1);
  EXPECT_EQ("0B38", status());  // no new edge
  send(0x047E);
  send(0x04FE);
  EXPECT_EQ(InverterState::kReadyToSwitchOn, model.state());
  EXPECT_EQ(0, parameters.value(700, 0, 0));
}

// Taking the enable away acknowledges, unless an input has function 12 (BU 0020 8).
TEST_F(Inverter, DroppingTheEnableAcknowledges) {
  enable();
  model.trip(21, false);
  model.advance(milliseconds(10));
  send(0x047F, 0x2000);
  EXPECT_EQ("0B38", status());
  send(0x047E);
  EXPECT_EQ("0B31", status());

  parameters.preset(423, 0, 0, 12);
  enable();
  model.trip(21, false);
  model.advance(milliseconds(10));
  send(0x047E);
  EXPECT_EQ("0B38", status());
}

// P506 acknowledges by itself, as often as it says.
TEST_F(Inverter, AcknowledgesByItself) {
  parameters.preset(506, 0, 0, 1);
  model.trip(21, false);
  model.advance(milliseconds(90));
  EXPECT_EQ("0B38", status());
  model.advance(milliseconds(20));
  EXPECT_EQ("0B70", status());
  model.trip(21, false);
  model.advance(milliseconds(200));
  EXPECT_EQ("0B38", status());
}

// A warning switches nothing off; it ends with its reason, or with a fault (BU 0020 8).
TEST_F(Inverter, Warns) {
  enable();
  model.setWarning(21);
  EXPECT_EQ("0BB7", status());
  EXPECT_EQ(21, parameters.value(700, 0, 1));
  model.setWarning(0);
  EXPECT_EQ("0B37", status());
  model.setWarning(21);
  model.trip(30, false);
  model.advance(milliseconds(10));
  EXPECT_EQ("0B38", status());
  EXPECT_EQ(0, parameters.value(700, 0, 1));
}

// The last five faults stand in P701, newest first, through mains off too.
TEST_F(Inverter, RemembersTheLastFiveFaults) {
  for (std::uint16_t number = 10; number <= 60; number = static_cast<std::uint16_t>(number + 10)) {
    model.trip(number, false);
    model.advance(milliseconds(10));
    EXPECT_TRUE(model.acknowledge());
  }
  model.setPowered(false);
  model.setPowered(true);
  for (unsigned i = 0; i < 5; ++i) EXPECT_EQ(60 - 10 * static_cast<int>(i), parameters.value(701, 0, i));
  EXPECT_EQ(0, parameters.value(700, 0, 0));
  EXPECT_EQ(0u, parameters.eepromWrites());
}

// The keypad or an input with function 12 acknowledges without the bus, and no more than the bus while the cause
// stands.
TEST_F(Inverter, IsAcknowledgedAtTheDevice) {
  model.trip(21, true);
  model.advance(milliseconds(10));
  EXPECT_FALSE(model.acknowledge());
  model.clearCause();
  EXPECT_TRUE(model.acknowledge());
  EXPECT_EQ("0B70", status());
}

struct ModuleCase {
  int p120;
  bool present_at_start;
  std::uint16_t fault;
};

// Behind a bus module on the system bus P120[-01] watches the link: 0 never, 1 once it was there, 2 from mains on,
// where the inverter waits for five seconds in "not ready" (BU 2700 8.1, BU 0280 5.1.1).
TEST(InverterOnTheSystemBus, WatchesItsModuleByP120) {
  for (const ModuleCase& row : {ModuleCase{0, true, 0}, ModuleCase{0, false, 0}, ModuleCase{1, true, 109},
                                ModuleCase{1, false, 0}, ModuleCase{2, true, 109}, ModuleCase{2, false, 109}}) {
    ParameterStore parameters;
    parameters.preset(509, 0, 0, 4);
    parameters.preset(120, 0, 0, row.p120);
    Motor motor{MotorSettings{}};
    BusWiring wiring;
    wiring.on_system_bus = true;
    InverterModel model{parameters, motor};
    model.wire(wiring);
    model.setModuleLink(row.present_at_start);
    model.setPowered(true);
    model.advance(seconds(4.9));
    EXPECT_EQ(0, model.faultNumber());
    EXPECT_EQ(row.p120 == 2 && !row.present_at_start, model.state() == InverterState::kNotReadyToSwitchOn);
    model.setModuleLink(false);
    model.advance(seconds(0.2));
    EXPECT_EQ(row.fault, model.faultNumber()) << "P120 " << row.p120 << ", present " << row.present_at_start;
    EXPECT_FALSE(row.fault != 0 && model.acknowledge());
    model.setModuleLink(true);
    EXPECT_EQ(row.fault != 0, model.acknowledge());
  }
}

struct TimeoutCase {
  int p513;               // raw, 0.1 s
  std::uint16_t invalid;  // fault after the control word became invalid
  std::uint16_t lost;     // fault after the master was lost
  std::uint16_t interrupted;
};

// The table of BU 2700 7.1.1: settings x causes.
TEST_F(Inverter, TimeoutTable) {
  for (const TimeoutCase& row :
       {TimeoutCase{-1, 0, 0, 0}, TimeoutCase{0, 0, 102, 108}, TimeoutCase{10, 103, 102, 108}}) {
    for (int cause = 0; cause < 3; ++cause) {
      model.setModuleLink(true);
      model.setPowered(false);
      parameters.preset(513, 0, 0, row.p513);
      model.setPowered(true);
      model.advance(milliseconds(301));
      enable();
      ASSERT_EQ("0B37", status());
      std::uint16_t expected = row.invalid;
      if (cause == 0) {
        hold(0x0000, 0, 0.9);
        EXPECT_EQ(0, model.faultNumber());
        hold(0x0000, 0, 0.2);
      } else if (cause == 1) {
        expected = row.lost;
        model.masterLost();
      } else {
        expected = row.interrupted;
        model.setModuleLink(false);
      }
      model.advance(milliseconds(20));
      EXPECT_EQ(expected, model.faultNumber()) << "P513 raw " << row.p513 << ", cause " << cause;
      EXPECT_EQ(expected == 0 ? "0B37" : "0B38", status());
      model.advance(milliseconds(500));
      EXPECT_EQ(expected == 0, model.frequency() == 25.0);
    }
  }
}

// E10.3 of SK 300E, 700E and 750E is a system error of the option; P513 is E10.0 (BU 0020 8.1), whatever the bus.
TEST(InverterOfAnOlderSeries, ShowsP513AsABusTimeout) {
  for (const Series series : {Series::kSk300e, Series::kSk700e, Series::kSk750e}) {
    ParameterStore parameters{Device{series, 2.0}};
    parameters.preset(509, 0, 0, 10);
    parameters.preset(513, 0, 0, 10);
    Motor motor{MotorSettings{}};
    InverterModel model{parameters, motor};
    model.setPowered(true);
    model.advance(milliseconds(301));
    ProcessData data;
    data.control = 0x047E;
    model.receive(data);
    model.advance(milliseconds(990));
    EXPECT_EQ(0, model.faultNumber());
    model.advance(milliseconds(20));
    EXPECT_EQ(100, model.faultNumber());
  }
}

}  // namespace
}  // namespace nord_driver::sim

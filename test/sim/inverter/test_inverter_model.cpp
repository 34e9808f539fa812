#include "sim/inverter/inverter_fixture.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

// After mains on: not ready until the charging relay has engaged, then switch-on disabled.
TEST_F(Inverter, ChargesFirst) {
  model.setPowered(false);
  model.setPowered(true);
  model.advance(milliseconds(299));
  EXPECT_EQ("0B30", status());
  model.advance(milliseconds(2));
  EXPECT_EQ("0B70", status());
}

// The words of BU 0020 9.1 and 9.2.
TEST_F(Inverter, AnswersWithTheManualsWords) {
  EXPECT_EQ("0B70", status());
  send(0x047E);
  EXPECT_EQ("0B31", status());
  send(0x047F, 0x2000);
  EXPECT_EQ("0A37", status());  // on its way: setpoint not reached
  hold(0x047F, 0x2000, 2.0);
  EXPECT_EQ("0B37", status());
  EXPECT_EQ(0x2000, model.actualValue(0));
  EXPECT_DOUBLE_EQ(25.0, model.frequency());
}

// "Switch-on disabled" is left by the shut-down command only (BU 2700 6.4.3 B).
TEST_F(Inverter, NeedsShutDownFirst) {
  hold(0x047F, 0x2000, 0.1);
  EXPECT_EQ("0B70", status());
}

// "Operation enabled" needs bits 0-6 (BU 2700 6.4.3 no. 4).
TEST_F(Inverter, NeedsAllSevenBits) {
  send(0x047E);
  for (const int missing : {0x0010, 0x0020, 0x0040}) {
    send(static_cast<Word>(0x047F & ~missing));
    EXPECT_EQ(InverterState::kSwitchedOn, model.state());
  }
  EXPECT_EQ("0B33", status());
  send(0x047F);
  EXPECT_EQ(InverterState::kOperationEnabled, model.state());
}

// Trap of every NORD drive: zeros do not stop it (BU 2700 7.1.1, P513 = 0).
TEST_F(Inverter, RunsOnWhenTheMasterSendsZeros) {
  enable();
  hold(0x0000, 0x0000, 10.0);
  EXPECT_EQ("0B37", status());
  EXPECT_DOUBLE_EQ(25.0, model.frequency());
}

// OFF1 brakes on the ramp P103, stays "operation enabled" until f = 0, then "ready to switch on".
TEST_F(Inverter, Off1BrakesToReady) {
  enable();
  hold(0x047E, 0, 0.5);
  EXPECT_EQ(InverterState::kOperationEnabled, model.state());
  EXPECT_NEAR(12.5, model.frequency(), 0.2);
  hold(0x047E, 0, 0.6);
  EXPECT_EQ("0B31", status());
}

// OFF1 is no latch: bits 0 and 3 during the ramp run the motor up again.
TEST_F(Inverter, Off1CanBeTakenBack) {
  enable();
  hold(0x047E, 0, 0.5);
  hold(0x047F, 0x2000, 2.0);
  EXPECT_EQ("0B37", status());
}

// OFF2 takes the voltage away at once; the wheel coasts.
TEST_F(Inverter, Off2Coasts) {
  enable();
  const double speed = motor.speed();
  send(0x047D);
  EXPECT_EQ("0B60", status());
  EXPECT_EQ(0.0, model.frequency());
  EXPECT_GT(motor.speed(), 0.95 * speed);
}

// OFF3 brakes on P426 and ends in "switch-on disabled" by itself; taking it back does not help.
TEST_F(Inverter, Off3StopsAndDisables) {
  parameters.preset(426, 0, 0, 100);  // 1.00 s from 50 Hz
  enable();
  hold(0x047B, 0x2000, 0.25);
  EXPECT_EQ("0A17", status());
  EXPECT_NEAR(12.5, model.frequency(), 0.3);
  hold(0x047F, 0x2000, 0.2);
  EXPECT_EQ("0A17", status());
  hold(0x047F, 0x2000, 0.2);
  EXPECT_EQ("0B70", status());
}

// Priority: bits 1 and 2 cleared together are OFF2 (BU 2700 6.4.1).
TEST_F(Inverter, Off2BeatsOff3) {
  enable();
  ProcessData both;
  both.control = 0x0479;
  model.receive(both);
  model.advance(milliseconds(1));  // at once: not by way of the quick stop
  EXPECT_EQ(InverterState::kSwitchOnDisabled, model.state());
  EXPECT_EQ(0.0, model.frequency());
  EXPECT_GT(motor.speed(), 50.0);
}

// Bit 3 = 0 blocks the voltage and falls back to "switched on" (BU 2700 6.4.3 no. 5).
TEST_F(Inverter, DisableOperationCoastsToSwitchedOn) {
  enable();
  send(0x0477);
  EXPECT_EQ("0B33", status());
  EXPECT_GT(motor.speed(), 50.0);
}

// Bit 4 = 0: quick stop ramp, stays enabled. Bit 5 = 0: the frequency is held. Bit 6 = 0: setpoint zero on the ramp.
TEST_F(Inverter, RampAndSetpointBits) {
  enable();
  hold(0x045F, 0x4000, 1.0);
  EXPECT_DOUBLE_EQ(25.0, model.frequency());
  hold(0x046F, 0x2000, 0.1);
  EXPECT_EQ(InverterState::kOperationEnabled, model.state());
  EXPECT_DOUBLE_EQ(0.0, model.frequency());
  hold(0x047F, 0x2000, 2.0);
  hold(0x043F, 0x2000, 0.5);
  EXPECT_NEAR(12.5, model.frequency(), 0.2);
}

// The setpoint is a share of P105, cut at 100 %.
TEST_F(Inverter, SaturatesTheSetpoint) {
  enable(0x7FFF, 3.0);
  EXPECT_DOUBLE_EQ(50.0, model.frequency());
  EXPECT_EQ(0x4000, model.actualValue(0));
}

// A negative setpoint turns left: C000h is -100 %.
TEST_F(Inverter, NegativeSetpointTurnsLeft) {
  enable(0xC000, 3.0);
  EXPECT_DOUBLE_EQ(-50.0, model.frequency());
  EXPECT_EQ(0xC000, model.actualValue(0));
  EXPECT_EQ("1337", status());
  EXPECT_LT(motor.speed(), -100.0);
}

// A reversal passes through zero with both ramps.
TEST_F(Inverter, ReversesThroughZero) {
  enable(0x2000);
  hold(0x047F, 0xE000, 1.0);
  EXPECT_NEAR(0.0, model.frequency(), 0.3);
  hold(0x047F, 0xE000, 1.1);
  EXPECT_DOUBLE_EQ(-25.0, model.frequency());
}

// P104 > 0: the motor turns at setpoint zero; OFF1 still stops it.
TEST_F(Inverter, MinimumFrequencyTurnsAtSetpointZero) {
  parameters.preset(104, 0, 0, 50);
  enable(0x0000);
  EXPECT_DOUBLE_EQ(5.0, model.frequency());
  hold(0x047E, 0, 1.0);
  EXPECT_EQ("0B31", status());
}

// Switching the set while turning acts at once: other P105, other speed for the same setpoint, other share in IW1.
TEST_F(Inverter, SetSwitchWhileTurningIsAStep) {
  parameters.preset(105, 1, 0, 1000);  // 100 Hz
  parameters.preset(102, 1, 0, 0);     // and no ramp
  enable();
  EXPECT_DOUBLE_EQ(25.0, model.frequency());
  send(0x447F, 0x2000);
  EXPECT_DOUBLE_EQ(50.0, model.frequency());
  EXPECT_EQ(0x2000, model.actualValue(0));
  EXPECT_EQ("4B37", status());
  EXPECT_EQ(1u, model.setSwitches());
}

// An idle word for set 1 switches a drive that turns in set 3 (the trap of a restarted master).
TEST_F(Inverter, IdleWordSwitchesTheSet) {
  send(0x847E);
  hold(0x847F, 0x2000, 2.0);
  EXPECT_EQ("8B37", status());
  send(0x047E);
  EXPECT_EQ(0u, model.parameterSet());
}

// Local control: status bit 9 = 0, the terminals decide; back on the bus a standing 047F acts at once.
TEST_F(Inverter, LocalControl) {
  enable();
  model.setLocalControl(true);
  model.advance(seconds(2.0));
  EXPECT_EQ("0931", status());
  model.setLocalControl(false);
  model.advance(seconds(2.0));
  EXPECT_EQ("0B37", status());
  model.setLocalControl(true, -10.0);
  model.advance(seconds(3.0));
  EXPECT_DOUBLE_EQ(-10.0, model.frequency());
}

// Trap: a standing 047F with its setpoint acts at once when "remote control" comes back (BU 0220 5.1.2).
TEST_F(Inverter, StandingCommandActsWhenTheBusReturns) {
  enable();
  model.setLocalControl(true);
  model.advance(seconds(2.0));
  EXPECT_EQ(InverterState::kReadyToSwitchOn, model.state());
  model.setLocalControl(false);
  model.advance(milliseconds(10));  // nothing new from the bus
  EXPECT_EQ(InverterState::kOperationEnabled, model.state());
  EXPECT_GT(model.frequency(), 0.0);
}

// Terminals may stop a drive that the bus controls (BU 0020 6, note): coasting, or the quick stop ramp.
TEST_F(Inverter, TerminalsStopUnderBusControl) {
  Terminals low;
  low.coast = true;
  model.setTerminals(low);
  EXPECT_EQ("0B60", status());  // before any word of the bus
  model.setTerminals(Terminals{});
  enable();
  model.setTerminals(low);
  hold(0x047F, 0x2000, 0.01);
  EXPECT_EQ("0B60", status());
  EXPECT_GT(motor.speed(), 50.0);
  EXPECT_EQ(block::kVoltageByTerminals, parameters.value(700, 0, 2));
  model.setTerminals(Terminals{});
  hold(0x047F, 0x2000, 0.1);
  EXPECT_EQ("0B70", status());  // a standing enable does not start it
  EXPECT_EQ(block::kStandingEnable, parameters.value(700, 0, 2));

  parameters.preset(426, 0, 0, 100);
  enable();
  low.coast = false;
  low.quick_stop = true;
  model.setTerminals(low);
  hold(0x047F, 0x2000, 0.25);
  EXPECT_EQ("0A17", status());
  hold(0x047F, 0x2000, 0.5);
  EXPECT_EQ("0B50", status());
  EXPECT_EQ(block::kQuickStopByTerminals, parameters.value(700, 0, 2));
}

// Bits 14 and 15 of the status word are the set that is active (BU 2700 6.4.2), whoever has chosen it.
TEST_F(Inverter, TerminalsChooseTheParameterSetUnderLocalControl) {
  Terminals third;
  third.parameter_set = 2;
  model.setTerminals(third);
  hold(0x047E, 0, 0.1);
  EXPECT_EQ(0u, model.parameterSet());
  model.setLocalControl(true);
  hold(0x047E, 0, 0.1);
  EXPECT_EQ(2u, model.parameterSet());
  EXPECT_EQ(0x8000, model.statusWord() & 0xC000);
  model.setLocalControl(false);
  hold(0x047E, 0, 0.1);
  EXPECT_EQ(0u, model.parameterSet());
}

// "Not ready" and "switch-on disabled" have their reason in P700[-03] (BU 0020 8).
TEST_F(Inverter, NamesTheReasonOfASwitchOnBlock) {
  const auto reason = [&] { return parameters.value(700, 0, 2); };
  EXPECT_EQ(block::kNone, reason());
  send(0x047D);
  EXPECT_EQ(block::kVoltageByBus, reason());
  send(0x047A);
  EXPECT_EQ(block::kQuickStopByBus, reason());
  send(0x047F);
  EXPECT_EQ(block::kStandingEnable, reason());
  send(0x047E);
  EXPECT_EQ(block::kNone, reason());
  model.setPowered(false);
  model.setPowered(true);
  model.advance(milliseconds(10));
  EXPECT_EQ(block::kCharging, reason());
}

// SW2 and SW3 act by their functions: 4 adds to the frequency, 5 subtracts (BU 0020 6.2.2).
TEST_F(Inverter, FurtherSetpointsAddAndSubtract) {
  parameters.preset(547, 0, 0, 4);
  parameters.preset(548, 0, 0, 5);
  send(0x047E);
  ProcessData data;
  data.control = 0x047F;
  data.setpoints = {0x2000, 0x1000, 0x0800};
  for (int i = 0; i < 1000; ++i) {
    model.receive(data);
    model.advance(milliseconds(3));
  }
  EXPECT_DOUBLE_EQ(25.0 + 12.5 - 6.25, model.frequency());
}

// SK 300E, 700E and 750E can take the setpoint alone (P509 = 8) or the control word alone (9) from PROFIBUS.
TEST(InverterOfAnOlderSeries, TakesHalfOfItsOrdersFromTheBus) {
  Device device;
  device.series = Series::kSk700e;
  ParameterStore parameters{device};
  Motor motor{MotorSettings{}};
  InverterModel model{parameters, motor};
  model.setPowered(true);
  model.advance(milliseconds(301));
  Terminals terminals;
  terminals.enable = true;
  terminals.frequency = 10.0;
  model.setTerminals(terminals);
  const auto run = [&](int source) {
    parameters.preset(509, 0, 0, source);
    for (const int control : {0x047E, 0x047F}) {
      ProcessData data;
      data.control = static_cast<Word>(control);
      data.setpoints[0] = 0x2000;
      model.receive(data);
      model.advance(seconds(3.0));
    }
    return model.frequency();
  };
  EXPECT_DOUBLE_EQ(25.0, run(8));
  EXPECT_FALSE(model.busControl());
  EXPECT_DOUBLE_EQ(10.0, run(9));
  EXPECT_TRUE(model.busControl());
  EXPECT_DOUBLE_EQ(25.0, run(10));
  EXPECT_DOUBLE_EQ(10.0, run(4));  // SK 5xxE's number for PROFIBUS is not theirs
}

// P509 other than 4 takes the control away from PROFIBUS.
TEST_F(Inverter, ControlSourceParameter) {
  parameters.preset(509, 0, 0, 0);
  enable();
  EXPECT_EQ(0u, model.statusWord() & 0x0200u);
  EXPECT_EQ(0.0, motor.speed());
}

// The wheel turns slower than the frequency says.
TEST_F(Inverter, HasSlip) {
  enable();
  EXPECT_LT(motor.rotorFrequency(), 24.99);
  EXPECT_GT(motor.rotorFrequency(), 24.0);
  parameters.preset(543, 0, 0, 23);
  EXPECT_LT(model.actualValue(0), 0x2000);
}

}  // namespace
}  // namespace nord_driver::sim

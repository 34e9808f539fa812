#include <gtest/gtest.h>

#include <cmath>

#include "nord_driver/sim/inverter_model.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

class Inverter : public ::testing::Test {
 protected:
  Inverter() {
    parameters.preset(509, 0, 0, 4);
    model.setPowered(true);
    model.advance(milliseconds(301));
  }

  /// One telegram, then its effect.
  void send(Word control, Word setpoint = 0) {
    ProcessData data;
    data.control = control;
    data.setpoints[0] = setpoint;
    model.receive(data);
    model.advance(milliseconds(3));
  }
  /// The same telegram every 3 ms.
  void hold(Word control, Word setpoint, double span) {
    for (double passed = 0.0; passed < span; passed += 0.003) send(control, setpoint);
  }
  void enable(Word setpoint = 0x2000, double span = 2.0) {
    send(0x047E);
    hold(0x047F, setpoint, span);
  }
  std::string status() const { return toHexWord(model.statusWord()); }

  ParameterStore parameters;
  Motor motor{MotorSettings{}};
  InverterModel model{parameters, motor, milliseconds(300)};
};

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
  model.advance(milliseconds(20));
  EXPECT_EQ("0B70", status());
  model.trip(21, false);
  model.advance(milliseconds(20));
  EXPECT_EQ("0B38", status());
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

}  // namespace
}  // namespace nord_driver::sim

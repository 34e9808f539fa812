// The signals and setpoints the system tests configure, on whichever bus.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "cycle/signal_values.h"
#include "sim/drive_unit.h"
#include "support/map_settings.h"
#include "system/driven_robot.h"

namespace nord_driver::test {

/// Outputs in the order of their names: bit_0 .. bit_7, lamp. P546[-02] = 20 carries the bits, P546[-03] = 11 the limit.
inline std::map<std::string, MapSettings::Value> signalSettings(bool may_move = false) {
  std::map<std::string, MapSettings::Value> settings;
  for (int bit = 0; bit < 8; ++bit) {
    const std::string group = "signals/bit_" + std::to_string(bit) + "/";
    settings[group + "source"] = "bus_in_bit_" + std::to_string(bit);
    if (may_move) {
      settings[group + "may_move"] = true;
    } else {
      settings[group + "on_timeout"] = std::string{"hold"};
    }
  }
  settings["signals/lamp/source"] = std::string{"module_output_1"};
  settings["signals/door/source"] = std::string{"module_input_3"};
  settings["signals/ready/source"] = std::string{"status_bit_13"};
  settings["signals/input/source"] = std::string{"digital_input_2"};
  settings["setpoints/grip/function"] = std::string{"torque_limit"};
  settings["setpoints/grip/limit"] = 80.0;
  return settings;
}
constexpr std::size_t kLampOutput = 8;

/// Of SK 2xxE: set 1, elements [-02] and [-03] of P546, [-02] of P543.
inline std::vector<sim::ParameterPreset> signalParameters() {
  return {{546, 0, 1, 20}, {546, 0, 2, 11}, {543, 0, 1, 5}};
}

template <typename Robot>
void commandOutput(Robot& robot, std::size_t index, bool on) {
  robot.ports().commandOutput(0, index, on, robot.transport().now());
}

template <typename Robot>
std::optional<double> signal(Robot& robot, const std::string& name) {
  for (const cycle::SignalSetup& setup : robot.config().drives[0].words.signals) {
    if (setup.name == name)
      return cycle::signalValue(setup, robot.config().drives[0].series, robot.snapshot().drives[0]);
  }
  return std::nullopt;
}

// A lamp on DO1 follows its topic, and goes off when nobody renews it.
template <typename Robot>
void expectALampThatFollows(Robot& robot) {
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ(0, robot.unit(0).module().outputs()) << "off at start";
  commandOutput(robot, kLampOutput, true);
  robot.run(std::chrono::milliseconds{100});
  EXPECT_EQ(1, robot.unit(0).module().outputs());
  robot.run(std::chrono::milliseconds{600});
  EXPECT_EQ(0, robot.unit(0).module().outputs()) << "cmd_vel_timeout";
  commandOutput(robot, kLampOutput, true);
  robot.run(std::chrono::milliseconds{100});
  commandOutput(robot, kLampOutput, false);
  robot.run(std::chrono::milliseconds{100});
  EXPECT_EQ(0, robot.unit(0).module().outputs());
}

// P480 leaves the factory with functions in the first four bits: they stay low whatever is commanded, the others follow.
template <typename Robot>
void expectNoBitThatMayMove(Robot& robot, unsigned seed) {
  ASSERT_TRUE(robot.bringUp());
  sim::Terminals terminals;
  terminals.frequency = 20.0;  // what the motor would turn at
  robot.unit(0).inverter().setTerminals(terminals);
  std::mt19937 random{seed};
  unsigned wanted = 0;
  for (int i = 0; i < 300; ++i) {
    const std::size_t bit = random() % 8;
    const bool on = random() % 2 != 0;
    wanted = on ? wanted | 1u << bit : wanted & ~(1u << bit);
    commandOutput(robot, bit, on);
    robot.run(std::chrono::milliseconds{40});
    ASSERT_EQ(wanted & 0xF0u, robot.unit(0).inverter().busInBits()) << i << ", seed " << seed;
    ASSERT_EQ(0.0, robot.unit(0).shaftSpeed()) << i << ", seed " << seed;
  }
}

template <typename Robot>
void expectInputs(Robot& robot) {
  ASSERT_TRUE(robot.bringUp());
  EXPECT_EQ(0.0, signal(robot, "door"));
  EXPECT_EQ(0.0, signal(robot, "ready"));
  EXPECT_EQ(0.0, signal(robot, "input"));
  sim::InverterInputs inputs;
  inputs.digital_io = 0x0002;
  inputs.bit_13 = true;
  robot.unit(0).inverter().setInputs(inputs);
  robot.unit(0).module().setInputs(0x04);
  robot.run(std::chrono::milliseconds{100});
  EXPECT_EQ(1.0, signal(robot, "door"));
  EXPECT_EQ(1.0, signal(robot, "ready"));
  EXPECT_EQ(1.0, signal(robot, "input"));
}

// 80 % of P112, and 40 %; in the word P546[-03] names, past the one with the bits.
template <typename Robot>
void expectATorqueLimit(Robot& robot) {
  ASSERT_TRUE(robot.bringUpAndEnable());
  EXPECT_EQ(13107, toSigned(robot.unit(0).inverter().setpoint(2)));
  robot.ports().commandSetpoint(0, 0, 40.0, robot.transport().now());
  robot.run(std::chrono::milliseconds{100});
  EXPECT_EQ(6554, toSigned(robot.unit(0).inverter().setpoint(2)));
  robot.run(std::chrono::milliseconds{600});
  EXPECT_EQ(13107, toSigned(robot.unit(0).inverter().setpoint(2)));
}

}  // namespace nord_driver::test

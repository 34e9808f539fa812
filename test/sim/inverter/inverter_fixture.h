// A simulated inverter under the bus's control, charged, and the words to command it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

class Inverter : public ::testing::Test {
 protected:
  Inverter() {
    parameters.preset(509, 0, 0, 4);
    model.setPowered(true);
    model.advance(std::chrono::milliseconds(301));
  }

  /// One telegram, then its effect.
  void send(Word control, Word setpoint = 0) {
    ProcessData data;
    data.control = control;
    data.setpoints[0] = setpoint;
    model.receive(data);
    model.advance(std::chrono::milliseconds(3));
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
  InverterModel model{parameters, motor};
};

}  // namespace nord_driver::sim

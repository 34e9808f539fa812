// An inverter with position control on a bus of three setpoints, and what its words say.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "sim/inverter/inverter_model.h"

namespace nord_driver::sim {

struct Axis {
  explicit Axis(Series series = Series::kSk5xxe, const PosiconSettings& settings = PosiconSettings{},
                const WideField& wide = WideField{})
      : parameters(deviceOf(series)), model(parameters, motor, inverterSettings(settings)) {
    BusWiring wiring;
    wiring.source = 4;
    wiring.wide = wide;
    model.wire(wiring);
    preset(509, 4);
    preset(600, 1);
    preset(102, 50);  // 0.5 s
    preset(103, 50);
    model.setPowered(true);
    run(0.4);
  }

  void preset(unsigned number, std::int32_t raw, unsigned element = 0) {
    for (unsigned set = 0; set < ParameterStore::kSets; ++set) parameters.preset(number, set, element, raw);
  }
  /// P546 to P548 and P543 to P545, however the series numbers them.
  void words(const std::array<std::int32_t, 3>& setpoints, const std::array<std::int32_t, 3>& actual) {
    const bool array = parameters.find(547) == nullptr;
    for (unsigned n = 0; n < 3; ++n) {
      preset(array ? 546 : 546 + n, setpoints[n], array ? n : 0);
      preset(array ? 543 : 543 + n, actual[n], array ? n : 0);
    }
  }
  void send(Word control, const std::array<Word, 3>& setpoints, unsigned carried = 3) {
    ProcessData data;
    data.control = control;
    data.setpoints = setpoints;
    data.carried = carried;
    model.receive(data);
    run(0.005);
  }
  void hold(Word control, const std::array<Word, 3>& setpoints, double span) {
    for (double passed = 0.0; passed < span; passed += 0.005) send(control, setpoints);
  }
  void run(double span) { model.advance(seconds(span)); }
  std::array<Word, 3> actual() const { return {model.actualValue(0), model.actualValue(1), model.actualValue(2)}; }
  bool reached() const { return (model.statusWord() & zsw::kSetpointReached) != 0; }
  double position() const { return model.posicon().position(); }

  static Device deviceOf(Series series) {
    Device device;
    device.series = series;
    return device;
  }
  static InverterSettings inverterSettings(const PosiconSettings& settings) {
    InverterSettings all;
    all.posicon = settings;
    return all;
  }

  ParameterStore parameters;
  Motor motor{MotorSettings{}};
  InverterModel model;
};

}  // namespace nord_driver::sim

// A bus cycle over one lift that positions, SK 53xE: frequency, low word, high word. 1 rad is a revolution.
#pragma once

#include <string>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {

/// It stands at 0.5 rad, held by a brake, whatever it is told. P546 to P548 = 1, 21, 22 and P543 to P545 = 1, 10, 15.
class PositioningLift : public CycleBench {
 public:
  explicit PositioningLift(const CycleConfig& config = PositioningLift::config(),
                           const ScriptedTransport& prepared = ScriptedTransport{1})
      : CycleBench{config, prepared} {
    transport.parameters = {{105, 500}, {543, 1},  {544, 10}, {545, 15}, {546, 1},
                            {547, 21},  {548, 22}, {600, 1},  {610, 2}};
    transport.inverters[0].second = 500;
    transport.inverters[0].ramp = 0;
  }
  /// Read and enabled; false: it was not.
  bool bringUpAndEnable() {
    run(80);
    const bool enabled = ask(RequestKind::kEnable, 0).success;
    events();
    return enabled;
  }
  const DriveSnapshot& lift() { return snapshot().drives[0]; }
  /// As sent, 0.001 revolutions.
  int sentTarget() const { return static_cast<std::uint16_t>(transport.outputs[0].setpoints[1]); }
  bool isHigh(unsigned bit) const { return (controlWord(0) >> bit & 1u) != 0; }

  static CycleConfig config() {
    CycleConfig config = CycleBench::config();
    config.base.reset();
    config.drives.resize(1);
    config.drives[0].name = "lift";
    PositionSetup position;
    position.setpoint_mode = 2;
    position.axis.tolerance = 0.01;
    config.drives[0].position = position;
    config.drives[0].drive.position = position.axis;
    return config;
  }
};

}  // namespace nord_driver::cycle

// A lift whose words carry signals, through the whole cycle.
#pragma once

#include <vector>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {

inline SignalSetup output(SignalSource source, std::uint8_t number) {
  SignalSetup signal;
  signal.name = "lamp";
  signal.source = source;
  signal.number = number;
  return signal;
}

inline CycleConfig configured(const std::vector<SignalSetup>& signals) {
  CycleConfig config = CycleBench::config();
  WordSetup& words = config.drives[CycleBench::kLift].words;
  words.signals = signals;
  words.release_after = config.cmd_vel_timeout;
  return config;
}

/// P547 = 17: setpoint 2 carries the bus bits.
class Signals : public CycleBench {
 public:
  explicit Signals(const std::vector<SignalSetup>& signals) : CycleBench{configured(signals)} {
    for (const int number : {543, 546}) transport.parameters[number] = 1;
    for (const int number : {480, 544, 545, 548}) transport.parameters[number] = 0;
    transport.parameters[547] = 17;
  }
  void command(bool on, std::size_t index = 0) { ports.commandOutput(kLift, index, on, transport.time); }
  const profile::ProcessOutput& sent() const { return transport.outputs[kLift]; }
};

}  // namespace nord_driver::cycle

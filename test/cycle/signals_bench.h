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

inline CycleConfig configured(const std::vector<SignalSetup>& signals, DriveIndex drive) {
  CycleConfig config = CycleBench::config();
  WordSetup& words = config.drives[drive].words;
  words.signals = signals;
  words.release_after = config.cmd_vel_timeout;
  return config;
}

/// P547 = 17: setpoint 2 carries the bus bits.
class Signals : public CycleBench {
 public:
  /// `drive`: whose signals they are.
  explicit Signals(const std::vector<SignalSetup>& signals, DriveIndex drive = kLift)
      : CycleBench{configured(signals, drive)}, drive_{drive} {
    for (const int number : {543, 546}) transport.parameters[number] = 1;
    for (const int number : {480, 544, 545, 548}) transport.parameters[number] = 0;
    transport.parameters[547] = 17;
  }
  void command(bool on, std::size_t index = 0) { ports.commandOutput(drive_, index, on, transport.time); }
  const profile::ProcessOutput& sent() const { return transport.outputs[drive_]; }

 private:
  DriveIndex drive_;
};

}  // namespace nord_driver::cycle

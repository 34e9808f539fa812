// What must hold of two wheels and of the calls of their users, judged on what was seen and done. One clock for all.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nord_driver::test {

/// A drive as the simulator knows it.
struct TruthPoint {
  double time = 0.0;       ///< s
  bool enabled = false;    ///< the output voltage is on
  double frequency = 0.0;  ///< Hz, signed
  int setpoint = 0;        ///< of 16384
};

/// A call that was made, and how it ended.
struct MadeCall {
  std::string service;
  double begin = 0.0;  ///< s
  std::optional<double> end;
  bool success = false;
  std::string message;
  std::string not_carried_out{};  ///< why it brought no answer of the driver; empty: it did
};

/// From, until, s.
struct TimeSpan {
  double from = 0.0;
  double until = 0.0;
};

struct ProcessRecord {
  std::vector<TruthPoint> wheels[2];
  std::vector<MadeCall> enablings;  ///< ~enable true
  std::vector<double> stops;        ///< when a user asked for a stop, or the driver was ended, s
  std::vector<TimeSpan> commanded;  ///< cmd_vel that is not zero was published
};

struct ProcessBounds {
  double stop = 0.0;   ///< s until a wheel rests after nothing allows it any more: time-outs and ramps
  double alone = 0.0;  ///< s until the other wheel has setpoint 0
  double seen = 0.0;   ///< s that the truth may be old
};

/// ~enable alone switches a drive on: while it is called.
std::optional<std::string> enabledUnasked(const ProcessRecord& record, const ProcessBounds& bounds);
/// Nobody turns for longer than the bound after its last command, or after what stopped it.
std::optional<std::string> turnsUncommanded(const ProcessRecord& record, const ProcessBounds& bounds);
/// One wheel has no setpoint but 0 while the other one is not enabled.
std::optional<std::string> turnsAlone(const ProcessRecord& record, const ProcessBounds& bounds);
/// Each is answered within its patience, and a refusal has a sentence.
std::optional<std::string> unanswered(const std::vector<MadeCall>& calls, double patience);

}  // namespace nord_driver::test

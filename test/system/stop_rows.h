// The rows of "What stops what": what brings each cause about, when the driver can know of it, and what has to follow.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "support/map_settings.h"
#include "system/stop_rig.h"

namespace nord_driver::test {

class WhatStopsWhat;

/// When the driver can know of a cause.
enum class Known {
  kAtOnce,       ///< it was told
  kCommandAge,   ///< when the last command is older than cmd_vel_timeout
  kRampTooLong,  ///< when shutdown_timeout is over
  kOnTheWire,    ///< when the status word says it
  kNodeState,    ///< when the bus tells of the node's, or its own, new state
  kZeros,        ///< drive_timeout after the first status word that is zero
  kSilence,      ///< drive_timeout after the last status word has become too old
};

enum class Reaction {
  kRamp,        ///< down the deceleration limit, both alike
  kQuickStop,   ///< OFF3 on all
  kOneStops,    ///< the right drive gets the idle word, the left one setpoint 0
  kOneIsGone,   ///< the same, but who knows what reaches the right one: it is not told to run any more
  kAllAreGone,  ///< none is told to run any more: the bus itself does not reach them
  kNoBus,       ///< nothing is sent; the drives' own time-outs act
};

enum class After {
  kEnabled,       ///< and follows the next command
  kDisabled,      ///< by its user
  kLatched,       ///< disabled, and named
  kFaultLatched,  ///< and acknowledged before it can be enabled
  kEnded,         ///< for good
};

struct StopRow {
  const char* name;
  Known known;
  Reaction reaction;
  After after;
  const char* named;  ///< part of what the base says
  void (*cause)(WhatStopsWhat&);
  bool (*status_says)(Word status) = nullptr;  ///< with Known::kOnTheWire and kZeros
  void (*end_cause)(WhatStopsWhat&) = nullptr;
  bool commands_go_on = true;  ///< somebody goes on commanding, whatever happens
};

const std::vector<StopRow>& stopRows();
/// Of the node: the limit of the base for the rows that end in a ramp, and the cycle; nothing else is set.
std::map<std::string, MapSettings::Value> stopSettings(double cycle_rate);
void PrintTo(const StopBus& bus, std::ostream* out);
void PrintTo(const StopRow& row, std::ostream* out);
std::string nameOfStop(const ::testing::TestParamInfo<std::tuple<StopBus, StopRow>>& info);

}  // namespace nord_driver::test

// The newest values users have commanded for the further words of one drive.
#pragma once

#include <array>
#include <optional>

#include "cycle/word_setup.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Of one setpoint, in its unit.
struct WordCommand {
  double value = 0.0;
  Instant received{};
  bool given = false;                 ///< false until the first command
  std::optional<Instant> moved = {};  ///< when the newest that was not zero came
};

/// Of one output.
struct BitCommand {
  bool on = false;
  Instant received{};
  bool given = false;               ///< false until the first command
  std::optional<Instant> off = {};  ///< when the newest "off" came
};

/// Each in the order of the configuration, inputs left out.
struct WordCommands {
  std::array<WordCommand, kMaxExtraSetpoints> setpoints;
  std::array<BitCommand, kMaxSignalOutputs> outputs;
};

}  // namespace nord_driver::cycle

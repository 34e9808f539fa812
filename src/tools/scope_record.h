// The process data of one drive over time, cycle by cycle, and the CSV file it is kept in.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "nord_driver/profile/process_data.h"

namespace nord_driver::tools {

struct ScopeSample {
  double time = 0.0;      ///< s
  bool answered = false;  ///< `input` is fresh
  profile::ProcessOutput output;
  profile::ProcessInput input;
};

struct ScopeRecord {
  std::string drive;
  std::optional<double> max_frequency;  ///< Hz, P105: 100 % of setpoint 1 and actual value 1; nothing: not known
  int current_word = 0;                 ///< which actual value is the current (P543 to P545 = 3), 1 to 3; 0: none
  std::vector<ScopeSample> samples;     ///< in the order of their times
  // False: by P546 or P543 this word of a drive that positions is something else, or they could not be read.
  bool setpoint_is_frequency = true;      ///< setpoint 1
  bool actual_value_is_frequency = true;  ///< actual value 1
  bool commands_known = true;             ///< false: nothing is sent, and nobody knows what another sends
  bool words_known = true;                ///< false: no process data came, of the status word the state alone is known

  /// Hz, 100 % of setpoint 1; nothing: not known, or it is no frequency.
  std::optional<double> setpointScale() const {
    return setpoint_is_frequency && commands_known ? max_frequency : std::nullopt;
  }
  /// The same of actual value 1.
  std::optional<double> actualValueScale() const {
    return actual_value_is_frequency && words_known ? max_frequency : std::nullopt;
  }
};

/// One line per cycle. Comments ("# drive: left") tell what the columns do not.
std::string scopeCsv(const ScopeRecord& record);
/// The same cycles for programs: one JSON object a line, its keys the columns of the CSV; frequencies where known.
std::string scopeJson(const ScopeRecord& record);
/// What `scopeCsv` has written. Throws UsageError naming the line, what is there and what was expected.
ScopeRecord readScopeCsv(const std::string& text);

/// The drive in a trace of the driver (doc/trace.md): from its telegrams, or from the table of process data where these
/// have no words for the drive or are fewer. Throws UsageError when the trace has no such drive.
ScopeRecord readScopeTrace(const std::string& text, const std::string& drive);

}  // namespace nord_driver::tools

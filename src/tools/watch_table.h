// What nord_param watch shows of some drives: one column each, or one line each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/profile/process_data.h"

namespace nord_driver::tools {

/// One drive as it is now.
struct WatchedDrive {
  std::string name;
  bool online = false;
  std::string silence;              ///< why not, a clause; may be empty
  profile::ProcessOutput output;    ///< as sent last
  profile::ProcessInput input;      ///< as received last
  std::uint8_t process_values = 1;  ///< 0 to 3 setpoints and actual values are carried
  std::optional<double> frequency;  ///< Hz, of actual value 1; nothing: P105 is not known, or it carries none
  std::string fault;                ///< "none", "E10.2 bus timeout"
  bool commands_known = true;       ///< false: nothing is sent, and nobody knows what another sends
  bool words_known = true;          ///< false: no process data come, `input` has the state alone
  bool state_known = true;          ///< false: not even that
  std::vector<std::string> values;  ///< of the parameters that were asked for, each with its unit, or why not
};

/// A row of labels and a column for each drive; every line ends with a line feed. `parameters`: the labels of `values`.
std::string watchTable(const std::vector<WatchedDrive>& drives, const std::vector<std::string>& parameters);

/// One line of one drive; `time` in s since the first one.
std::string watchLine(double time, const WatchedDrive& drive, const std::vector<std::string>& parameters);
/// The same as an object.
std::string watchJson(double time, const WatchedDrive& drive, const std::vector<std::string>& parameters);

}  // namespace nord_driver::tools

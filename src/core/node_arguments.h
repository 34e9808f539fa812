// The command line of a ROS node: its parameters are on the parameter server, so that all it understands besides ROS's
// own arguments is what commonOptions() names. Anything else is refused: a file name that is silently ignored looks taken.
#pragma once

#include <optional>
#include <string>

#include "core/program_text.h"

namespace nord_driver {

/// What to print before the program ends.
struct ProgramAnswer {
  std::string output;  ///< for stdout
  std::string error;   ///< for stderr
  int exit_code = 0;
};

/// Looks at the arguments after the program's name. Nothing: run the node. `text` is what the program says of itself. ROS's
/// own arguments (NAME:=VALUE) are passed over; an unknown one gives exit code 2.
std::optional<ProgramAnswer> answerArguments(int argc, const char* const* argv, const ProgramText& text);

}  // namespace nord_driver

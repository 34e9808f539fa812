#include "core/node_arguments.h"

#include "core/version.h"

namespace nord_driver {

std::optional<ProgramAnswer> answerArguments(int argc, const char* const* argv, const std::string& name,
                                             const std::string& usage) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.find(":=") != std::string::npos) continue;
    if (argument == "--version") return ProgramAnswer{name + " " + kVersion + "\n", "", 0};
    if (argument == "-h" || argument == "--help") return ProgramAnswer{usage, "", 0};
    return ProgramAnswer{"",
                         name + ": \"" + argument +
                             "\" is not known, expected --help, --version or ROS's own arguments (NAME:=VALUE); a "
                             "configuration file is loaded with rosparam or roslaunch\n",
                         2};
  }
  return std::nullopt;
}

}  // namespace nord_driver

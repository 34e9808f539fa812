#include "core/node_arguments.h"

namespace nord_driver {

std::optional<ProgramAnswer> answerArguments(int argc, const char* const* argv, const ProgramText& text) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.find(":=") != std::string::npos) continue;
    if (argument == "--version") return ProgramAnswer{text.name + " " + text.version + "\n", "", 0};
    if (argument == "-h" || argument == "--help") return ProgramAnswer{nodeHelp(text), "", 0};
    if (argument == "--manual-page") return ProgramAnswer{manualPage(text), "", 0};
    if (argument == "--bash-completion") return ProgramAnswer{bashCompletion(text), "", 0};
    return ProgramAnswer{"",
                         text.name + ": \"" + argument +
                             "\" is not known, expected --help, --version or ROS's own arguments (NAME:=VALUE); a "
                             "configuration file is loaded with rosparam or roslaunch\n",
                         2};
  }
  return std::nullopt;
}

}  // namespace nord_driver

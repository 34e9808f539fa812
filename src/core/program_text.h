// What a program says of its command line, once: --help, the manual page and the completion of a shell are made from it.
#pragma once

#include <string>
#include <vector>

namespace nord_driver {

struct ProgramOption {
  std::string name;   ///< without the two dashes
  std::string value;  ///< "FILE", "PATH", "SECONDS"; empty: it has none. A shell completes FILE and PATH as files
  std::string about;
};

struct ProgramCommand {
  std::string name;
  std::string about;
  std::vector<ProgramOption> arguments;  ///< words that follow it: the name in `value`
  std::vector<ProgramOption> options;
};

/// Known words for the values of that name ("SET": 1 to 4), or of a ROS parameter ("_transport", "_drives/*/series").
struct ProgramWords {
  std::string name;
  std::vector<std::string> words;
};

struct ProgramText {
  std::string name;
  std::string version;
  std::string brief;                  ///< a few words, for the head of the manual page
  std::string about;                  ///< whole sentences
  std::vector<std::string> examples;  ///< lines to try
  std::vector<ProgramOption> options;
  std::vector<ProgramCommand> commands;  ///< empty: it has none
  std::string footer;                    ///< paragraphs, each a line; the exit codes are the last of them
  std::vector<ProgramWords> words;
  bool takes_ros_arguments = false;  ///< NAME:=VALUE
};

/// The options every program has.
std::vector<ProgramOption> commonOptions();

/// For man(1), section 1.
std::string manualPage(const ProgramText& text);

/// For bash: options and commands where they may stand, files, and the known words.
std::string bashCompletion(const ProgramText& text);

/// --help of a program that has no commands and no table of options of its own: a ROS node.
std::string nodeHelp(const ProgramText& text);

}  // namespace nord_driver

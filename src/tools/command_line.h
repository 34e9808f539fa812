// What the programs' command lines have in common: options, commands, --help, --version, exit codes and what a time is.
// Over Boost.Program_options, which is wherever ROS 1 is.
#pragma once

#include <boost/any.hpp>
#include <boost/program_options.hpp>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/program_text.h"

namespace nord_driver::tools {

constexpr int kDone = 0, kFailed = 1, kWrongUsage = 2;

/// The value of an option in seconds: more than 0, and a time there can be a timer for.
struct Seconds {
  double value = 0.0;
};

/// The value of an option that is a whole number from kLow to kHigh.
template <int kLow, int kHigh>
struct WholeNumber {
  int value = 0;
};

/// A word that has to follow the name of a command.
struct Argument {
  std::string name;  ///< in capitals, as --help shows it
  std::string about;
  std::string* value;
  bool optional = false;  ///< may be left out; those after it, too
};

/// Words that may follow the arguments of a command, as many as one likes.
struct MoreArguments {
  std::string name;  ///< in capitals, as --help shows it
  std::string about;
  std::vector<std::string>* values = nullptr;  ///< nullptr: there are none
};

/// What a program can be asked for by name, with the words and the options that belong to it.
struct Command {
  std::string name;
  std::string about;
  std::vector<Argument> arguments;
  boost::program_options::options_description options{"Options"};
  MoreArguments more = {};
};

class CommandLine {
 public:
  CommandLine(std::string program, std::string version, std::string about, std::string footer);

  /// For the head of the manual page: what it is in a few words.
  void setBrief(const std::string& brief) { brief_ = brief; }
  /// What a shell offers for a value of that name ("SET"); files are offered for FILE and PATH.
  void offer(const std::string& value_name, const std::vector<std::string>& words);

  /// Those of the program: before or after the name of a command.
  boost::program_options::options_description_easy_init addOptions() { return options_.add_options(); }
  /// Once there is a command, one has to be given. The reference stays good.
  Command& addCommand(const std::string& name, const std::string& about);

  /// Fills what the options and arguments point to. Nothing: go on. Otherwise the exit code: --help or another of
  /// commonOptions() has been printed on stdout (kDone), or what is wrong on stderr (kWrongUsage).
  std::optional<int> parse(int argc, const char* const* argv);

  /// Whether this command was given.
  bool asksFor(const Command& command) const { return chosen_ == &command; }

 private:
  struct Words {
    bool help = false;
    bool version = false;
    bool manual = false;
    bool completion = false;
    std::vector<std::string> others;  ///< what is neither an option nor the value of one
  };

  Words read(const std::vector<std::string>& words) const;
  void choose(const std::vector<std::string>& others);
  /// What `choose` says of the first word that is neither an option nor the value of one; empty when it is a command.
  std::string unknownCommand(const std::vector<std::string>& words);
  void store(const std::vector<std::string>& words, const std::vector<std::string>& others) const;
  std::string help() const;
  ProgramText text() const;

  std::string program_;
  std::string version_;
  std::string brief_;
  std::string about_;
  std::string footer_;
  boost::program_options::options_description options_;
  std::deque<Command> commands_;
  std::vector<ProgramWords> words_;
  const Command* chosen_ = nullptr;
};

/// How Boost.Program_options reads a Seconds.
void validate(boost::any& result, const std::vector<std::string>& texts, Seconds* type, int);

/// A whole number from `low` to `high`; what it throws becomes a sentence that names option, value and range.
int wholeNumber(const std::vector<std::string>& texts, int low, int high);

template <int kLow, int kHigh>
void validate(boost::any& result, const std::vector<std::string>& texts, WholeNumber<kLow, kHigh>*, int) {
  boost::program_options::validators::check_first_occurrence(result);
  result = WholeNumber<kLow, kHigh>{wholeNumber(texts, kLow, kHigh)};
}

}  // namespace nord_driver::tools

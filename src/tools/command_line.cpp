#include "tools/command_line.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

namespace po = boost::program_options;

constexpr unsigned kColumns = 110;  // of --help
constexpr char kOthers[] = "words";

// No short options and no guessing: a value may be negative, and an abbreviation may mean another option tomorrow.
constexpr int kStyle = po::command_line_style::allow_long | po::command_line_style::long_allow_adjacent |
                       po::command_line_style::long_allow_next;

/// The option's name is put in by Boost.
po::error_with_option_name notValid(const std::string& text, const std::string& expected) {
  po::error_with_option_name error("%canonical_option%: %value% is not valid, expected " + expected);
  error.set_substitute("value", text);
  // Without this the name gets the words "option '...'" around it.
  error.set_substitute_default("canonical_option", "", "");
  return error;
}

/// Of words of which all options are known to `options`; the others are put under kOthers.
po::parsed_options parsed(const std::vector<std::string>& words, const po::options_description& options) {
  po::options_description all;
  all.add(options).add_options()(kOthers, po::value<std::vector<std::string>>(), "");
  po::positional_options_description others;
  others.add(kOthers, -1);
  po::command_line_parser parser(words);
  return parser.options(all).positional(others).style(kStyle).run();
}

// -5 and -.5 are values.
bool isShortOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

std::string listed(const std::string& name, const std::string& about) {
  std::string line = "  " + name;
  line.resize(std::max<std::size_t>(line.size() + 2, 14), ' ');
  return line + about + "\n";
}

std::string wordOf(const Argument& argument) {
  return argument.optional ? "[" + argument.name + "]" : argument.name;
}

std::string usageOf(const std::string& program, const Command& command) {
  std::string usage = program + " " + command.name + " [OPTIONS]";
  for (const Argument& argument : command.arguments) usage += " " + wordOf(argument);
  if (command.more.values != nullptr) usage += " [" + command.more.name + " ...]";
  return usage;
}

std::vector<ProgramOption> listOf(const po::options_description& options) {
  std::vector<ProgramOption> list;
  for (const auto& option : options.options()) {
    const bool has_value = option->semantic()->max_tokens() > 0;
    list.push_back({option->long_name(), has_value ? option->semantic()->name() : "", option->description()});
  }
  return list;
}

}  // namespace

void validate(boost::any& result, const std::vector<std::string>& texts, Seconds*, int) {
  po::validators::check_first_occurrence(result);
  const std::string& text = po::validators::get_single_string(texts);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value > 0.0)) throw notValid(text, "more than 0 s");
  if (value > 1e9) throw notValid(text, "at most 1000000000 s");
  result = Seconds{value};
}

int wholeNumber(const std::vector<std::string>& texts, int low, int high) {
  const std::string& text = po::validators::get_single_string(texts);
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || value < low || value > high) {
    throw notValid(text, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(value);
}

CommandLine::CommandLine(std::string program, std::string version, std::string about, std::string footer)
    : program_(std::move(program)),
      version_(std::move(version)),
      about_(std::move(about)),
      footer_(std::move(footer)),
      options_("General options", kColumns, kColumns / 2) {
  for (const ProgramOption& option : commonOptions()) options_.add_options()(option.name.c_str(), option.about.c_str());
}

Command& CommandLine::addCommand(const std::string& name, const std::string& about) {
  return commands_.emplace_back(
      Command{name, about, {}, po::options_description{"Options", kColumns, kColumns / 2}, {}});
}

void CommandLine::offer(const std::string& value_name, const std::vector<std::string>& words) {
  words_.push_back({value_name, words});
}

ProgramText CommandLine::text() const {
  ProgramText text;
  text.name = program_;
  text.version = version_;
  text.brief = brief_;
  text.about = about_;
  text.options = listOf(options_);
  for (const Command& command : commands_) {
    ProgramCommand listed{command.name, command.about, {}, listOf(command.options)};
    for (const Argument& argument : command.arguments) listed.arguments.push_back({"", argument.name, argument.about});
    if (command.more.values != nullptr) {
      listed.arguments.push_back({"", "[" + command.more.name + " ...]", command.more.about});
    }
    text.commands.push_back(listed);
  }
  text.footer = footer_;
  text.words = words_;
  return text;
}

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::replace(words.begin(), words.end(), std::string("-h"), std::string("--help"));
  try {
    const Words given = read(words);
    if (given.version) {
      std::printf("%s %s\n", program_.c_str(), version_.c_str());
      return kDone;
    }
    if (given.manual || given.completion) {
      std::fputs((given.manual ? manualPage(text()) : bashCompletion(text())).c_str(), stdout);
      return kDone;
    }
    if (!given.help || !given.others.empty()) choose(given.others);
    if (given.help) {
      std::fputs(help().c_str(), stdout);
      return kDone;
    }
    store(words, given.others);
    return std::nullopt;
  } catch (const po::error& error) {
    const std::string unknown = chosen_ == nullptr ? unknownCommand(words) : "";
    std::fprintf(stderr, "%s\nRun with --help for more information.\n",
                 unknown.empty() ? error.what() : unknown.c_str());
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s\nRun with --help for more information.\n", error.what());
  }
  return kWrongUsage;
}

CommandLine::Words CommandLine::read(const std::vector<std::string>& words) const {
  po::options_description all;
  all.add(options_);
  for (const Command& command : commands_) {
    for (const auto& option : command.options.options()) {
      if (all.find_nothrow(option->long_name(), false) == nullptr) all.add(option);
    }
  }
  Words given;
  for (const po::option& option : parsed(words, all).options) {
    if (option.string_key == "help") given.help = true;
    if (option.string_key == "version") given.version = true;
    if (option.string_key == "manual-page") given.manual = true;
    if (option.string_key == "bash-completion") given.completion = true;
    if (option.string_key != kOthers) continue;
    for (const std::string& word : option.value) {
      if (isShortOption(word)) throw UsageError("unrecognised option '" + word + "'");
      given.others.push_back(word);
    }
  }
  return given;
}

void CommandLine::choose(const std::vector<std::string>& others) {
  if (commands_.empty()) {
    if (others.empty()) return;
    throw UsageError("\"" + others.front() + "\" is too much, expected options only");
  }
  std::string names;
  for (const Command& command : commands_) {
    if (!others.empty() && command.name == others.front()) chosen_ = &command;
    names += (names.empty() ? "" : ", ") + command.name;
  }
  if (chosen_ != nullptr) return;
  throw UsageError(others.empty() ? "a command is missing, expected one of " + names
                                  : "\"" + others.front() + "\" is no command, expected one of " + names);
}

// Of words that could not be read: what is wrong with the options of a command nobody knows does not matter.
std::string CommandLine::unknownCommand(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].compare(0, 1, "-") != 0) {
      try {
        choose({words[i]});
      } catch (const UsageError& error) {
        return error.what();
      }
      return "";
    }
    const auto* const option = options_.find_nothrow(words[i].substr(words[i].find_first_not_of('-')), false);
    if (option != nullptr && option->semantic()->max_tokens() > 0) ++i;
  }
  return "";
}

void CommandLine::store(const std::vector<std::string>& words, const std::vector<std::string>& others) const {
  po::options_description known;
  known.add(options_);
  if (chosen_ != nullptr) known.add(chosen_->options);
  po::options_description with_others;
  with_others.add(known).add_options()(kOthers, po::value<std::vector<std::string>>(), "");
  po::variables_map values;
  po::parsed_options options = parsed(words, known);
  options.description = &with_others;
  po::store(options, values);
  if (chosen_ != nullptr) {
    const std::vector<Argument>& expected = chosen_->arguments;
    const std::size_t given = others.size() - 1;
    const std::string usage = ", expected: " + usageOf(program_, *chosen_);
    if (given < expected.size() && !expected[given].optional) {
      throw UsageError(expected[given].name + " is missing" + usage);
    }
    const bool takes_more = chosen_->more.values != nullptr;
    if (given > expected.size() && !takes_more) {
      throw UsageError("\"" + others[expected.size() + 1] + "\" is too much" + usage);
    }
    for (std::size_t i = 0; i < std::min(given, expected.size()); ++i) *expected[i].value = others[i + 1];
    if (takes_more) {
      const std::size_t named = std::min(given, expected.size());
      chosen_->more.values->assign(others.begin() + 1 + static_cast<std::ptrdiff_t>(named), others.end());
    }
  }
  po::notify(values);
}

std::string CommandLine::help() const {
  std::ostringstream text;
  if (chosen_ != nullptr) {
    text << chosen_->about << "\nUsage: " << usageOf(program_, *chosen_) << "\n\n";
    for (const Argument& argument : chosen_->arguments) text << listed(argument.name, argument.about);
    if (chosen_->more.values != nullptr) text << listed(chosen_->more.name, chosen_->more.about);
    if (!chosen_->arguments.empty() || chosen_->more.values != nullptr) text << "\n";
    if (!chosen_->options.options().empty()) text << chosen_->options << "\n";
    text << options_;
    return text.str();
  }
  text << about_ << "\nUsage: " << program_ << " [OPTIONS]" << (commands_.empty() ? "" : " COMMAND") << "\n\n"
       << options_;
  if (!commands_.empty()) text << "\nCommands (" << program_ << " COMMAND --help tells more):\n";
  for (const Command& command : commands_) text << listed(command.name, command.about);
  text << "\n" << footer_ << "\n";
  return text.str();
}

}  // namespace nord_driver::tools

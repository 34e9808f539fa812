#include "rules/door_rules.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace nord_driver::rules {

namespace {

bool isOurs(const SourceFile& file) {
  return isCpp(file) && (startsWith(file.path, "src/") || startsWith(file.path, "include/"));
}

bool isWordPart(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string where(const SourceFile& file, std::size_t at) {
  const auto lines = std::count(file.text.begin(), file.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return file.path + ":" + std::to_string(lines + 1) + ": ";
}

/// The same text with what stands in strings and characters blanked, the quotes left: a name found there is a call.
std::string withoutStrings(std::string text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool digit_separator = c == '\'' && i > 0 && std::isxdigit(static_cast<unsigned char>(text[i - 1])) != 0;
    if (quote == 0) {
      if (c == '"' || (c == '\'' && !digit_separator)) quote = c;
    } else if (c == '\\' && i + 1 < text.size()) {
      text[i] = ' ';
      text[++i] = ' ';
    } else if (c == quote || c == '\n') {  // raw strings may hold quotes: the end of a line ends any
      quote = 0;
    } else {
      text[i] = ' ';
    }
  }
  return text;
}

/// Where `name` is called, from `from` on: the position behind its bracket; npos: nowhere. Not as a part of a longer name.
std::size_t callOf(const std::string& code, const std::string& name, std::size_t from) {
  for (std::size_t at = code.find(name, from); at != std::string::npos; at = code.find(name, at + 1)) {
    const std::size_t behind = at + name.size();
    if (behind < code.size() && code[behind] == '(' && (at == 0 || !isWordPart(code[at - 1]))) return behind + 1;
  }
  return std::string::npos;
}

/// The arguments of a call that begin at `begin`, one by one; brackets hold their commas together.
std::vector<std::string> argumentsAt(const std::string& code, std::size_t begin) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (std::size_t i = begin; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && --depth < 0) break;
    if (c == ',' && depth == 0) {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  for (std::string& argument : arguments) {
    const auto is_space = [](unsigned char part) { return std::isspace(part) != 0; };
    argument.erase(argument.begin(), std::find_if_not(argument.begin(), argument.end(), is_space));
    argument.erase(std::find_if_not(argument.rbegin(), argument.rend(), is_space).base(), argument.end());
  }
  return arguments;
}

/// `pattern`, or its declaration: `const char* pattern`.
bool isHandedOn(const std::string& argument) {
  return endsWith(argument, "pattern") || endsWith(argument, "format");
}

bool isLiteral(const std::string& argument) {
  if (startsWith(argument, "\"")) return true;
  const std::size_t question = argument.find("? \"");
  return question != std::string::npos && argument.find(": \"", question) != std::string::npos;
}

struct Formatter {
  const char* name;
  std::size_t format;  ///< which argument
};
constexpr Formatter kFormatters[] = {{"printf", 0},
                                     {"fprintf", 1},
                                     {"snprintf", 2},
                                     {"vsnprintf", 2},
                                     {"dprintf", 1},
                                     {"format", 0},
                                     {"ROS_DEBUG", 0},
                                     {"ROS_INFO", 0},
                                     {"ROS_WARN", 0},
                                     {"ROS_ERROR", 0},
                                     {"ROS_FATAL", 0},
                                     {"ROS_INFO_ONCE", 0},
                                     {"ROS_WARN_ONCE", 0},
                                     {"ROS_LOG", 2},
                                     {"ROS_INFO_THROTTLE", 1},
                                     {"ROS_WARN_THROTTLE", 1},
                                     {"ROS_ERROR_THROTTLE", 1}};

}  // namespace

Violations checkCalls(const std::vector<SourceFile>& files) {
  constexpr const char* kForbidden[] = {"system", "popen",  "execl",       "execlp",       "execle",
                                        "execv",  "execvp", "execve",      "execvpe",      "fork",
                                        "vfork",  "dlopen", "posix_spawn", "posix_spawnp", "gets",
                                        "strcpy", "strcat", "sprintf",     "vsprintf",     "asprintf"};
  Violations violations;
  std::size_t read = 0;
  for (const SourceFile& file : files) {
    if (!isOurs(file)) continue;
    ++read;
    const std::string code = withoutStrings(withoutComments(file.text));
    for (const char* const name : kForbidden) {
      const std::size_t at = callOf(code, name, 0);
      if (at != std::string::npos) violations.push_back(where(file, at) + "calls " + name);
    }
  }
  if (read == 0) violations.emplace_back("no source at all");
  return violations;
}

Violations checkFormats(const std::vector<SourceFile>& files) {
  Violations violations;
  std::size_t found = 0;
  for (const SourceFile& file : files) {
    if (!isOurs(file)) continue;
    const std::string code = withoutStrings(withoutComments(file.text));
    for (const Formatter& formatter : kFormatters) {
      for (std::size_t at = callOf(code, formatter.name, 0); at != std::string::npos;
           at = callOf(code, formatter.name, at)) {
        const std::vector<std::string> arguments = argumentsAt(code, at);
        if (arguments.size() <= formatter.format) continue;  // format() of something else
        if (arguments[0] == "printf") continue;              // __attribute__((format(printf, ...
        ++found;
        const std::string& argument = arguments[formatter.format];
        if (isLiteral(argument) || isHandedOn(argument)) continue;
        violations.push_back(where(file, at) + formatter.name + "() with a format that is no literal: " + argument);
      }
    }
  }
  if (found == 0) violations.emplace_back("no format at all");
  return violations;
}

}  // namespace nord_driver::rules

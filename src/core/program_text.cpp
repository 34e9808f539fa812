#include "core/program_text.h"

#include <algorithm>
#include <sstream>

namespace nord_driver {

namespace {

// A hyphen of a name is none of a text, and a line that begins with a dot is a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
      escaped += c;
    }
  }
  return escaped;
}

std::string paragraphs(const std::string& text) {
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) all += ".PP\n" + roff(line) + "\n";
  return all;
}

std::string listed(const ProgramOption& option) {
  std::string head = "\\fB\\-\\-" + roff(option.name) + "\\fR";
  if (!option.value.empty()) head += " \\fI" + roff(option.value) + "\\fR";
  return ".TP\n" + head + "\n" + roff(option.about) + "\n";
}

std::string commandSection(const ProgramCommand& command) {
  std::string text = ".SS " + roff(command.name);
  for (const ProgramOption& argument : command.arguments) text += " " + roff(argument.value);
  text += "\n" + roff(command.about) + "\n";
  for (const ProgramOption& argument : command.arguments) {
    text += ".TP\n\\fI" + roff(argument.value) + "\\fR\n" + roff(argument.about) + "\n";
  }
  for (const ProgramOption& option : command.options) text += listed(option);
  return text;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

bool isFile(const std::string& value) {
  return value.compare(0, 4, "FILE") == 0 || value == "PATH";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string optionNames(const std::vector<ProgramOption>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const ProgramOption& option : options) names.push_back("--" + option.name);
  return joined(names);
}

/// What completes the value of an option or argument.
std::string valueLine(const ProgramText& text, const std::string& value) {
  if (isFile(value)) return "_nord_driver_files";
  for (const ProgramWords& known : text.words) {
    if (known.name == value) return "COMPREPLY=($(compgen -W '" + joined(known.words) + "' -- \"$current\"))";
  }
  return "COMPREPLY=()";
}

std::vector<ProgramOption> allOptions(const ProgramText& text) {
  std::vector<ProgramOption> all = text.options;
  for (const ProgramCommand& command : text.commands) {
    for (const ProgramOption& option : command.options) {
      const auto same = [&](const ProgramOption& other) { return other.name == option.name; };
      if (std::none_of(all.begin(), all.end(), same)) all.push_back(option);
    }
  }
  return all;
}

// The words of "_transport:=can" reach a completion in pieces: "_transport", ":=", "can".
std::string assignments(const ProgramText& text) {
  std::string lines =
      "  local assigned=$previous\n"
      "  if [[ $current == := ]]; then current=; else assigned=${COMP_WORDS[COMP_CWORD - 2]-}; fi\n"
      "  if [[ $previous == := || ${COMP_WORDS[COMP_CWORD]} == := ]]; then\n"
      "    case $assigned in\n";
  std::vector<std::string> names;
  for (const ProgramWords& known : text.words) {
    lines += "      " + known.name + ") COMPREPLY=($(compgen -W '" + joined(known.words) + "' -- \"$current\")) ;;\n";
    if (known.name.find('*') == std::string::npos) names.push_back(known.name + ":=");
  }
  lines += "    esac\n    return\n  fi\n";
  return lines + "  COMPREPLY=($(compgen -W '" + optionNames(text.options) + " " + joined(names) +
         "' -- \"$current\"))\n"
         "  if [[ ${COMPREPLY[*]-} == *:= ]]; then compopt -o nospace; fi\n";
}

std::string commandCases(const ProgramText& text) {
  std::vector<std::string> names, with_value;
  for (const ProgramCommand& command : text.commands) names.push_back(command.name);
  for (const ProgramOption& option : allOptions(text)) {
    if (!option.value.empty()) with_value.push_back("--" + option.name);
  }
  std::string options;
  for (const std::string& name : with_value) options += (options.empty() ? "" : "|") + name;
  std::string lines =
      "  local command='' count=0 i\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case ${COMP_WORDS[i]} in\n"
      "      " +
      options +
      ") i=$((i + 1)) ;;\n"
      "      -*) ;;\n"
      "      *) if [[ -z $command ]]; then command=${COMP_WORDS[i]}; else count=$((count + 1)); fi ;;\n"
      "    esac\n"
      "  done\n"
      "  local options='" +
      optionNames(text.options) +
      "'\n"
      "  case $command in\n";
  for (const ProgramCommand& command : text.commands) {
    lines += "    " + command.name + ") options+=' " + optionNames(command.options) + "' ;;\n";
  }
  lines +=
      "  esac\n"
      "  if [[ $current == -* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$current\")); return; fi\n"
      "  case $command:$count in\n"
      "    :*) COMPREPLY=($(compgen -W \"" +
      joined(names) + " $options\" -- \"$current\")) ;;\n";
  for (const ProgramCommand& command : text.commands) {
    for (std::size_t i = 0; i < command.arguments.size(); ++i) {
      const std::string line = valueLine(text, command.arguments[i].value);
      if (line == "COMPREPLY=()") continue;
      lines += "    " + command.name + ":" + std::to_string(i) + ") " + line + " ;;\n";
    }
  }
  return lines + "    *) COMPREPLY=($(compgen -W \"$options\" -- \"$current\")) ;;\n  esac\n";
}

// Files of the working directory, and the configurations the package brings, wherever it is installed.
constexpr char kFiles[] =
    "_nord_driver_files() {\n"
    "  compopt -o filenames 2>/dev/null\n"
    "  mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
    "  local prefix prefixes template\n"
    "  IFS=: read -ra prefixes <<<\"${CMAKE_PREFIX_PATH-}:/usr\"\n"
    "  for prefix in \"${prefixes[@]}\"; do\n"
    "    for template in \"$prefix\"/share/nord_driver/config/templates/*.yaml; do\n"
    "      if [[ -z $current && -e $template ]]; then COMPREPLY+=(\"$template\"); fi\n"
    "    done\n"
    "  done\n"
    "}\n";

}  // namespace

std::vector<ProgramOption> commonOptions() {
  return {{"help", "", "print this and end; -h for short"},
          {"version", "", "print the version and end"},
          {"manual-page", "", "print the manual page and end"},
          {"bash-completion", "", "print what bash completes it with and end"}};
}

std::string manualPage(const ProgramText& text) {
  std::string page = ".TH " + roff(upper(text.name)) + " 1 \"\" \"nord_driver " + roff(text.version) +
                     "\" \"nord_driver\"\n.SH NAME\n" + roff(text.name) + " \\- " + roff(text.brief) +
                     "\n.SH SYNOPSIS\n.B " + roff(text.name) + "\n[\\fIOPTIONS\\fR]";
  if (!text.commands.empty()) page += " \\fICOMMAND\\fR";
  if (text.takes_ros_arguments) page += " [\\fINAME\\fR:=\\fIVALUE\\fR ...]";
  page += "\n.SH DESCRIPTION\n" + roff(text.about) + "\n";
  if (!text.examples.empty()) {
    page += ".SH EXAMPLES\n.nf\n";
    for (const std::string& example : text.examples) page += roff(example) + "\n";
    page += ".fi\n";
  }
  page += ".SH OPTIONS\n";
  for (const ProgramOption& option : text.options) page += listed(option);
  if (!text.commands.empty()) page += ".SH COMMANDS\n";
  for (const ProgramCommand& command : text.commands) page += commandSection(command);
  return page + ".SH NOTES\n" + paragraphs(text.footer);
}

std::string bashCompletion(const ProgramText& text) {
  const std::string function = "_" + text.name;
  std::string script = "# bash completion for " + text.name + ", written by " + text.name + " --bash-completion\n" +
                       kFiles + function +
                       "() {\n"
                       "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
                       "  COMPREPLY=()\n"
                       "  case $previous in\n";
  for (const ProgramOption& option : allOptions(text)) {
    if (option.value.empty()) continue;
    script += "    --" + option.name + ") " + valueLine(text, option.value) + "; return ;;\n";
  }
  script += "    --help) ;;\n  esac\n";
  if (text.takes_ros_arguments) {
    script += assignments(text);
  } else if (text.commands.empty()) {
    script += "  COMPREPLY=($(compgen -W '" + optionNames(text.options) + "' -- \"$current\"))\n";
  } else {
    script += commandCases(text);
  }
  return script + "}\ncomplete -F " + function + " " + text.name + "\n";
}

std::string nodeHelp(const ProgramText& text) {
  std::string help = text.about + "\n";
  for (const std::string& example : text.examples) help += "  " + example + "\n";
  help += "  " + text.name;
  for (const ProgramOption& option : text.options) help += " [--" + option.name + "]";
  return help + " [NAME:=VALUE ...]\n" + text.footer + "\n";
}

}  // namespace nord_driver

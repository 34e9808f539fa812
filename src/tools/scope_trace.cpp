// A trace of the driver as what one drive did: see src/trace/trace_text.h for what stands in it.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tools/scope_record.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

using Tokens = std::vector<std::string>;

Tokens tokensOf(const std::string& line) {
  std::istringstream words{line};
  Tokens tokens;
  for (std::string word; words >> word;) {
    if (word.back() == ',') word.pop_back();  // InterBus: one drive after the other
    tokens.push_back(word);
  }
  return tokens;
}

std::optional<Word> wordOf(const std::string& text) {
  if (text.size() != 4 || text.find_first_not_of("0123456789ABCDEF") != std::string::npos) return std::nullopt;
  return static_cast<Word>(std::stoul(text, nullptr, 16));
}

/// How the telegrams name a drive.
struct Name {
  std::string drive;
  std::string station;   // "3" of "PROFIBUS station 3, inverter 2"
  std::string inverter;  // "2"; empty where a module has one only

  explicit Name(const std::string& drive_name, const std::string& address) : drive(drive_name) {
    Tokens numbers;
    for (const std::string& token : tokensOf(address)) {
      if (token.find_first_not_of("0123456789") == std::string::npos) numbers.push_back(token);
    }
    if (!numbers.empty()) station = numbers[0];
    if (numbers.size() > 1) inverter = numbers[1];
  }

  /// Whether the word at `at`, "STW" or "ZSW", is of this drive.
  bool means(const Tokens& tokens, std::size_t at) const {
    if (tokens[0] != "DX") {
      const std::string& whose = tokens[at - 1];
      // DeviceNet: "answer 5 inverter 2 ZSW", or "answer 5 ZSW" where the module has one drive only.
      if (at > 3 && tokens[at - 2] == "inverter") return tokens[1] == station && whose == inverter;
      return whose == drive || whose == station || whose == station + "/" + inverter;  // InterBus; CANopen
    }
    if (tokens.size() < 4 || tokens[tokens[at] == "STW" ? 1 : 3] != station) return false;
    if (inverter.empty()) return true;
    std::size_t place = at;
    while (place > 0 && tokens[place].compare(0, 2, "FI") != 0) --place;
    return place == 0 || tokens[place] == "FI" + inverter;
  }
};

template <typename Values>
void takeValues(const Tokens& tokens, std::size_t at, const char* label, Values& values) {
  for (std::size_t i = 0; i < values.size() && at + 1 < tokens.size(); ++i, at += 2) {
    if (tokens[at] != label + std::to_string(i + 1)) return;
    const auto word = wordOf(tokens[at + 1]);
    if (!word) return;
    values[i] = toSigned(*word);
  }
}

/// The samples of a drive, telegram by telegram: each answer with the words sent last.
class Telegrams {
 public:
  explicit Telegrams(const Name& name) : name_(name) {}

  // "     -0.002050 > 68 0F ...  DX 3 <- 1 STW 047F SW1 2000"
  void take(const std::string& line) {
    const Tokens all = tokensOf(line);
    if (all.size() < 4 || (all[1] != ">" && all[1] != "<")) return;
    const std::size_t words = line.rfind("  ");  // between the bytes and their meaning
    if (words == std::string::npos) return;
    const Tokens tokens = tokensOf(line.substr(words));
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
      const bool sent = tokens[i] == "STW";
      const auto word = wordOf(tokens[i + 1]);
      if ((!sent && tokens[i] != "ZSW") || !word || !name_.means(tokens, i)) continue;
      if (sent) {
        sample_.output.control_word = *word;
        takeValues(tokens, i + 2, "SW", sample_.output.setpoints);
        continue;
      }
      sample_.input.status_word = *word;
      takeValues(tokens, i + 2, "IW", sample_.input.actual_values);
      sample_.time = std::stod(all[0]);
      sample_.answered = *word != 0;  // nothing but zeros: an inverter that is off behind its module
      samples.push_back(sample_);
    }
  }

  std::vector<ScopeSample> samples;

 private:
  const Name& name_;
  ScopeSample sample_;
};

// "     -0.010000  left   047F 2000 0000 0000  0B37 2000 0000 0000"
std::optional<ScopeSample> rowOf(const std::string& line, const std::string& drive) {
  const Tokens tokens = tokensOf(line);
  if (tokens.size() != 10 || tokens[1] != drive || tokens[0] == "time") return std::nullopt;
  ScopeSample sample;
  sample.time = std::stod(tokens[0]);
  sample.output.control_word = wordOf(tokens[2]).value_or(0);
  sample.answered = wordOf(tokens[6]).has_value();
  sample.input.status_word = wordOf(tokens[6]).value_or(0);
  for (std::size_t i = 0; i < 3; ++i) {
    sample.output.setpoints[i] = toSigned(wordOf(tokens[3 + i]).value_or(0));
    sample.input.actual_values[i] = toSigned(wordOf(tokens[7 + i]).value_or(0));
  }
  return sample;
}

}  // namespace

ScopeRecord readScopeTrace(const std::string& text, const std::string& drive) {
  const std::string head = "drive " + drive + ": ";
  const std::size_t at = text.find("\n" + head);
  if (at == std::string::npos) throw UsageError("drive \"" + drive + "\" is not in this trace");
  const std::size_t address = at + 1 + head.size();
  const Name name{drive, text.substr(address, text.find('\n', address) - address)};
  Telegrams telegrams{name};
  ScopeRecord record;
  record.drive = drive;
  std::istringstream lines{text};
  bool in_telegrams = false;
  for (std::string line; std::getline(lines, line);) {
    in_telegrams = in_telegrams || line.compare(0, 10, "telegrams,") == 0;
    if (in_telegrams) {
      telegrams.take(line);
    } else if (const auto row = rowOf(line, drive)) {
      record.samples.push_back(*row);
    }
  }
  if (telegrams.samples.size() > record.samples.size()) record.samples = std::move(telegrams.samples);
  if (record.samples.empty()) throw UsageError("this trace has no process data of drive \"" + drive + "\"");
  return record;
}

}  // namespace nord_driver::tools

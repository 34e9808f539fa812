#include "tools/scope_record.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "catalogue/yaml_map.h"
#include "profile/scaling.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

constexpr char kColumns[] = "time_s,answered,STW,SW1,SW2,SW3,ZSW,IW1,IW2,IW3,setpoint_Hz,frequency_Hz";
constexpr char kDrive[] = "# drive: ", kMaxFrequency[] = "# P105: ", kCurrent[] = "# current: IW";
constexpr char kNoSetpoint[] = "# no frequency: SW1", kNoActualValue[] = "# no frequency: IW1";
constexpr char kNoCommands[] = "# not known: STW, SW";
constexpr char kNoWords[] = "# not known: IW, and of ZSW all but the state";
constexpr unsigned kStateBits = 0x006F;  // of a status word

std::string frequencyText(std::int16_t word, const std::optional<double>& max_frequency) {
  if (!max_frequency) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", profile::fromActualValue1(word, Hertz{*max_frequency}).value);
  return text;
}

std::string valuesText(bool known, const std::array<std::int16_t, 3>& words) {
  if (!known) return ",,";
  return std::to_string(words[0]) + "," + std::to_string(words[1]) + "," + std::to_string(words[2]);
}

std::string commandText(const ScopeRecord& record, const ScopeSample& sample) {
  if (!record.commands_known) return "," + valuesText(false, {});
  char text[8];
  std::snprintf(text, sizeof text, "%04X,", static_cast<unsigned>(sample.output.control_word));
  return text + valuesText(true, sample.output.setpoints);
}

bool startsWith(const std::string& line, const std::string& start) {
  return line.compare(0, start.size(), start) == 0;
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text{line};
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// What is no such number makes the whole line wrong.
class Cells {
 public:
  explicit Cells(const std::string& line) : cells_(cellsOf(line)), good_(cells_.size() >= kRead) {}

  bool good() const { return good_; }
  double time() { return valueOr(catalogue::decimalNumber(next()), 0.0); }
  /// Where it is not known, it is empty, and 0.
  std::int16_t value(bool known = true) {
    const std::string text = next();
    if (!known && text.empty()) return 0;
    const std::int64_t number = valueOr(catalogue::wholeNumber(text), std::int64_t{0});
    good_ = good_ && number >= -32768 && number <= 32767;
    return static_cast<std::int16_t>(number);
  }
  /// Four hexadecimal digits.
  Word word(bool known = true) {
    const std::string text = next();
    if (!known && text.empty()) return 0;
    good_ = good_ && text.size() == 4 && text.find_first_not_of("0123456789ABCDEFabcdef") == std::string::npos;
    return good_ ? static_cast<Word>(std::strtoul(text.c_str(), nullptr, 16)) : Word{0};
  }

 private:
  static constexpr std::size_t kRead = 10;  // the frequencies behind them follow from these

  std::string next() { return at_ < cells_.size() ? cells_[at_++] : std::string{}; }
  template <typename Value>
  Value valueOr(const std::optional<Value>& value, Value otherwise) {
    good_ = good_ && value.has_value();
    return value.value_or(otherwise);
  }

  std::vector<std::string> cells_;
  std::size_t at_ = 0;
  bool good_;
};

ScopeSample sampleOf(const ScopeRecord& record, const std::string& line, int number) {
  ScopeSample sample;
  Cells cells{line};
  sample.time = cells.time();
  sample.answered = cells.value() != 0;
  sample.output.control_word = cells.word(record.commands_known);
  for (std::size_t i = 0; i < 3; ++i) sample.output.setpoints[i] = cells.value(record.commands_known);
  sample.input.status_word = cells.word();
  for (std::size_t i = 0; i < 3; ++i) sample.input.actual_values[i] = cells.value(record.words_known);
  if (cells.good()) return sample;
  throw UsageError("line " + std::to_string(number) + ": \"" + line + "\" is no cycle, expected " + kColumns);
}

/// "50" of "# P105: 50 Hz".
std::string behind(const std::string& line, const std::string& start) {
  return line.substr(start.size(), line.find(' ', start.size()) - start.size());
}

}  // namespace

std::string scopeCsv(const ScopeRecord& record) {
  std::string text = kDrive + record.drive + "\n";
  char line[200];
  if (record.max_frequency) {
    std::snprintf(line, sizeof line, "%s%g Hz\n", kMaxFrequency, *record.max_frequency);
    text += line;
  }
  if (record.current_word > 0) text += kCurrent + std::to_string(record.current_word) + "\n";
  if (!record.setpoint_is_frequency) text += kNoSetpoint + std::string("\n");
  if (!record.actual_value_is_frequency) text += kNoActualValue + std::string("\n");
  if (!record.commands_known) text += kNoCommands + std::string("\n");
  if (!record.words_known) text += kNoWords + std::string("\n");
  text += "# STW, ZSW: control and status word; SW, IW: setpoints and actual values, 16384 = 100 %\n";
  text += kColumns + std::string("\n");
  for (const ScopeSample& sample : record.samples) {
    const auto& sw = sample.output.setpoints;
    const auto& iw = sample.input.actual_values;
    const unsigned status = sample.input.status_word & (record.words_known ? 0xFFFFu : kStateBits);
    std::snprintf(line, sizeof line, "%.6f,%d,%s,%04X,%s,%s,%s\n", sample.time, sample.answered ? 1 : 0,
                  commandText(record, sample).c_str(), status, valuesText(record.words_known, iw).c_str(),
                  frequencyText(sw[0], record.setpointScale()).c_str(),
                  frequencyText(iw[0], record.actualValueScale()).c_str());
    text += line;
  }
  return text;
}

ScopeRecord readScopeCsv(const std::string& text) {
  ScopeRecord record;
  std::istringstream lines{text};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (startsWith(line, kDrive)) record.drive = line.substr(sizeof kDrive - 1);
    if (startsWith(line, kMaxFrequency)) record.max_frequency = catalogue::decimalNumber(behind(line, kMaxFrequency));
    if (startsWith(line, kCurrent))
      record.current_word = static_cast<int>(catalogue::wholeNumber(behind(line, kCurrent)).value_or(0));
    if (line == kNoSetpoint) record.setpoint_is_frequency = false;
    if (line == kNoCommands) record.commands_known = false;
    if (line == kNoWords) record.words_known = false;
    if (line == kNoActualValue) record.actual_value_is_frequency = false;
    if (line.empty() || line[0] == '#' || line == kColumns) continue;
    record.samples.push_back(sampleOf(record, line, number));
  }
  return record;
}

}  // namespace nord_driver::tools

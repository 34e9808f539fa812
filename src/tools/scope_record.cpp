#include "tools/scope_record.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "profile/scaling.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

namespace {

constexpr char kColumns[] = "time_s,answered,STW,SW1,SW2,SW3,ZSW,IW1,IW2,IW3,setpoint_Hz,frequency_Hz";
constexpr char kDrive[] = "# drive: ", kMaxFrequency[] = "# P105: ", kCurrent[] = "# current: IW";

std::string frequencyText(std::int16_t word, const std::optional<double>& max_frequency) {
  if (!max_frequency) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", profile::fromActualValue1(word, Hertz{*max_frequency}).value);
  return text;
}

bool startsWith(const std::string& line, const std::string& start) {
  return line.compare(0, start.size(), start) == 0;
}

ScopeSample sampleOf(const std::string& line, int number) {
  ScopeSample sample;
  int answered = 0;
  unsigned control = 0, status = 0;
  std::array<int, 3> setpoints{}, actual_values{};
  const int found =
      std::sscanf(line.c_str(), "%lf,%d,%x,%d,%d,%d,%x,%d,%d,%d", &sample.time, &answered, &control, &setpoints[0],
                  &setpoints[1], &setpoints[2], &status, &actual_values[0], &actual_values[1], &actual_values[2]);
  if (found != 10) {
    throw UsageError("line " + std::to_string(number) + ": \"" + line + "\" is no cycle, expected " + kColumns);
  }
  sample.answered = answered != 0;
  sample.output.control_word = static_cast<Word>(control);
  sample.input.status_word = static_cast<Word>(status);
  for (std::size_t i = 0; i < 3; ++i) {
    sample.output.setpoints[i] = static_cast<std::int16_t>(setpoints[i]);
    sample.input.actual_values[i] = static_cast<std::int16_t>(actual_values[i]);
  }
  return sample;
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
  text += "# STW, ZSW: control and status word; SW, IW: setpoints and actual values, 16384 = 100 %\n";
  text += kColumns + std::string("\n");
  for (const ScopeSample& sample : record.samples) {
    const auto& sw = sample.output.setpoints;
    const auto& iw = sample.input.actual_values;
    std::snprintf(line, sizeof line, "%.6f,%d,%04X,%d,%d,%d,%04X,%d,%d,%d,%s,%s\n", sample.time,
                  sample.answered ? 1 : 0, static_cast<unsigned>(sample.output.control_word), sw[0], sw[1], sw[2],
                  static_cast<unsigned>(sample.input.status_word), iw[0], iw[1], iw[2],
                  frequencyText(sw[0], record.max_frequency).c_str(),
                  frequencyText(iw[0], record.max_frequency).c_str());
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
    if (startsWith(line, kMaxFrequency)) record.max_frequency = std::atof(line.c_str() + sizeof kMaxFrequency - 1);
    if (startsWith(line, kCurrent)) record.current_word = std::atoi(line.c_str() + sizeof kCurrent - 1);
    if (line.empty() || line[0] == '#' || line == kColumns) continue;
    record.samples.push_back(sampleOf(line, number));
  }
  return record;
}

}  // namespace nord_driver::tools

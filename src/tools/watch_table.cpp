#include "tools/watch_table.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>

#include "nord_driver/core/bytes.h"
#include "profile/scaling.h"
#include "profile/status_word.h"
#include "tools/json_text.h"

namespace nord_driver::tools {

namespace {

double percent(std::int16_t word) {
  return 100.0 * word / profile::kHundredPercent;
}

std::string percentText(std::int16_t word) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f %% (%s)", percent(word), toHexWord(toWord(word)).c_str());
  return text;
}

constexpr char kUntold[] = "not known";

std::string frequencyText(const WatchedDrive& drive) {
  if (!drive.frequency) return kUntold;
  char text[32];
  std::snprintf(text, sizeof text, "%.2f Hz", *drive.frequency);
  return text;
}

std::string setpointText(const WatchedDrive& drive, std::size_t i) {
  return drive.commands_known ? percentText(drive.output.setpoints[i]) : kUntold;
}

std::string actualValueText(const WatchedDrive& drive, std::size_t i) {
  return drive.words_known ? percentText(drive.input.actual_values[i]) : kUntold;
}

std::string statusText(const WatchedDrive& drive) {
  return drive.words_known ? toHexWord(drive.input.status_word) : kUntold;
}

const char* stateText(const WatchedDrive& drive) {
  if (!drive.state_known) return kUntold;
  return profile::toString(profile::StatusWord{drive.input.status_word}.state());
}

struct Row {
  std::string label;
  std::function<std::string(const WatchedDrive&)> cell;  // of a drive that is online
};

std::string numbered(const char* label, std::size_t number) {
  return label + std::to_string(number + 1);
}

std::vector<Row> rowsOf(std::size_t process_values, const std::vector<std::string>& parameters) {
  std::vector<Row> rows;
  rows.push_back({"status word", statusText});
  rows.push_back({"state", stateText});
  rows.push_back({"parameter set", [](const WatchedDrive& drive) {
                    if (!drive.words_known) return std::string{kUntold};
                    return std::to_string(profile::StatusWord{drive.input.status_word}.parameterSet());
                  }});
  if (process_values > 0) {
    rows.push_back({"control word", [](const WatchedDrive& drive) {
                      return drive.commands_known ? toHexWord(drive.output.control_word) : kUntold;
                    }});
  }
  for (std::size_t i = 0; i < process_values; ++i) {
    rows.push_back({numbered("setpoint ", i), [i](const WatchedDrive& drive) {
                      return i < drive.process_values ? setpointText(drive, i) : std::string{};
                    }});
  }
  for (std::size_t i = 0; i < process_values; ++i) {
    rows.push_back({numbered("actual value ", i), [i](const WatchedDrive& drive) {
                      return i < drive.process_values ? actualValueText(drive, i) : std::string{};
                    }});
  }
  if (process_values > 0) rows.push_back({"frequency", frequencyText});
  rows.push_back({"fault", [](const WatchedDrive& drive) { return drive.fault; }});
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    rows.push_back({parameters[i], [i](const WatchedDrive& drive) { return drive.values[i]; }});
  }
  return rows;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

std::string trimmed(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string silenceOf(const WatchedDrive& drive) {
  return "does not answer" + (drive.silence.empty() ? "" : ": " + drive.silence);
}

}  // namespace

std::string watchTable(const std::vector<WatchedDrive>& drives, const std::vector<std::string>& parameters) {
  std::size_t process_values = 0;
  for (const WatchedDrive& drive : drives) process_values = std::max<std::size_t>(process_values, drive.process_values);
  const std::vector<Row> rows = rowsOf(process_values, parameters);
  std::vector<std::string> lines{""};
  for (const Row& row : rows) lines.push_back(row.label);
  for (const WatchedDrive& drive : drives) {
    std::size_t width = 0;
    for (const std::string& line : lines) width = std::max(width, line.size() + 2);
    for (std::string& line : lines) line = padded(line, width);
    lines[0] += drive.name;
    if (!drive.online) {
      lines[1] += silenceOf(drive);
      continue;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) lines[i + 1] += rows[i].cell(drive);
  }
  std::string text;
  for (const std::string& line : lines) text += trimmed(line) + "\n";
  return text;
}

std::string watchLine(double time, const WatchedDrive& drive, const std::vector<std::string>& parameters) {
  char start[32];
  std::snprintf(start, sizeof start, "%9.3f s  ", time);
  std::string text = start + drive.name + "  ";
  if (!drive.online) return text + silenceOf(drive) + "\n";
  if (drive.words_known) text += toHexWord(drive.input.status_word) + " ";
  text += drive.state_known || drive.words_known ? stateText(drive) : "state not known";
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    text += "  SW" + std::to_string(i + 1) + " " + setpointText(drive, i);
  }
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    text += "  IW" + std::to_string(i + 1) + " " + actualValueText(drive, i);
  }
  if (drive.process_values > 0) text += "  frequency " + frequencyText(drive);
  text += "  fault " + drive.fault;
  for (std::size_t i = 0; i < parameters.size(); ++i) text += "  " + parameters[i] + " " + drive.values[i];
  return text + "\n";
}

std::string watchJson(double time, const WatchedDrive& drive, const std::vector<std::string>& parameters) {
  JsonText json;
  json.begin('{');
  json.key("time").number(time);
  json.key("drive").text(drive.name);
  json.key("online").boolean(drive.online);
  if (!drive.online) {
    json.key("silence").text(drive.silence);
    json.end('}');
    return json.str() + "\n";
  }
  const auto known = [](bool told, double value) { return told ? value : std::numeric_limits<double>::quiet_NaN(); };
  json.key("status_word").number(known(drive.words_known, drive.input.status_word));
  json.key("state").text(stateText(drive));
  json.key("setpoints").begin('[');
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    json.number(known(drive.commands_known, percent(drive.output.setpoints[i])));
  }
  json.end(']');
  json.key("actual_values").begin('[');
  for (std::size_t i = 0; i < drive.process_values; ++i) {
    json.number(known(drive.words_known, percent(drive.input.actual_values[i])));
  }
  json.end(']');
  json.key("frequency").number(drive.frequency.value_or(std::numeric_limits<double>::quiet_NaN()));
  json.key("fault").text(drive.fault);
  json.key("parameters").begin('{');
  for (std::size_t i = 0; i < parameters.size(); ++i) json.key(parameters[i]).text(drive.values[i]);
  json.end('}');
  json.end('}');
  return json.str() + "\n";
}

}  // namespace nord_driver::tools

#include "state/eeprom_counts.h"

#include <regex>
#include <sstream>

#include "state/utc_day.h"

namespace nord_driver::state {

namespace {

constexpr const char* kAbout =
    "# EEPROM writes of the drives, counted by nord_driver before they are done (eeprom_budget).\n";
constexpr const char* kSchema = "schema: 1";
constexpr const char* kDrives = "drives:";

// YAML in double quotes; no line may break in them.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
  }
  return result + "\"";
}

std::string unquoted(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') ++i;
    result += text[i];
  }
  return result;
}

StateError broken(const std::string& file, std::size_t line, const std::string& found, const std::string& expected) {
  return StateError{file + ", line " + std::to_string(line) + ": \"" + found + "\", expected " + expected};
}

}  // namespace

std::string textOf(const EepromCounts& counts) {
  std::string text = std::string(kAbout) + kSchema + "\n" + kDrives + "\n";
  for (const auto& [drive, count] : counts) {
    text += "  " + quoted(drive) + ": {day: " + dayText(count.day) + ", writes: " + std::to_string(count.writes) +
            ", total: " + std::to_string(count.total) + "}\n";
  }
  return text;
}

EepromCounts countsFrom(const std::string& text, const std::string& file) {
  // At most 18 figures, which no conversion refuses.
  static const std::regex kDrive(
      R"re(  "((?:[^"\\]|\\.)+)": \{day: ([0-9]{4}-[0-9]{2}-[0-9]{2}), writes: ([0-9]{1,18}), total: ([0-9]{1,18})\})re");
  EepromCounts counts;
  std::istringstream lines(text);
  std::size_t number = 0;
  bool schema = false, drives = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (!schema) {
      if (line != kSchema) throw broken(file, number, line, std::string(kSchema) + ", a file of this version");
      schema = true;
      continue;
    }
    if (!drives) {
      if (line != kDrives) throw broken(file, number, line, kDrives);
      drives = true;
      continue;
    }
    std::smatch match;
    const bool matches = std::regex_match(line, match, kDrive);
    const auto day = matches ? dayFrom(match[2]) : std::nullopt;
    if (!day) throw broken(file, number, line, "\"a drive\": {day: 2026-11-23, writes: 3, total: 41}");
    const EepromCount count{*day, std::stoull(match[3]), std::stoull(match[4])};
    if (!counts.emplace(unquoted(match[1]), count).second) throw broken(file, number, line, "each drive once");
  }
  if (!drives) throw StateError(file + " ends before its line \"" + kDrives + "\": it is no whole file of this kind");
  return counts;
}

}  // namespace nord_driver::state

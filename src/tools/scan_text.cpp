#include "tools/scan_text.h"

#include <algorithm>
#include <array>

#include "tools/json_text.h"

namespace nord_driver::tools {

std::string scanText(const ScanReport& report) {
  if (report.stations.empty()) return report.trouble.empty() ? report.bus + ": nobody answered\n" : "";
  using Cells = std::array<std::string, 5>;
  std::vector<Cells> rows{{report.number_name, "module", "series", "version", ""}};
  for (const FoundStation& station : report.stations) {
    rows.push_back({std::to_string(station.number), station.module, station.series, station.version, station.note});
  }
  std::array<std::size_t, 5> widths{};
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text = report.bus + ":\n";
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::string cell = row[i];
      cell.resize(widths[i], ' ');
      line += "  " + cell;
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const std::string& note : report.notes) text += note + "\n";
  return text;
}

std::string scanJson(const ScanReport& report) {
  JsonText json;
  json.begin('{');
  json.key("bus").text(report.bus);
  json.key("stations").begin('[');
  for (const FoundStation& station : report.stations) {
    json.begin('{');
    json.key("address").number(station.number);
    json.key("module").text(station.module);
    json.key("series").text(station.series);
    json.key("version").text(station.version);
    json.key("note").text(station.note);
    json.end('}');
  }
  json.end(']');
  json.key("notes").begin('[');
  for (const std::string& note : report.notes) json.text(note);
  json.end(']');
  json.key("trouble").text(report.trouble);
  json.end('}');
  return json.str() + "\n";
}

}  // namespace nord_driver::tools

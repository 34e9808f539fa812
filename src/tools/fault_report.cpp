#include "tools/fault_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

#include "catalogue/parameter_access.h"
#include "tools/json_text.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kCurrent = 700, kLast = 701;
constexpr std::uint8_t kLastFaults = 5;
// What inverters store with each fault of P701, in the same elements.
constexpr std::array<std::uint16_t, 6> kStored{702, 703, 704, 705, 706, 799};
constexpr char kIndent[] = "                  ";

ParameterAnswer readElement(DriveParameters& drive, std::uint16_t number, std::uint8_t index,
                            const std::atomic<bool>& end_asked) {
  if (end_asked) throw Trouble("ended before all faults were read");
  catalogue::ParameterAddress address;
  address.number = number;
  address.index = index;
  ParameterAnswer answer = drive.read(address);
  if (!answer.success && !answer.refused) throw Trouble(answer.message);
  return answer;
}

std::string numberText(std::uint16_t raw) {
  char text[16];
  std::snprintf(text, sizeof text, "%u.%u", raw / 10u, raw % 10u);
  return text;
}

FaultReport::Item readItem(DriveParameters& drive, std::uint16_t number, std::uint8_t index, const std::string& title,
                           const std::atomic<bool>& end_asked) {
  const ParameterAnswer answer = readElement(drive, number, index, end_asked);
  FaultReport::Item item;
  item.title = title;
  if (!answer.success) {
    item.why_not = answer.message;
    return item;
  }
  item.raw = static_cast<std::uint16_t>(answer.raw & 0xFFFF);
  if (*item.raw == 0) return item;
  // Warnings and blocks have numbers of their own, and the files describe faults only.
  const bool is_fault = number == kLast || index == 1;
  if (!is_fault) {
    item.label = numberText(*item.raw);
    item.remedy = "see its number in the inverter's manual";
    return item;
  }
  const catalogue::FaultWords& words = drive.known().faults();
  item.label = catalogue::FaultWords::label(*item.raw);
  item.name = words.name(*item.raw);
  item.cause = words.cause(*item.raw);
  item.remedy = words.remedy(*item.raw);
  return item;
}

void readStored(DriveParameters& drive, FaultReport::Item& item, std::uint8_t fault,
                const std::atomic<bool>& end_asked) {
  for (const std::uint16_t number : kStored) {
    const catalogue::ParameterEntry* const entry = drive.known().find(number);
    if (entry == nullptr || fault > entry->elements.value_or(1)) continue;
    const std::uint8_t index = entry->elements ? fault : std::uint8_t{0};
    const ParameterAnswer answer = readElement(drive, number, index, end_asked);
    if (!answer.success) continue;
    const unsigned element = std::max<unsigned>(index, 1);
    item.values.push_back(
        {entry->title(), drive.known().valueText(entry, answer.raw, element), answer.value, entry->unitOf(element)});
  }
}

std::string titled(const std::string& title) {
  std::string text = title;
  text.resize(std::max(text.size() + 2, sizeof kIndent - 1), ' ');
  return text;
}

std::string lines(const FaultReport::Item& item) {
  std::string text = titled(item.title);
  if (!item.raw) return text + "not told: " + item.why_not + "\n";
  if (*item.raw == 0) return text + "none\n";
  text += item.label + (item.name.empty() ? "" : "  " + item.name) + "\n";
  if (!item.cause.empty()) text += kIndent + ("cause   " + item.cause) + "\n";
  if (!item.remedy.empty()) text += kIndent + ("remedy  " + item.remedy) + "\n";
  for (const FaultReport::Value& value : item.values) text += kIndent + (value.name + " = " + value.text) + "\n";
  return text;
}

void add(JsonText& json, const FaultReport::Item& item) {
  json.begin('{');
  json.key("number").number(item.raw ? *item.raw / 10.0 : std::numeric_limits<double>::quiet_NaN());
  json.key("label").text(item.label);
  json.key("name").text(item.name);
  json.key("cause").text(item.cause);
  json.key("remedy").text(item.remedy);
  if (!item.raw) json.key("not_told").text(item.why_not);
  json.key("values").begin('[');
  for (const FaultReport::Value& value : item.values) {
    json.begin('{');
    json.key("name").text(value.name);
    json.key("value").number(value.value);
    json.key("unit").text(value.unit);
    json.end('}');
  }
  json.end(']');
  json.end('}');
}

}  // namespace

FaultReport readFaults(DriveParameters& drive, const std::atomic<bool>& end_asked) {
  FaultReport report;
  report.error = readItem(drive, kCurrent, 1, "current error", end_asked);
  report.warning = readItem(drive, kCurrent, 2, "current warning", end_asked);
  report.block = readItem(drive, kCurrent, 3, "switch-on block", end_asked);
  for (std::uint8_t i = 1; i <= kLastFaults; ++i) {
    report.last.push_back(readItem(drive, kLast, i, "last fault " + std::to_string(i), end_asked));
    // Older faults are not there either; and what stands beside none means nothing.
    if (report.last.back().raw.value_or(0) != 0) readStored(drive, report.last.back(), i, end_asked);
  }

  report.note = drive.changedByReading();
  return report;
}

std::string faultText(const FaultReport& report, const DriveParameters& drive) {
  std::string text =
      "drive " + drive.name() + ", " + drive.identity().address + ", " + profile::toString(drive.series()) + "\n";
  text += lines(report.error) + lines(report.warning) + lines(report.block);
  std::size_t told = report.last.size();
  while (told > 0 && report.last[told - 1].raw == 0) --told;
  if (told == 0) text += titled("last faults") + "none\n";
  for (std::size_t i = 0; i < told; ++i) text += lines(report.last[i]);
  if (!report.note.empty()) text += report.note + "\n";
  return text;
}

std::string faultJson(const FaultReport& report, const DriveParameters& drive) {
  JsonText json;
  json.begin('{');
  json.key("drive").text(drive.name());
  json.key("address").text(drive.identity().address);
  json.key("series").text(profile::toString(drive.series()));
  json.key("error");
  add(json, report.error);
  json.key("warning");
  add(json, report.warning);
  json.key("switch_on_block");
  add(json, report.block);
  json.key("last").begin('[');
  for (const FaultReport::Item& item : report.last) add(json, item);
  json.end(']');
  json.key("note").text(report.note);
  json.end('}');
  return json.str() + "\n";
}

}  // namespace nord_driver::tools

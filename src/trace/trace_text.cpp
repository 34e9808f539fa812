#include "trace/trace_text.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "core/version.h"

namespace nord_driver::trace {

namespace {

using std::chrono::microseconds;

/// Seconds from `zero` with six decimals, right-aligned.
std::string timeText(Instant time, Instant zero) {
  char text[32];
  std::snprintf(text, sizeof text, "%14.6f", toSeconds(time - zero));
  return text;
}

std::string wordsText(Word first, const std::array<std::int16_t, profile::kMaxProcessValues>& rest) {
  std::string text = toHexWord(first);
  for (const std::int16_t value : rest) text += " " + toHexWord(toWord(value));
  return text;
}

void addProcessData(std::string& text, const TracePage& page, const std::vector<TracedDrive>& drives) {
  std::size_t width = 5;
  for (const TracedDrive& drive : drives) width = std::max(width, drive.name.size());
  const auto padded = [width](std::string name) {
    name.resize(std::max(width, name.size()), ' ');
    return name;
  };
  text += "\nprocess data: time in s, words hexadecimal, ---- where the inverter did not answer in that cycle\n";
  text += "          time  " + padded("drive") + "  STW  SW1  SW2  SW3   ZSW  IW1  IW2  IW3\n";
  for (const ProcessDataRecord& record : page.process_data) {
    text +=
        timeText(record.time, page.time) + "  " + padded(drives[record.drive].name) + "  " +
        wordsText(record.output.control_word, record.output.setpoints) + "  " +
        (record.answered ? wordsText(record.input.status_word, record.input.actual_values) : "---- ---- ---- ----") +
        "\n";
  }
}

void addTelegrams(std::string& text, const TracePage& page, const TelegramTrace& trace) {
  // A data exchange of PPO 1, or 1B2#310B000000000000.
  const std::size_t width = trace.linkType() == kLinkTypeCanSocketCan ? 20 : 62;
  text += "\ntelegrams, " + std::to_string(page.telegrams.size()) +
          ": time in s, > sent, < received, ? bytes that are no telegram\n";
  for (const TraceRecord& record : page.telegrams) {
    const char sign = record.kind == TraceKind::kSent ? '>' : record.kind == TraceKind::kReceived ? '<' : '?';
    std::string raw = trace.raw(record);
    raw.resize(std::max(raw.size(), width), ' ');
    text += timeText(record.time, page.time) + " " + sign + " " + raw + "  " + trace.describe(record) + "\n";
  }
}

}  // namespace

microseconds TraceClock::wallTime(Instant when) const noexcept {
  return std::chrono::floor<microseconds>(wall.time_since_epoch() + (when - bus));
}

std::string utcText(microseconds since_1970) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(since_1970);
  const auto seconds_since_1970 = static_cast<std::time_t>(whole.count());
  std::tm utc{};
  gmtime_r(&seconds_since_1970, &utc);
  char date[32], text[48];
  std::strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S", &utc);
  std::snprintf(text, sizeof text, "%s.%06d", date, static_cast<int>((since_1970 - whole).count()));
  return text;
}

std::string traceText(const TracePage& page, const std::vector<TracedDrive>& drives, const TelegramTrace* trace,
                      const TraceClock& clock) {
  std::string text = std::string("nord_driver ") + kVersion + " trace\n";
  for (const std::string& reason : page.reasons) text += "reason: " + reason + "\n";
  text += "time 0: " + utcText(clock.wallTime(page.time)) + " UTC\n";
  for (const TracedDrive& drive : drives) text += "drive " + drive.name + ": " + drive.address + "\n";
  addProcessData(text, page, drives);
  if (trace != nullptr) {
    addTelegrams(text, page, *trace);
  } else {
    text += "\ntelegrams: this transport keeps none\n";
  }
  return text;
}

}  // namespace nord_driver::trace

#include <cstdio>

#include "profile/scaling.h"
#include "tools/json_text.h"
#include "tools/scope_record.h"

namespace nord_driver::tools {

namespace {

std::string hexText(Word word) {
  char text[8];
  std::snprintf(text, sizeof text, "%04X", static_cast<unsigned>(word));
  return text;
}

void addFrequency(JsonText& json, const char* key, std::int16_t word, const std::optional<double>& max_frequency) {
  if (max_frequency) json.key(key).number(profile::fromActualValue1(word, Hertz{*max_frequency}).value);
}

}  // namespace

std::string scopeJson(const ScopeRecord& record) {
  std::string text;
  for (const ScopeSample& sample : record.samples) {
    JsonText json;
    json.begin('{').key("drive").text(record.drive);
    json.key("time_s").number(sample.time).key("answered").boolean(sample.answered);
    json.key("STW").text(hexText(sample.output.control_word));
    for (std::size_t i = 0; i < 3; ++i) json.key("SW" + std::to_string(i + 1)).whole(sample.output.setpoints[i]);
    json.key("ZSW").text(hexText(sample.input.status_word));
    for (std::size_t i = 0; i < 3; ++i) json.key("IW" + std::to_string(i + 1)).whole(sample.input.actual_values[i]);
    addFrequency(json, "setpoint_Hz", sample.output.setpoints[0], record.setpointScale());
    addFrequency(json, "frequency_Hz", sample.input.actual_values[0], record.actualValueScale());
    text += json.end('}').str() + "\n";
  }
  return text;
}

}  // namespace nord_driver::tools

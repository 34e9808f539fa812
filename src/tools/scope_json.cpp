#include <array>
#include <cstdio>
#include <limits>

#include "profile/scaling.h"
#include "profile/status_word.h"
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

void addWords(JsonText& json, bool known, const char* word_key, Word word, const std::string& key,
              const std::array<std::int16_t, 3>& values) {
  constexpr double kNull = std::numeric_limits<double>::quiet_NaN();
  json.key(word_key);
  known ? json.text(hexText(word)) : json.number(kNull);
  for (std::size_t i = 0; i < values.size(); ++i) {
    json.key(key + std::to_string(i + 1));
    known ? json.whole(values[i]) : json.number(kNull);
  }
}

}  // namespace

std::string scopeJson(const ScopeRecord& record) {
  std::string text;
  for (const ScopeSample& sample : record.samples) {
    JsonText json;
    json.begin('{').key("drive").text(record.drive);
    json.key("time_s").number(sample.time).key("answered").boolean(sample.answered);
    addWords(json, record.commands_known, "STW", sample.output.control_word, "SW", sample.output.setpoints);
    addWords(json, record.words_known, "ZSW", sample.input.status_word, "IW", sample.input.actual_values);
    if (!record.words_known) {
      json.key("state").text(profile::toString(profile::StatusWord{sample.input.status_word}.state()));
    }
    addFrequency(json, "setpoint_Hz", sample.output.setpoints[0], record.setpointScale());
    addFrequency(json, "frequency_Hz", sample.input.actual_values[0], record.actualValueScale());
    text += json.end('}').str() + "\n";
  }
  return text;
}

}  // namespace nord_driver::tools

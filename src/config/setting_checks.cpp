#include "config/setting_checks.h"

#include <cmath>
#include <sstream>

#include "config/nearest_name.h"
#include "config/setting_note.h"

namespace nord_driver {

namespace {

constexpr const char* kNumber = "a number";
constexpr const char* kWholeNumber = "a whole number";

std::string rangeText(const std::string& kind, const std::string& min, const std::string& max,
                      const std::string& unit) {
  return kind + " from " + min + " to " + max + (unit.empty() ? "" : " " + unit);
}

double checkedNumber(const Settings& settings, const std::string& key, double value, double min, double max,
                     const std::string& unit) {
  if (std::isfinite(value) && value >= min && value <= max) return value;
  throw wrongSetting(settings, key, shortNumber(value), rangeText(kNumber, shortNumber(min), shortNumber(max), unit));
}

std::int64_t checkedInteger(const Settings& settings, const std::string& key, std::int64_t value, std::int64_t min,
                            std::int64_t max) {
  if (value >= min && value <= max) return value;
  throw wrongSetting(settings, key, std::to_string(value),
                     rangeText(kWholeNumber, std::to_string(min), std::to_string(max), ""));
}

}  // namespace

ConfigError wrongSetting(const Settings& settings, const std::string& key, const std::string& value,
                         const std::string& expected) {
  return ConfigError(settings.fullName(key) + ": " + value + " is not valid, expected " + expected);
}

ConfigError missingSetting(const Settings& settings, const std::string& key, const std::string& expected) {
  const std::string given = nearestName(key, settings.keys());
  return ConfigError(settings.fullName(key) + " is missing: expected " + expected +
                     (given.empty() ? "" : "; did you mean it by " + settings.fullName(given) + "?"));
}

double numberOr(const Settings& settings, const std::string& key, double fallback, double min, double max,
                const std::string& unit) {
  const std::string usual = fallback < min ? "" : shortNumber(fallback);  // what nobody may write stands for none
  noteSetting(settings, key, {kNumber, shortNumber(min) + " to " + shortNumber(max), unit, usual});
  return checkedNumber(settings, key, settings.number(key).value_or(fallback), min, max, unit);
}

double requiredNumber(const Settings& settings, const std::string& key, double min, double max,
                      const std::string& unit) {
  noteSetting(settings, key, {kNumber, shortNumber(min) + " to " + shortNumber(max), unit, ""});
  const auto value = settings.number(key);
  if (!value) throw missingSetting(settings, key, rangeText(kNumber, shortNumber(min), shortNumber(max), unit));
  return checkedNumber(settings, key, *value, min, max, unit);
}

Duration wholeMillisecondsOr(const Settings& settings, const std::string& key, Duration fallback, Duration min,
                             Duration max, const std::string& example) {
  constexpr double kTolerance = 1e-6;  // ms
  const double value = numberOr(settings, key, toSeconds(fallback), toSeconds(min), toSeconds(max), "s");
  const double count = std::round(value * 1e3);
  if (std::abs(value * 1e3 - count) > kTolerance) {
    throw wrongSetting(settings, key, shortNumber(value), "whole milliseconds, such as " + example);
  }
  return std::chrono::milliseconds{static_cast<std::int64_t>(count)};
}

std::int64_t integerOr(const Settings& settings, const std::string& key, std::int64_t fallback, std::int64_t min,
                       std::int64_t max) {
  const std::string range = std::to_string(min) + " to " + std::to_string(max);
  noteSetting(settings, key, {kWholeNumber, range, "", std::to_string(fallback)});
  return checkedInteger(settings, key, settings.integer(key).value_or(fallback), min, max);
}

std::int64_t requiredInteger(const Settings& settings, const std::string& key, std::int64_t min, std::int64_t max) {
  noteSetting(settings, key, {kWholeNumber, std::to_string(min) + " to " + std::to_string(max), "", ""});
  const auto value = settings.integer(key);
  if (!value) {
    throw missingSetting(settings, key, rangeText(kWholeNumber, std::to_string(min), std::to_string(max), ""));
  }
  return checkedInteger(settings, key, *value, min, max);
}

bool booleanOr(const Settings& settings, const std::string& key, bool fallback) {
  noteSetting(settings, key, {"true or false", "", "", fallback ? "true" : "false"});
  return settings.boolean(key).value_or(fallback);
}

std::string textOr(const Settings& settings, const std::string& key, const std::string& fallback) {
  noteSetting(settings, key, {"a text", "", "", fallback});
  return settings.text(key).value_or(fallback);
}

std::string wordOr(const Settings& settings, const std::string& key, const std::string& fallback,
                   const std::string& words) {
  noteSetting(settings, key, {"one of " + words, "", "", fallback});
  return settings.text(key).value_or(fallback);
}

std::string requiredText(const Settings& settings, const std::string& key, const std::string& expected) {
  const auto value = settings.text(key);
  if (!value) throw missingSetting(settings, key, expected);
  if (value->empty()) throw wrongSetting(settings, key, "\"\"", expected);
  return *value;
}

std::string shortNumber(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace nord_driver

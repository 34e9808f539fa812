// Reading one value of a configuration with its range: the sentence of a refusal is made in one place.
#pragma once

#include <cstdint>
#include <string>

#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// "~bus/baud_rate: 12345 is not one of 9600, ..."; throw what this returns.
ConfigError wrongSetting(const Settings& settings, const std::string& key, const std::string& value,
                         const std::string& expected);

/// "~bus/device is missing: expected ..."; throw what this returns. A key that is there and may be a slip of the
/// missing one is named with it.
ConfigError missingSetting(const Settings& settings, const std::string& key, const std::string& expected);

/// The number at `key`, or `fallback` when it is absent. Throws ConfigError outside min..max (both included) and for
/// NaN and infinity. `unit` is named in the sentence ("s", "Hz"; may be empty).
double numberOr(const Settings& settings, const std::string& key, double fallback, double min, double max,
                const std::string& unit);

/// The number at `key`, which must be there.
double requiredNumber(const Settings& settings, const std::string& key, double min, double max,
                      const std::string& unit);

/// The time in s at `key` as the whole milliseconds something counts; `example` and who counts them are named when
/// it is none: "0.1 s: the object counts them".
Duration wholeMillisecondsOr(const Settings& settings, const std::string& key, Duration fallback, Duration min,
                             Duration max, const std::string& example);

std::int64_t integerOr(const Settings& settings, const std::string& key, std::int64_t fallback, std::int64_t min,
                       std::int64_t max);
std::int64_t requiredInteger(const Settings& settings, const std::string& key, std::int64_t min, std::int64_t max);

/// True or false at `key`, or `fallback` when it is absent.
bool booleanOr(const Settings& settings, const std::string& key, bool fallback);

/// The text at `key`, or `fallback` when it is absent.
std::string textOr(const Settings& settings, const std::string& key, const std::string& fallback);
/// The same where only some `words` ("index, slot") are good; whether it is one of them is the caller's to check.
std::string wordOr(const Settings& settings, const std::string& key, const std::string& fallback,
                   const std::string& words);

std::string requiredText(const Settings& settings, const std::string& key, const std::string& expected);

/// "0.2" and "20", not "0.200000".
std::string shortNumber(double value);

}  // namespace nord_driver

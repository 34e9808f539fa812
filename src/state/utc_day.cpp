#include "state/utc_day.h"

#include <time.h>

#include <cstdio>

namespace nord_driver::state {

namespace {

constexpr std::int64_t kDaySeconds = 86'400;

}  // namespace

std::int64_t utcDay(WallTime time) noexcept {
  const std::int64_t seconds = std::chrono::floor<std::chrono::seconds>(time.time_since_epoch()).count();
  return (seconds >= 0 ? seconds : seconds - (kDaySeconds - 1)) / kDaySeconds;
}

std::string dayText(std::int64_t day) {
  const std::time_t seconds = static_cast<std::time_t>(day * kDaySeconds);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[64];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
  return text;
}

std::optional<std::int64_t> dayFrom(const std::string& text) noexcept {
  std::tm parts{};
  const char* end = ::strptime(text.c_str(), "%Y-%m-%d", &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  const std::int64_t day = static_cast<std::int64_t>(::timegm(&parts)) / kDaySeconds;
  // What timegm makes of a 31st of February is another day.
  if (dayText(day) != text) return std::nullopt;
  return day;
}

}  // namespace nord_driver::state

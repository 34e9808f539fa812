#include "profile/leading_function.h"

namespace nord_driver::profile {

namespace {

constexpr std::int32_t kSystemBusBroadcast = 4, kCanBroadcast = 9, kCanopenBroadcast = 10;
constexpr std::int32_t kDpControlWord = 9, kIbsControlWord = 13;

}  // namespace

bool isBroadcastControlWord(Series series, std::int32_t source) noexcept {
  switch (series) {
    case Series::kSk1x0e:
    case Series::kSk2xxe:
      return source == kSystemBusBroadcast;
    case Series::kSk5xxe:
    case Series::kSk54xe:
      return source == kCanBroadcast || source == kCanopenBroadcast;
    case Series::kSk300e:
    case Series::kSk700e:
    case Series::kSk750e:
      break;
  }
  return false;
}

bool isBroadcastSetpoint(Series series, std::int32_t source) noexcept {
  return isBroadcastControlWord(series, source);  // the same numbers, as far as they are printed
}

bool isControlWordAlone(Series series, std::int32_t source) noexcept {
  const bool is_older = series == Series::kSk300e || series == Series::kSk700e || series == Series::kSk750e;
  return is_older && (source == kDpControlWord || source == kIbsControlWord);
}

bool isLed(Series series, std::optional<std::int32_t> control_word, std::optional<std::int32_t> setpoint) noexcept {
  if (setpoint && isBroadcastSetpoint(series, *setpoint)) return true;
  return control_word && isBroadcastControlWord(series, *control_word) && setpoint.value_or(0) == 0;
}

}  // namespace nord_driver::profile

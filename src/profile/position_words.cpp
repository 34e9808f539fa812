#include "nord_driver/profile/position_words.h"

namespace nord_driver::profile {

namespace {

// SK 7x0E: the field takes PZD2 and PZD3, which in the manual's order are values 1 and 3. No manual says which word
// comes first: the high one, as PROFIBUS sends all its 32 bit values.
constexpr PositionWords kOneField = {2, 0};

constexpr std::uint16_t kPosition32 = 3, kIncrements32 = 6;            // P546 of SK 7x0E
constexpr std::uint16_t kActualPosition7 = 6, kSetpointPosition7 = 7;  // P543 of SK 7x0E
constexpr std::uint16_t kActualIncrements7 = 10, kSetpointIncrements7 = 11;
constexpr std::uint16_t kPositionLow = 21, kPositionHigh = 22;  // P546..P548 of the others
constexpr std::uint16_t kIncrementsLow = 23, kIncrementsHigh = 24;
constexpr std::uint16_t kActualLow = 10, kActualHigh = 15;  // P543..P545 of the others

bool hasOneField(Series series) noexcept {
  return series == Series::kSk700e || series == Series::kSk750e;
}

bool hasTwoWords(Series series) noexcept {
  return series == Series::kSk2xxe || series == Series::kSk5xxe || series == Series::kSk54xe;
}

std::optional<std::uint8_t> find(const ValueFunctions& functions, std::uint16_t wanted) noexcept {
  for (std::size_t i = 0; i < functions.size(); ++i) {
    if (functions[i] == wanted) return static_cast<std::uint8_t>(i);
  }
  return std::nullopt;
}

std::optional<PositionWords> findPair(const ValueFunctions& functions, std::uint16_t low, std::uint16_t high) noexcept {
  const auto low_at = find(functions, low);
  const auto high_at = find(functions, high);
  if (!low_at.has_value() || !high_at.has_value()) return std::nullopt;
  return PositionWords{*low_at, *high_at};
}

}  // namespace

std::optional<PositionWords> setpointPositionWords(Series series, const ValueFunctions& setpoints) noexcept {
  if (hasOneField(series)) {
    if (setpoints[0] != kPosition32 && setpoints[0] != kIncrements32) return std::nullopt;
    return kOneField;
  }
  if (!hasTwoWords(series)) return std::nullopt;
  const auto position = findPair(setpoints, kPositionLow, kPositionHigh);
  return position.has_value() ? position : findPair(setpoints, kIncrementsLow, kIncrementsHigh);
}

std::optional<PositionWords> actualPositionWords(Series series, const ValueFunctions& setpoints,
                                                 const ValueFunctions& actual_values) noexcept {
  if (hasOneField(series)) {
    const std::uint16_t function = actual_values[0];
    const bool position = function == kActualPosition7 || function == kSetpointPosition7 ||
                          function == kActualIncrements7 || function == kSetpointIncrements7;
    return position ? setpointPositionWords(series, setpoints) : std::nullopt;
  }
  return hasTwoWords(series) ? findPair(actual_values, kActualLow, kActualHigh) : std::nullopt;
}

bool splitPosition(std::int32_t thousandths, PositionWords where, ProcessValues& values) noexcept {
  if (thousandths > kMaxPosition || thousandths < -kMaxPosition) return false;
  const auto bits = static_cast<std::uint32_t>(thousandths);
  values[where.low] = toSigned(static_cast<Word>(bits & 0xFFFFu));
  values[where.high] = toSigned(static_cast<Word>(bits >> 16));
  return true;
}

std::int32_t joinPosition(PositionWords where, const ProcessValues& values) noexcept {
  const std::uint32_t high = toWord(values[where.high]);
  return static_cast<std::int32_t>(high << 16 | toWord(values[where.low]));
}

}  // namespace nord_driver::profile

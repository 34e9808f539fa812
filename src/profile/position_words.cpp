#include "profile/position_words.h"

#include <algorithm>

#include "profile/word_function.h"

namespace nord_driver::profile {

namespace {

constexpr std::uint16_t kIncrements = 8192;

WordUse useOf(bool actual_value, Series series, const FunctionCodes& codes, std::size_t place) noexcept {
  const WordFunction* const function = actual_value ? findActualValueFunction(series, codes[place])
                                                    : findSetpointFunction(series, place + 1, codes[place]);
  return function == nullptr ? WordUse::kOther : function->use;
}

std::optional<std::uint8_t> placeOf(WordUse use, bool actual_value, Series series, const FunctionCodes& codes,
                                    std::size_t carried) noexcept {
  for (std::size_t place = 0; place < carried; ++place) {
    if (useOf(actual_value, series, codes, place) == use) return static_cast<std::uint8_t>(place);
  }
  return std::nullopt;
}

// Setpoint 1 and the word beside it: of these series that is SW3, on the wire before SW2 (BU 0020 7.2.2).
PositionField wholeField(FieldOrder order, std::uint16_t steps) noexcept {
  const bool low_first = order == FieldOrder::kLowFirst;
  return {32, static_cast<std::uint8_t>(low_first ? 0 : 2), static_cast<std::uint8_t>(low_first ? 2 : 0), steps};
}

// Of 21/22 and 23/24 (BU 0020 7.3.5) one pair, never a half of each.
bool makeAPair(bool actual_value, std::uint16_t low, std::uint16_t high) noexcept {
  return actual_value || high == low + 1;
}

PositionField halves(bool actual_value, Series series, const FunctionCodes& codes, std::size_t carried) noexcept {
  const auto low = placeOf(WordUse::kPositionLow, actual_value, series, codes, carried);
  const auto high = placeOf(WordUse::kPositionHigh, actual_value, series, codes, carried);
  if (!low) return {};
  if (!high) return {16, *low, *low, 1000};
  if (!makeAPair(actual_value, codes[*low], codes[*high])) return {};
  return {32, *low, *high, 1000};
}

PositionField setpointField(Series series, const FunctionCodes& codes, std::size_t carried, FieldOrder order) noexcept {
  if (carried == 0) return {};
  const WordUse first = useOf(false, series, codes, 0);
  if (first == WordUse::kPosition16) return {16, 0, 0, 1000};
  if (first == WordUse::kIncrement16) return {16, 0, 0, kIncrements};
  if (first == WordUse::kPosition32 && carried >= 3) return wholeField(order, 1000);
  if (first == WordUse::kIncrement32 && carried >= 3) return wholeField(order, kIncrements);
  return halves(false, series, codes, carried);
}

// "If P546 is 'setpoint position 32 bit', the actual position is also transferred as a 32 bit value in PZD2 and PZD3"
// (BU 0020 7.3.7).
PositionField actualField(Series series, const FunctionCodes& codes, std::size_t carried, FieldOrder order,
                          const PositionField& setpoint) noexcept {
  for (const WordUse use : {WordUse::kPosition16, WordUse::kIncrement16}) {
    const std::uint16_t steps = use == WordUse::kIncrement16 ? kIncrements : std::uint16_t{1000};
    const auto place = placeOf(use, true, series, codes, carried);
    if (!place) continue;
    const bool whole = setpoint.bits == 32 && *place == 0 && carried >= 3;
    return whole ? wholeField(order, steps) : PositionField{16, *place, *place, steps};
  }
  return halves(true, series, codes, carried);
}

bool takenBy(const PositionField& field, std::uint8_t place) noexcept {
  return field.carried() && (field.low == place || field.high == place);
}

}  // namespace

PositionWords positionWords(Series series, const FunctionCodes& setpoints, const FunctionCodes& actual_values,
                            std::size_t carried, FieldOrder order) noexcept {
  const std::size_t places = std::min(carried, kMaxProcessValues);
  PositionWords words;
  words.setpoint = setpointField(series, setpoints, places, order);
  words.actual = actualField(series, actual_values, places, order, words.setpoint);
  words.speed_setpoint = placeOf(WordUse::kFrequency, false, series, setpoints, places);
  words.speed_actual = placeOf(WordUse::kFrequency, true, series, actual_values, places);
  // What P548 or P545 say of the word that the field of 32 bits has taken means nothing.
  if (words.speed_setpoint && takenBy(words.setpoint, *words.speed_setpoint)) words.speed_setpoint.reset();
  if (words.speed_actual && takenBy(words.actual, *words.speed_actual)) words.speed_actual.reset();
  return words;
}

void putPosition(const PositionField& field, std::int32_t steps, ProcessValues& words) noexcept {
  if (!field.carried()) return;
  const auto raw = static_cast<std::uint32_t>(steps);
  words[field.low] = toSigned(static_cast<Word>(raw & 0xFFFFu));
  if (field.bits == 32) words[field.high] = toSigned(static_cast<Word>(raw >> 16));
}

std::int32_t getPosition(const PositionField& field, const ProcessValues& words) noexcept {
  if (!field.carried()) return 0;
  if (field.bits == 16) return words[field.low];
  const std::uint32_t raw = static_cast<std::uint32_t>(toWord(words[field.high])) << 16 |
                            static_cast<std::uint32_t>(toWord(words[field.low]));
  return static_cast<std::int32_t>(raw);
}

}  // namespace nord_driver::profile

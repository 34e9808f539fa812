#include "cycle/word_needs.h"

#include <algorithm>
#include <initializer_list>

#include "profile/process_data_order.h"

namespace nord_driver::cycle {

using profile::Series;
using profile::WordUse;

namespace {

std::uint16_t codeAt(bool actual_value, std::size_t place, const WordFunctions& functions) noexcept {
  return actual_value ? functions.actual_values[place - 1] : functions.setpoints[place - 1];
}

/// Third words are no words of their own where the 32 bits of the first take their place (BU 0020 6.1.2: P548 "is only present
/// if P546 is neither 3 nor 6", 7.3.7: of the actual values then as well, if the first is a position).
bool takesThirdPlace(bool actual_value, const WordFunctions& functions, Series series) noexcept {
  const profile::WordFunction* const setpoint = profile::findSetpointFunction(series, 1, functions.setpoints[0]);
  const bool wide =
      setpoint != nullptr && (setpoint->use == WordUse::kPosition32 || setpoint->use == WordUse::kIncrement32);
  if (!wide || !actual_value) return wide;
  const profile::WordFunction* const first = profile::findActualValueFunction(series, functions.actual_values[0]);
  return first != nullptr && (first->use == WordUse::kPosition16 || first->use == WordUse::kIncrement16);
}

std::optional<WordUse> useAt(bool actual_value, std::size_t place, const WordFunctions& functions,
                             Series series) noexcept {
  if (place == 3 && takesThirdPlace(actual_value, functions, series)) return std::nullopt;
  const std::uint16_t code = codeAt(actual_value, place, functions);
  const profile::WordFunction* const function = actual_value ? profile::findActualValueFunction(series, code)
                                                             : profile::findSetpointFunction(series, place, code);
  return function == nullptr ? std::nullopt : std::optional<WordUse>{function->use};
}

std::optional<WordNeed> needOf(const SignalSetup& signal) noexcept {
  switch (signal.source) {
    case SignalSource::kBusInBit:
      return WordNeed{false, WordUse::kBusBits};
    case SignalSource::kBusOutBit:
      return WordNeed{true, WordUse::kBusBits};
    case SignalSource::kDigitalInput:
    case SignalSource::kRelay:
      return WordNeed{true, WordUse::kDigitalIo};
    case SignalSource::kAnalogInput:
      return WordNeed{true, signal.number == 1 ? WordUse::kAnalogInput1 : WordUse::kAnalogInput2};
    case SignalSource::kControlBit:
    case SignalSource::kStatusBit:
    case SignalSource::kModuleOutput:
    case SignalSource::kModuleInput:
      break;
  }
  return std::nullopt;
}

// Setpoint 1 and actual value 1 are the frequency: never taken for anything else, but by a position that finds no other
// place.
std::size_t bestPlace(const WordNeeds& needs, const WordNeed& missing, const WordFunctions& functions,
                      Series series) noexcept {
  const bool actual_value = missing.actual_value;
  const std::size_t words = takesThirdPlace(actual_value, functions, series) ? 2 : needs.words;
  const std::size_t last = std::min<std::size_t>(words, missing.last);
  const std::size_t first =
      needs.firstIsFree(actual_value) || last < 2 ? missing.first : std::max<std::size_t>(missing.first, 2);
  std::size_t best = std::min(std::max<std::size_t>(first, 2), std::max<std::size_t>(last, 1));
  for (std::size_t place = last; place >= first; --place) {
    const auto use = useAt(actual_value, place, functions, series);
    const bool wanted = std::any_of(needs.list.begin(), needs.list.end(), [&](const WordNeed& need) {
      return need.actual_value == actual_value && use == need.use;
    });
    if (!wanted) best = place;
  }
  for (std::size_t place = last; place >= first; --place) {
    if (useAt(actual_value, place, functions, series) == WordUse::kOff) best = place;
  }
  return best;
}

bool isCarried(const WordNeeds& needs, const WordNeed& need, const WordFunctions& functions, Series series) noexcept {
  for (std::size_t place = need.first; place <= needs.words && place <= need.last; ++place) {
    if (carries(place, need, functions, series)) return true;
  }
  return false;
}

std::optional<std::size_t> placeOf(const WordNeeds& needs, WordUse use, const WordFunctions& functions,
                                   Series series) noexcept {
  for (std::size_t place = 1; place <= needs.words; ++place) {
    if (useAt(false, place, functions, series) == use) return place;
  }
  return std::nullopt;
}

drive::UnexpectedFunction wordToSet(bool actual_value, std::size_t place, std::uint16_t expected,
                                    const WordFunctions& functions, Series series) noexcept {
  const profile::WordParameter parameter =
      actual_value ? profile::actualValueParameter(series, place) : profile::setpointParameter(series, place);
  drive::UnexpectedFunction missing;
  missing.number = parameter.number;
  missing.index = parameter.index;
  missing.is_array = parameter.is_array;
  missing.found = codeAt(actual_value, place, functions);
  missing.expected = expected;
  missing.wanted =
      actual_value ? profile::actualValueName(series, expected) : profile::setpointName(series, place, expected);
  return missing;
}

drive::UnexpectedFunction wordToSwitchOff(bool actual_value, std::size_t place, const WordFunctions& functions,
                                          Series series) noexcept {
  drive::UnexpectedFunction surplus = wordToSet(actual_value, place, 0, functions, series);
  surplus.surplus = true;
  return surplus;
}

// Of the setpoints 21/22 and 23/24 (BU 0020 7.3.5) one pair, never a half of each: which of them counts what, BU 0510
// tells.
std::optional<drive::UnexpectedFunction> brokenPair(const WordNeeds& needs, const WordFunctions& functions,
                                                    Series series) noexcept {
  const auto low = placeOf(needs, WordUse::kPositionLow, functions, series);
  const auto high = placeOf(needs, WordUse::kPositionHigh, functions, series);
  if (!needs.positions || !low || !high) return std::nullopt;
  const auto expected = static_cast<std::uint16_t>(codeAt(false, *low, functions) + 1);
  if (codeAt(false, *high, functions) == expected) return std::nullopt;
  return wordToSet(false, *high, expected, functions, series);
}

// One low word of 16 bits beside a high one would be taken for 32.
std::optional<drive::UnexpectedFunction> unwantedHalf(const WordNeeds& needs, const WordFunctions& functions,
                                                      Series series) noexcept {
  const bool wide = std::any_of(needs.list.begin(), needs.list.end(),
                                [](const WordNeed& need) { return need.use == WordUse::kPositionHigh; });
  const bool halves = std::any_of(needs.list.begin(), needs.list.end(),
                                  [](const WordNeed& need) { return need.use == WordUse::kPositionLow; });
  if (wide || !halves) return std::nullopt;
  for (const bool actual_value : {false, true}) {
    for (std::size_t place = 1; place <= needs.words; ++place) {
      if (useAt(actual_value, place, functions, series) != WordUse::kPositionHigh) continue;
      return wordToSwitchOff(actual_value, place, functions, series);
    }
  }
  return std::nullopt;
}

// Of two words with the same part of a position, or POSICON bits, one is written: the other would be sent as 0.
std::optional<drive::UnexpectedFunction> repeatedSetpoint(const WordNeeds& needs, const WordFunctions& functions,
                                                          Series series) noexcept {
  for (const WordNeed& need : needs.list) {
    if (need.actual_value || (!isPosition(need.use) && need.use != WordUse::kPosiconBits)) continue;
    bool found = false;
    for (std::size_t place = 1; place <= needs.words; ++place) {
      if (!carries(place, need, functions, series)) continue;
      if (found) return wordToSwitchOff(false, place, functions, series);
      found = true;
    }
  }
  return std::nullopt;
}

}  // namespace

WordNeeds wordNeeds(const WordSetup& setup, std::size_t carried) noexcept {
  WordNeeds needs;
  needs.words = std::min(std::max<std::size_t>(carried, 1), profile::kMaxProcessValues);
  for (const SetpointSetup& setpoint : setup.setpoints) needs.list.push_back({false, setpoint.use});
  if (setup.torque_at_limit) needs.list.push_back({true, WordUse::kTorqueCurrent});
  for (const SignalSetup& signal : setup.signals) {
    const auto need = needOf(signal);
    const bool known = need && std::any_of(needs.list.begin(), needs.list.end(), [&](const WordNeed& other) {
                         return other.actual_value == need->actual_value && other.use == need->use;
                       });
    if (need && !known) needs.list.push_back(*need);
    needs.bits = needs.bits || busBitElement(signal);
  }
  return needs;
}

WordNeeds onlyInputs(const WordNeeds& needs) noexcept {
  WordNeeds inputs = needs;
  inputs.list.clear();
  for (const WordNeed& need : needs.list) {
    if (need.actual_value) inputs.list.push_back(need);
  }
  return inputs;
}

bool carries(std::size_t place, const WordNeed& need, const WordFunctions& functions, Series series) noexcept {
  const auto use = useAt(need.actual_value, place, functions, series);
  // A position in increments is one, too: what a step of it is, its function says.
  if (need.use == WordUse::kPosition16 && use == WordUse::kIncrement16) return true;
  return use == need.use || (need.use == WordUse::kPosition32 && use == WordUse::kIncrement32);
}

WordNeed needOf(const PositionBit& bit) noexcept {
  if (bit.carrier == PositionBit::Carrier::kPosicon) return {false, WordUse::kPosiconBits, 1, 3};
  return {false, WordUse::kBusBits, 2, 3};
}

std::optional<std::uint8_t> elementOf(const PositionBit& bit) noexcept {
  // P480 [-01] to [-08] are the bus I/O in bits, [-11] and [-12] bits 8 and 9 of the control word (BU 0020 6.2.1).
  if (bit.carrier == PositionBit::Carrier::kBusBit) return static_cast<std::uint8_t>(bit.number + 1);
  if (bit.carrier == PositionBit::Carrier::kControlBit) return static_cast<std::uint8_t>(bit.number + 3);
  return std::nullopt;
}

std::uint8_t referencedElement(const PositionSetup& setup, Series series) noexcept {
  if (!setup.referenced || setup.referenced_function == 0) return 0;
  const std::uint8_t number = setup.referenced->number;
  if (setup.referenced->source == SignalSource::kBusOutBit) return static_cast<std::uint8_t>(number + 1);
  if (profile::thirdBeforeSecond(series)) return 0;
  // P481 [-09] and [-10] are bits 10 and 13 of the status word (BU 0020 6.2.1).
  return number == 10 ? 9 : 10;
}

bool isPosition(WordUse use) noexcept {
  switch (use) {
    case WordUse::kPositionLow:
    case WordUse::kPositionHigh:
    case WordUse::kPosition16:
    case WordUse::kPosition32:
    case WordUse::kIncrement16:
    case WordUse::kIncrement32:
      return true;
    default:
      return false;
  }
}

bool firstWordFits(const WordNeeds& needs, bool actual_value, std::uint16_t code, Series series) noexcept {
  // Where word 1 has to be something else, missingWord() says what.
  if (code == kFrequencyFunction || needs.firstIsFree(actual_value)) return true;
  const profile::WordFunction* const function =
      actual_value ? profile::findActualValueFunction(series, code) : profile::findSetpointFunction(series, 1, code);
  return needs.positions && function != nullptr && isPosition(function->use);
}

void addPositionNeeds(const PositionSetup& setup, Series series, WordNeeds& needs) noexcept {
  needs.positions = true;
  needs.setpoint_mode = setup.setpoint_mode;
  needs.out_bit = referencedElement(setup, series);
  const auto add = [&needs](const WordNeed& need) {
    const bool known = std::any_of(needs.list.begin(), needs.list.end(), [&need](const WordNeed& other) {
      return other.actual_value == need.actual_value && other.use == need.use;
    });
    if (!known) needs.list.push_back(need);
  };
  for (const auto& bit : {setup.home, setup.reset}) {
    if (bit && bit->carrier != PositionBit::Carrier::kControlBit) add(needOf(*bit));
  }
  if (setup.teach) {
    for (const auto& bit :
         {std::optional{setup.teach->teach_in}, std::optional{setup.teach->quit}, setup.teach->array}) {
      if (bit && bit->carrier != PositionBit::Carrier::kControlBit) add(needOf(*bit));
    }
  }
  const bool by_element = setup.axis.by_element;
  if (by_element && setup.array && setup.array->carrier != PositionBit::Carrier::kControlBit) add(needOf(*setup.array));
  if (setup.referenced && setup.referenced->source == SignalSource::kBusOutBit) add({true, WordUse::kBusBits});
  const bool wide = setup.bits == 32;
  if (profile::thirdBeforeSecond(series)) {
    // Setpoint 1 only (P546); of the actual values 32 bits are in IW1 only (BU 0020 6.1.2, 7.3.7).
    needs.first_setpoint_is_free = true;
    needs.first_actual_value_is_free = true;
    // With elements no word has to carry a target; but without P546 = 3 the actual position has 16 bits.
    if (wide || !by_element) needs.list.push_back({false, wide ? WordUse::kPosition32 : WordUse::kPosition16, 1, 1});
    needs.list.push_back({true, WordUse::kPosition16, 1, static_cast<std::uint8_t>(wide ? 1 : 3)});
    return;
  }
  // In any words.
  for (const bool actual_value : {false, true}) {
    if (!actual_value && by_element) continue;
    needs.list.push_back({actual_value, WordUse::kPositionLow, 1});
    if (wide) needs.list.push_back({actual_value, WordUse::kPositionHigh, 1});
  }
  // The frequency keeps the first where the others suffice for all that is needed, the bits included.
  const auto needed = [&needs](bool actual_value) {
    return static_cast<std::size_t>(
        std::count_if(needs.list.begin(), needs.list.end(),
                      [actual_value](const WordNeed& need) { return need.actual_value == actual_value; }));
  };
  needs.first_setpoint_is_free = needs.words < needed(false) + 1;
  needs.first_actual_value_is_free = needs.words < needed(true) + 1;
}

std::optional<drive::UnexpectedFunction> missingWord(const WordNeeds& needs, const WordFunctions& functions,
                                                     Series series) noexcept {
  for (const WordNeed& need : needs.list) {
    if (isCarried(needs, need, functions, series)) continue;
    const std::size_t place = bestPlace(needs, need, functions, series);
    auto code =
        need.actual_value ? profile::actualValueCode(series, need.use) : profile::setpointCode(series, place, need.use);
    // The other half of the pair that is there.
    const auto low = placeOf(needs, WordUse::kPositionLow, functions, series);
    if (!need.actual_value && need.use == WordUse::kPositionHigh && low) {
      code = static_cast<std::uint16_t>(codeAt(false, *low, functions) + 1);
    }
    const auto high = placeOf(needs, WordUse::kPositionHigh, functions, series);
    if (!need.actual_value && need.use == WordUse::kPositionLow && high) {
      code = static_cast<std::uint16_t>(codeAt(false, *high, functions) - 1);
    }
    return wordToSet(need.actual_value, place, code.value_or(0), functions, series);
  }
  if (const auto broken = brokenPair(needs, functions, series)) return broken;
  if (const auto half = unwantedHalf(needs, functions, series)) return half;
  return repeatedSetpoint(needs, functions, series);
}

}  // namespace nord_driver::cycle

#include "cycle/word_needs.h"

#include <algorithm>

namespace nord_driver::cycle {

using profile::Series;
using profile::WordUse;

namespace {

std::uint16_t codeAt(bool actual_value, std::size_t place, const WordFunctions& functions) noexcept {
  return actual_value ? functions.actual_values[place - 1] : functions.setpoints[place - 1];
}

std::optional<WordUse> useAt(bool actual_value, std::size_t place, const WordFunctions& functions,
                             Series series) noexcept {
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

// Setpoint 1 and actual value 1 are the frequency: never taken for anything else.
std::size_t bestPlace(const WordNeeds& needs, bool actual_value, const WordFunctions& functions,
                      Series series) noexcept {
  std::size_t best = 2;
  for (std::size_t place = needs.words; place >= 2; --place) {
    const auto use = useAt(actual_value, place, functions, series);
    const bool wanted = std::any_of(needs.list.begin(), needs.list.end(), [&](const WordNeed& need) {
      return need.actual_value == actual_value && use == need.use;
    });
    if (!wanted) best = place;
  }
  for (std::size_t place = needs.words; place >= 2; --place) {
    if (useAt(actual_value, place, functions, series) == WordUse::kOff) best = place;
  }
  return best;
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

bool carries(std::size_t place, const WordNeed& need, const WordFunctions& functions, Series series) noexcept {
  return useAt(need.actual_value, place, functions, series) == need.use;
}

std::optional<drive::UnexpectedFunction> missingWord(const WordNeeds& needs, const WordFunctions& functions,
                                                     Series series) noexcept {
  for (const WordNeed& need : needs.list) {
    bool carried = false;
    for (std::size_t place = 2; place <= needs.words; ++place) {
      carried = carried || carries(place, need, functions, series);
    }
    if (carried) continue;
    const std::size_t place = bestPlace(needs, need.actual_value, functions, series);
    const profile::WordParameter parameter =
        need.actual_value ? profile::actualValueParameter(series, place) : profile::setpointParameter(series, place);
    const auto code =
        need.actual_value ? profile::actualValueCode(series, need.use) : profile::setpointCode(series, place, need.use);
    drive::UnexpectedFunction missing;
    missing.number = parameter.number;
    missing.index = parameter.index;
    missing.is_array = parameter.is_array;
    missing.found = codeAt(need.actual_value, place, functions);
    missing.expected = code.value_or(0);
    missing.wanted = need.actual_value ? profile::actualValueName(series, missing.expected)
                                       : profile::setpointName(series, place, missing.expected);
    return missing;
  }
  return std::nullopt;
}

}  // namespace nord_driver::cycle

#include "cycle/word_places.h"

#include <algorithm>
#include <string>
#include <vector>

namespace nord_driver::cycle {

using profile::Series;
using profile::WordUse;

namespace {

std::vector<WordNeed> needsOfOneWay(const WordNeeds& needs, bool actual_value) {
  std::vector<WordNeed> list;
  for (const WordNeed& need : needs.list) {
    if (need.actual_value == actual_value) list.push_back(need);
  }
  return list;
}

std::string nameOf(const WordNeed& need, Series series) {
  const std::size_t place = need.last == 1 ? 1 : 2;
  const auto code =
      need.actual_value ? profile::actualValueCode(series, need.use) : profile::setpointCode(series, place, need.use);
  return need.actual_value ? profile::actualValueName(series, code.value_or(0))
                           : profile::setpointName(series, place, code.value_or(0));
}

// The needs are counted only: at most one is bound to a single word, the first, and all others may be in any word from
// the second on.
void checkOneWay(const Settings& drive, const WordNeeds& needs, bool actual_value, std::size_t words, Series series) {
  const std::vector<WordNeed> list = needsOfOneWay(needs, actual_value);
  const bool takes_first = std::any_of(list.begin(), list.end(), [](const WordNeed& need) { return need.first == 1; });
  const std::size_t places = takes_first ? words : words - 1;
  if (list.size() <= places) return;
  std::string names;
  for (const WordNeed& need : list) names += (names.empty() ? "" : ", ") + nameOf(need, series);
  throw ConfigError(drive.fullName("") + ": " + std::to_string(list.size()) + " functions of " +
                    (actual_value ? "actual values" : "setpoints") + " are needed" +
                    (takes_first ? "" : " beside the frequency") + " (" + names + "), but the bus carries " +
                    std::to_string(places) + (places == 1 ? " word" : " words") + " for them " +
                    (actual_value ? "from" : "to") + " this drive, expected fewer " +
                    (actual_value ? "signals and bits, or no torque_at_limit" : "setpoints and bits") +
                    (needs.words < profile::kMaxProcessValues ? ", or a longer telegram (PPO type, assembly)" : ""));
}

}  // namespace

WordNeeds driveNeeds(const DriveSetup& setup, std::size_t carried, bool only_inputs) noexcept {
  WordNeeds needs = wordNeeds(setup.words, carried);
  if (only_inputs) needs = onlyInputs(needs);
  if (setup.position) addPositionNeeds(*setup.position, setup.series, needs);
  return needs;
}

void checkWordPlaces(const Settings& drive, const DriveSetup& setup, const DriveIdentity& identity, bool only_inputs) {
  const WordNeeds needs = driveNeeds(setup, identity.process_values, only_inputs);
  // The 32 bits of SK 700E and 750E take the third word of both ways (BU 0020 6.1.2, 7.3.7).
  const bool wide = std::any_of(needs.list.begin(), needs.list.end(),
                                [](const WordNeed& need) { return need.use == WordUse::kPosition32; });
  const std::size_t words = std::min<std::size_t>(needs.words, wide ? 2 : profile::kMaxProcessValues);
  for (const bool actual_value : {false, true}) checkOneWay(drive, needs, actual_value, words, setup.series);
}

}  // namespace nord_driver::cycle

#include "commissioning/check.h"

#include <algorithm>

#include "profile/cycle_parameters.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kOfTheDrive[] = {509, 510, 513, 560};
constexpr std::uint16_t kPositionControl = 600;
constexpr std::uint16_t kOfPositioning[] = {kPositionControl, 610, 607, 608};
/// Compared between the drives of a base, in the set in force.
constexpr std::uint16_t kOfTheSet[] = {102, 103, 426, 300};

}  // namespace

std::vector<ParameterKey> valuesToRead(const AskedDrive& asked, const catalogue::DriveCatalogue& known,
                                       std::uint8_t set_in_force) {
  const DriveUnderCheck drive{asked, known, {}, set_in_force};
  std::vector<ParameterKey> keys;
  const auto add = [&keys](const ParameterKey& key) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  };
  const auto isDescribed = [&known](std::uint16_t number) { return known.find(number) != nullptr; };
  for (const std::uint16_t number : kOfTheDrive) {
    if (isDescribed(number)) add(drive.key(number));
  }
  for (const std::uint16_t number : kOfPositioning) {
    if (asked.words.positions && isDescribed(number)) add(drive.key(number));
  }
  const bool behind_module = asked.identity.timeout_owner == TimeoutOwner::kModule;
  if (behind_module) add(drive.key(151));
  if (behind_module && isDescribed(120)) add(drive.key(120));
  const bool may_position = profile::findCycleParameter(kPositionControl, asked.series) != nullptr;
  for (std::uint8_t set = 1; set <= 4; ++set) {
    if (may_position) add(drive.key(kPositionControl, set));
    add(drive.key(105, set));
    add(drive.key(104, set));
    add(drive.functionKey(543, 0, set));
    add(drive.functionKey(546, 0, set));
  }
  for (std::uint8_t place = 1; place < 3 && place < asked.identity.process_values; ++place) {
    add(drive.functionKey(543, place));
    add(drive.functionKey(546, place));
  }
  if (const catalogue::ParameterEntry* bits = known.find(480); bits != nullptr) {
    const unsigned elements = bits->elements.value_or(0);
    for (std::uint8_t bit = 1; bit <= elements; ++bit) add(drive.key(480, 0, bit));
  }
  for (const cycle::AskedBit& bit : asked.position_bits) {
    if (isDescribed(bit.number)) add(drive.key(bit.number, 0, bit.element));
  }
  for (const std::uint16_t number : kOfTheSet) {
    if (asked.of_base && isDescribed(number)) add(drive.key(number));
  }
  return keys;
}

Findings check(const Drives& drives) {
  Findings findings;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (const Rule& rule : rules()) {
      const std::size_t before = findings.size();
      rule.check(drives, i, findings);
      for (std::size_t k = before; k < findings.size(); ++k) findings[k].rule = rule.name;
    }
  }
  return findings;
}

}  // namespace nord_driver::commissioning

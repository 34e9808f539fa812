// What concerns a drive as a whole, and drives that have to be alike.
#include <algorithm>
#include <vector>

#include "commissioning/rules.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kEepromSwitch = 560;
/// Ramps, maximum frequency, quick stop, and how the motor is controlled.
constexpr std::uint16_t kToBeAlike[] = {102, 103, 105, 426, 300};

/// The first drive of the base, with which the others are compared; nullptr for itself, and outside a base.
const DriveUnderCheck* referenceOf(const Drives& drives, std::size_t index) {
  if (!drives[index].asked().of_base) return nullptr;
  const auto first =
      std::find_if(drives.begin(), drives.end(), [](const DriveUnderCheck& drive) { return drive.asked().of_base; });
  return &*first == &drives[index] ? nullptr : &*first;
}

}  // namespace

void setInForceIsFirst(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  if (drive.setInForce() == 1) return;
  Finding finding = drive.finding({}, Severity::kNote,
                                  "the driver stays in the set it finds, and this is not the one inverters start in",
                                  "BU 2700, 6.4.1");
  finding.raw = drive.setInForce();
  finding.value = std::to_string(drive.setInForce());
  finding.advice = "~<drive>/select_parameter_set leads to another one at standstill";
  to.push_back(finding);
}

void drivesOfBaseAreAlike(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const DriveUnderCheck* reference = referenceOf(drives, index);
  if (reference == nullptr) return;
  const std::string& name = reference->asked().name;
  if (drive.setInForce() != reference->setInForce()) {
    Finding finding = drive.finding({}, Severity::kWarning,
                                    "drive " + name + " of the same base is in set " +
                                        std::to_string(reference->setInForce()) + ": other ramps and limits",
                                    "BU 2700, 6.4.1");
    finding.raw = drive.setInForce();
    finding.value = std::to_string(drive.setInForce());
    finding.advice = "select the same set in both";
    to.push_back(finding);
    return;
  }
  if (drive.asked().series != reference->asked().series) return;  // their parameters differ in meaning
  for (const std::uint16_t number : kToBeAlike) {
    const ParameterKey key = drive.key(number);
    const auto own = drive.raw(key), other = reference->raw(reference->key(number));
    if (!own || !other || *own == *other) continue;
    Finding finding = drive.finding(key, Severity::kWarning,
                                    "drive " + name + " of the same base has " + reference->valueText(key, *other) +
                                        ": the path bends where they differ");
    finding.advice = "set both alike";
    to.push_back(finding);
  }
}

void writesAreSaved(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey key = drive.key(kEepromSwitch);
  const auto raw = drive.raw(key);
  if (!raw || *raw != 0) return;
  Finding finding =
      drive.finding(key, Severity::kWarning, "parameters changed by anybody, NORD CON included, are lost at power off");
  finding.remedy = drive.remedy(key, 1);
  to.push_back(finding);
}

void decidingOnesAreReadable(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const bool behind_module = drive.asked().identity.timeout_owner == TimeoutOwner::kModule;
  std::vector<ParameterKey> keys{
      drive.key(509), drive.key(105), drive.key(104), drive.functionKey(543, 0), drive.functionKey(546, 0),
      drive.key(513)};
  if (behind_module) {
    keys.push_back(drive.key(151));
    if (drive.asked().series != profile::Series::kSk5xxe) keys.push_back(drive.key(120));
  }
  for (const ParameterKey& key : keys) {
    const bool is_typed = key.number == 105 && drive.asked().typed_max_frequency;
    if (is_typed || !drive.facts().isUnreadable(key)) continue;
    Finding finding = drive.finding(key, Severity::kWarning, "could not be read");
    finding.advice = "look at the inverter itself";
    to.push_back(finding);
  }
}

}  // namespace nord_driver::commissioning

// P543 to P548: what the process values mean, against what the driver sends and reads.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "commissioning/rules.h"
#include "config/setting_checks.h"

namespace nord_driver::commissioning {

namespace {

constexpr std::uint16_t kFirstActualValue = 543, kFirstSetpoint = 546;
constexpr std::int32_t kFrequency = 1;  // in every series' tables of P543 and P546
constexpr std::int32_t kCurrent = 3;    // P543
constexpr std::uint16_t kPositionControl = 600, kSpeedRatio = 607, kReduction = 608, kSetpointMode = 610;
constexpr char kPositionControlSource[] = "BU 0020, 7.3.5, p. 77";
constexpr double kSameRatio = 1e-3;  // a gear as two whole numbers, beside one typed as a decimal fraction
constexpr std::uint8_t kSets = 4, kPlaces = 3;

/// Functions of setpoints that limit torque, current, frequency or ramp: as 0 they hold the motor back.
bool holdsBack(const DriveUnderCheck& drive, std::int32_t function) {
  using Functions = std::vector<std::int32_t>;
  static const Functions kDecentral{5, 11, 12, 13, 14, 17};  // BU 0220 5.1.3
  static const Functions kSk300e{2};                         // BU 0020 6.1.2
  static const Functions kOthers{2, 6, 7, 13};               // BU 0020 6.1.2 and 6.2.2
  const bool is_sk300e = drive.asked().series == profile::Series::kSk300e;
  const Functions& list = drive.isDecentral() ? kDecentral : is_sk300e ? kSk300e : kOthers;
  return std::find(list.begin(), list.end(), function) != list.end();
}

/// Of the set in force.
cycle::WordFunctions functionsOf(const DriveUnderCheck& drive) {
  cycle::WordFunctions functions;
  for (std::uint8_t place = 0; place < kPlaces; ++place) {
    const auto setpoint = drive.raw(drive.functionKey(kFirstSetpoint, place));
    const auto actual_value = drive.raw(drive.functionKey(kFirstActualValue, place));
    if (setpoint) functions.setpoints[place] = static_cast<std::uint16_t>(*setpoint);
    if (actual_value) functions.actual_values[place] = static_cast<std::uint16_t>(*actual_value);
  }
  return functions;
}

/// The configuration has a setpoint, a signal or a measurement for the function of this word.
bool isNeeded(const DriveUnderCheck& drive, bool actual_value, std::uint8_t place) {
  const cycle::WordFunctions functions = functionsOf(drive);
  const auto& needs = drive.asked().words.list;
  return std::any_of(needs.begin(), needs.end(), [&](const cycle::WordNeed& need) {
    return need.actual_value == actual_value && cycle::carries(place + 1u, need, functions, drive.asked().series);
  });
}

/// A further actual value that is off, else one that nothing needs; none: each is needed, or not known.
std::optional<std::uint8_t> freeActualValue(const DriveUnderCheck& drive, std::uint8_t places) {
  std::optional<std::uint8_t> unneeded;
  for (std::uint8_t place = 1; place < places; ++place) {
    const auto raw = drive.raw(drive.functionKey(kFirstActualValue, place));
    if (raw == 0) return place;
    if (raw && !unneeded && !isNeeded(drive, true, place)) unneeded = place;
  }
  return unneeded;
}

/// Of a value that keeps the drive from being enabled in its set, and nothing in another one.
Finding refusing(const DriveUnderCheck& drive, const ParameterKey& key, std::int32_t right, const std::string& why,
                 const std::string& source = {}) {
  const bool in_force = key.set == drive.setInForce();
  Finding finding =
      drive.finding(key, in_force ? Severity::kError : Severity::kWarning,
                    why + (in_force ? ": the drive is not enabled" : ": not enabled in this set"), source);
  finding.remedy = drive.remedy(key, right);
  return finding;
}

void expectFrequency(const DriveUnderCheck& drive, std::uint16_t first, const std::string& why, Findings& to) {
  for (std::uint8_t set = 1; set <= kSets; ++set) {
    const ParameterKey key = drive.functionKey(first, 0, set);
    const auto raw = drive.raw(key);
    if (!raw || cycle::firstWordFits(drive.asked().words, first == kFirstActualValue, static_cast<std::uint16_t>(*raw),
                                     drive.asked().series)) {
      continue;
    }
    to.push_back(refusing(drive, key, kFrequency, why));
  }
}

void expectNoPositionControl(const DriveUnderCheck& drive, Findings& to) {
  for (std::uint8_t set = 1; set <= kSets; ++set) {
    const ParameterKey key = drive.key(kPositionControl, set);
    if (drive.raw(key).value_or(0) == 0) continue;
    to.push_back(refusing(drive, key, 0, "with position control on it follows no velocity, and mode is velocity",
                          kPositionControlSource));
  }
}

}  // namespace

void firstSetpointIsFrequency(const Drives& drives, std::size_t index, Findings& to) {
  expectFrequency(drives[index], kFirstSetpoint, "setpoint 1 is not the frequency, and a command would be no speed",
                  to);
}

void firstActualValueIsFrequency(const Drives& drives, std::size_t index, Findings& to) {
  expectFrequency(drives[index], kFirstActualValue,
                  "actual value 1 is not the frequency, and would be taken for a speed by the odometry", to);
}

void askedWordsAreCarried(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const cycle::WordNeeds& needs = drive.asked().words;
  cycle::WordFunctions functions = functionsOf(drive);
  // Each finding as if the one before it had been mended, so that none asks for the word of another.
  for (std::size_t i = 0; i < needs.list.size() + kPlaces; ++i) {
    const auto missing = cycle::missingWord(needs, functions, drive.asked().series);
    if (!missing) return;
    const bool actual_value = missing->number < kFirstSetpoint;
    const std::uint16_t first = actual_value ? kFirstActualValue : kFirstSetpoint;
    const auto place = static_cast<std::uint8_t>(missing->is_array ? missing->index - 1 : missing->number - first);
    const ParameterKey key = drive.functionKey(first, place);
    if (!drive.raw(key)) return;
    const std::string why = missing->surplus
                                ? "what another word carries would mean something else beside it"
                                : std::string("no word carries what the configuration asks for, ") + missing->wanted;
    Finding finding = drive.finding(key, Severity::kError, why + ": the drive is not enabled");
    if (missing->expected != 0 || missing->surplus) finding.remedy = drive.remedy(key, missing->expected);
    to.push_back(finding);
    (actual_value ? functions.actual_values : functions.setpoints)[place] = missing->expected;
  }
}

void furtherSetpointsAreFree(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  for (std::uint8_t place = 1; place < kPlaces && place < drive.asked().identity.process_values; ++place) {
    const ParameterKey key = drive.functionKey(kFirstSetpoint, place);
    const auto raw = drive.raw(key);
    if (!raw || *raw == 0 || isNeeded(drive, false, place)) continue;
    const bool holds = holdsBack(drive, *raw);
    Finding finding = drive.finding(key, holds ? Severity::kError : Severity::kWarning,
                                    "the driver sends 0 in setpoint " + std::to_string(place + 1) +
                                        (holds ? ", which as this function holds the motor back"
                                               : ", which the inverter takes as a value of this function"));
    finding.remedy = drive.remedy(key, 0);
    to.push_back(finding);
  }
}

void drivePositions(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const cycle::WordNeeds& needs = drive.asked().words;
  if (!needs.positions) return expectNoPositionControl(drive, to);
  const ParameterKey control = drive.key(kPositionControl);
  if (drive.raw(control) == 0) {
    Finding finding = drive.finding(control, Severity::kError,
                                    "with mode: position the drive has to position, and is not enabled as it is",
                                    kPositionControlSource);
    // No number: what 1, 2 and so on do, and whether position/speed counts with them, stands in manuals not at hand.
    finding.advice = "set it to position control as BU 0510 or BU 0710 says";
    to.push_back(finding);
  }
  const ParameterKey mode = drive.key(kSetpointMode);
  const auto raw = drive.raw(mode);
  if (needs.setpoint_mode < 0 || !raw || *raw == needs.setpoint_mode) return;
  Finding finding = drive.finding(
      mode, Severity::kError,
      "its target would come from somewhere else than configured (position/setpoint_mode), and it is not enabled");
  finding.remedy = drive.remedy(mode, needs.setpoint_mode);
  to.push_back(finding);
}

// Which of the two multiplies is not said: either counts as configured. Alike, they make nothing of the count, and an
// encoder behind the gear may.
void countHasNoOtherGear(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const ParameterKey ratio_key = drive.key(kSpeedRatio), reduction_key = drive.key(kReduction);
  const auto ratio = drive.raw(ratio_key), reduction = drive.raw(reduction_key);
  if (!drive.asked().words.positions || !ratio || !reduction) return;
  const double configured = drive.asked().counted_per_motor_turn;
  const auto is = [](double part, double whole, double factor) {
    return std::abs(part - factor * whole) <= kSameRatio * std::abs(part);
  };
  const bool valid = *ratio != 0 && *reduction != 0;
  if (valid && (*ratio == *reduction || is(*ratio, *reduction, configured) || is(*reduction, *ratio, configured))) {
    return;
  }
  const std::string why = "with P608 = " + std::to_string(*reduction) +
                          " they are a gear between motor and count, and by position/gear_ratio and gear_ratio a "
                          "revolution of the motor counts as " +
                          shortNumber(configured) + ": positions may be wrong by a factor";
  Finding finding = drive.finding(ratio_key, Severity::kWarning, why);
  finding.advice =
      "compare the position with the joint, and set position/gear_ratio to what is counted for one revolution of the "
      "joint's shaft, or both parameters to 1";
  to.push_back(finding);
}

void currentIsMapped(const Drives& drives, std::size_t index, Findings& to) {
  const DriveUnderCheck& drive = drives[index];
  const std::uint8_t places = std::min(kPlaces, drive.asked().identity.process_values);
  if (!drive.asked().rated_current || places < 2) return;
  for (std::uint8_t place = 1; place < places; ++place) {
    const auto raw = drive.raw(drive.functionKey(kFirstActualValue, place));
    if (!raw || *raw == kCurrent) return;
  }
  const std::optional<std::uint8_t> place = freeActualValue(drive, places);
  const ParameterKey key = drive.functionKey(kFirstActualValue, place.value_or(1));
  Finding finding = drive.finding(key, Severity::kNote,
                                  "rated_current is configured, but no actual value is the current: "
                                  "the status tells none");
  if (place) {
    finding.remedy = drive.remedy(key, kCurrent);
  } else {
    finding.advice = "no word is free for it: leave rated_current out, or one of what needs them";
  }
  to.push_back(finding);
}

}  // namespace nord_driver::commissioning

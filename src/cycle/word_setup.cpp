#include "cycle/word_setup.h"

#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "config/setting_groups.h"
#include "config/setting_note.h"

namespace nord_driver::cycle {

using profile::Nominal;
using profile::WordUse;

namespace {

constexpr double kFull = 100.0;    // %
constexpr double kTwice = 200.0;   // %, the range of a word (BU 0020 7.3.6)
constexpr double kMostHz = 400.0;  // as max_frequency
/// The place of a further setpoint, 2 or 3: both have the same functions.
constexpr std::size_t kFurther = 2;

/// What the driver knows of a function beside its number.
struct SetpointKind {
  const char* word;
  WordUse use;
  bool in_hertz;
  bool moves;      ///< above zero (or below) the motor may turn while setpoint 1 is 0
  bool is_signed;  ///< the other direction is the other sign
};

constexpr SetpointKind kKinds[] = {
    {"torque_limit", WordUse::kTorqueLimit, false, false, false},
    {"torque_switch_off_limit", WordUse::kTorqueSwitchOff, false, false, false},
    {"current_limit", WordUse::kCurrentLimit, false, false, false},
    {"current_switch_off_limit", WordUse::kCurrentSwitchOff, false, false, false},
    {"maximum_frequency", WordUse::kMaximumFrequency, true, false, false},
    {"minimum_frequency", WordUse::kMinimumFrequency, true, true, false},
    {"frequency_addition", WordUse::kFrequencyAddition, true, true, true},
    {"frequency_subtraction", WordUse::kFrequencySubtraction, true, true, true},
    {"torque_precontrol", WordUse::kTorquePrecontrol, false, true, true},
};

const SetpointKind& readKind(const Settings& drive, const std::string& key, profile::Series series) {
  std::string words, all;
  for (const SetpointKind& kind : kKinds) {
    all += (all.empty() ? "" : ", ") + std::string(kind.word);
    if (!profile::setpointCode(series, kFurther, kind.use)) continue;
    words += (words.empty() ? "" : ", ") + std::string(kind.word);
  }
  noteSetting(drive, key, {"one of " + all, "", "", ""});
  const std::string word = requiredText(drive, key, "one of " + words);
  for (const SetpointKind& kind : kKinds) {
    if (word == kind.word && profile::setpointCode(series, kFurther, kind.use)) return kind;
  }
  throw wrongSetting(drive, key, "\"" + word + "\"",
                     "a function that setpoint 2 of " + std::string(profile::toString(series)) + " has: " + words);
}

// Two manuals of SK 1x0E and 2xxE give 100 % of their frequencies differently.
std::optional<double> readNominal(const Settings& drive, const std::string& group, const SetpointKind& kind,
                                  profile::Series series) {
  if (!kind.in_hertz) return kFull;
  const auto* function =
      profile::findSetpointFunction(series, kFurther, *profile::setpointCode(series, kFurther, kind.use));
  const std::string key = group + "nominal";
  if (function->nominal != Nominal::kOwnFrequency) return std::nullopt;
  if (!drive.has(key)) {
    throw missingSetting(drive, key,
                         "the frequency in Hz that 100 % of this setpoint stands for: BU 0220 (7.2.1.3) says P105, "
                         "BU 0200 (p. 297) says P411 of an addition or subtraction, 50 Hz of a minimum and 100 Hz of a "
                         "maximum");
  }
  return requiredNumber(drive, key, 0.1, kMostHz, "Hz");
}

SetpointSetup readSetpoint(const Settings& drive, const std::string& name, profile::Series series,
                           Duration cmd_vel_timeout) {
  const std::string group = "setpoints/" + name + "/";
  const SetpointKind& kind = readKind(drive, group + "function", series);
  SetpointSetup setpoint;
  setpoint.name = name;
  setpoint.use = kind.use;
  setpoint.moves = kind.moves;
  setpoint.is_signed = kind.is_signed;
  setpoint.nominal = readNominal(drive, group, kind, series);
  const char* const unit = kind.in_hertz ? "Hz" : "%";
  // A limit beyond 100 % would be none: what the drive's own parameter allows is 100 %.
  const double most = kind.in_hertz ? kMostHz : kind.moves ? kTwice : kFull;
  if (kind.moves && !drive.has(group + "limit")) {
    throw missingSetting(drive, group + "limit",
                         std::string("the most that may be commanded, in ") + unit + ", because it can turn the motor");
  }
  if (drive.has(group + "limit")) setpoint.limit = requiredNumber(drive, group + "limit", 0.0, most, unit);
  if (kind.moves) {
    setpoint.neutral = 0.0;
  } else if (drive.has(group + "neutral")) {
    setpoint.neutral = requiredNumber(drive, group + "neutral", 0.0, setpoint.limit.value_or(most), unit);
  }
  const double longest = kind.moves && cmd_vel_timeout > Duration::zero() ? toSeconds(cmd_vel_timeout) : 3600.0;
  const double shortest = kind.moves && cmd_vel_timeout > Duration::zero() ? 1e-3 : 0.0;
  setpoint.timeout = seconds(numberOr(drive, group + "timeout", toSeconds(cmd_vel_timeout), shortest, longest, "s"));
  return setpoint;
}

}  // namespace

const char* setpointWord(WordUse use) noexcept {
  for (const SetpointKind& kind : kKinds) {
    if (kind.use == use) return kind.word;
  }
  return "";
}

WordSetup readWordSetup(const Settings& drive, profile::Series series, Duration cmd_vel_timeout) {
  WordSetup setup;
  for (const std::string& name : namesIn(drive, "setpoints")) {
    const std::string key = "setpoints/" + name + "/function";
    const SetpointSetup setpoint = readSetpoint(drive, name, series, cmd_vel_timeout);
    for (const SetpointSetup& other : setup.setpoints) {
      if (other.use != setpoint.use) continue;
      throw wrongSetting(drive, key, "\"" + std::string(setpointWord(setpoint.use)) + "\"",
                         "a function that \"" + other.name + "\" has not already");
    }
    if (setup.setpoints.size() == kMaxExtraSetpoints) {
      throw wrongSetting(drive, key, "\"" + std::string(setpointWord(setpoint.use)) + "\"",
                         "two further setpoints at most: setpoint 1 is the velocity, and a bus carries three");
    }
    setup.setpoints.push_back(setpoint);
  }
  setup.signals = readSignals(drive, series);
  setup.release_after = cmd_vel_timeout;
  if (drive.has("torque_at_limit")) setup.torque_at_limit = requiredNumber(drive, "torque_at_limit", 1e-3, 1e5, "Nm");
  return setup;
}

void checkWordsCarried(const Settings& drive, const WordSetup& setup, const DriveIdentity& identity) {
  checkSignalsCarried(drive, setup.signals, identity);
  if (setup.torque_at_limit && identity.process_values < 2) {
    throw wrongSetting(
        drive, "torque_at_limit", shortNumber(*setup.torque_at_limit),
        "no such key, or a longer telegram (PPO type, assembly): the torque current needs an actual value "
        "beside the frequency, and the bus carries one");
  }
  const std::size_t carried = identity.process_values > 1 ? identity.process_values - 1u : 0u;
  if (setup.setpoints.size() <= carried) return;
  throw ConfigError(drive.fullName("setpoints") + ": " + std::to_string(setup.setpoints.size()) +
                    " beside the velocity, but the bus carries " + std::to_string(carried) +
                    " of them to this drive: a longer telegram (PPO type, assembly) is needed");
}

}  // namespace nord_driver::cycle

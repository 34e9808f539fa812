#include "cycle/leaders.h"

#include <algorithm>

#include "config/nearest_name.h"
#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "profile/cycle_parameters.h"
#include "profile/leading_function.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {

namespace {

constexpr char kKey[] = "follows";
constexpr std::uint16_t kControlWordSource = 509, kSetpointSource = 510;

std::optional<DriveIndex> indexOf(const std::string& name, const CycleConfig& config) {
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    if (config.drives[i].name == name) return i;
  }
  return std::nullopt;
}

std::string otherDrives(const CycleConfig& config, DriveIndex drive) {
  std::string names;
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    if (i != drive) names += (names.empty() ? "" : ", ") + config.drives[i].name;
  }
  return names.empty() ? "another drive, and there is none" : "one of the other drives: " + names;
}

bool isWheel(const CycleConfig& config, DriveIndex drive) {
  if (!config.base) return false;
  const std::vector<DriveIndex> wheels = config.base->wheels();
  return std::find(wheels.begin(), wheels.end(), drive) != wheels.end();
}

bool isArray(std::uint16_t number, profile::Series series) noexcept {
  const profile::CycleParameter* const parameter = profile::findCycleParameter(number, series);
  return parameter != nullptr && profile::isArray(parameter->shape);
}

}  // namespace

void readLeaders(const std::vector<DriveSettings>& sources, CycleConfig& config, bool all_drives) {
  for (DriveIndex i = 0; i < sources.size(); ++i) {
    const Settings& settings = *sources[i].settings;
    noteSetting(settings, kKey, {"a text", "", "", ""});
    const auto name = settings.text(kKey);
    if (!name) continue;
    DriveSetup& drive = config.drives[i];
    drive.follows = *name;
    drive.leader = indexOf(*name, config);
    const std::string found = "\"" + *name + "\"";
    if (drive.leader == i || (!drive.leader && all_drives)) {
      throw wrongSetting(settings, kKey, found, otherDrives(config, i));
    }
    if (isWheel(config, i)) {
      throw wrongSetting(settings, kKey, found, "no such key of a wheel of the base, which is commanded by itself");
    }
  }
  for (DriveIndex i = 0; i < sources.size(); ++i) {
    const auto leader = config.drives[i].leader;
    if (!leader || config.drives[*leader].follows.empty()) continue;
    throw wrongSetting(*sources[i].settings, kKey, "\"" + config.drives[i].follows + "\"",
                       "a drive that follows no other one itself");
  }
}

std::vector<DriveIndex> followersOf(const CycleConfig& config, DriveIndex leader) {
  std::vector<DriveIndex> followers;
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    if (config.drives[i].leader == leader) followers.push_back(i);
  }
  return followers;
}

std::optional<drive::UnexpectedSource> unexpectedSource(const DeviceData& device, profile::Series series,
                                                        bool follows) noexcept {
  const auto& control_word = device.control_word_source;
  const auto& setpoint = device.setpoint_source;
  const bool led = control_word && profile::isBroadcastControlWord(series, *control_word);
  const bool pulled = setpoint && profile::isBroadcastSetpoint(series, *setpoint);
  // With its control word from a leader and a setpoint of its own (P510 neither broadcast nor 0) it is led all the same.
  if (led || pulled) {
    if (follows) return std::nullopt;
    if (led) return drive::UnexpectedSource{kControlWordSource, false, *control_word, false};
    return drive::UnexpectedSource{kSetpointSource, isArray(kSetpointSource, series), *setpoint, false};
  }
  if (!follows || !control_word || !setpoint) return std::nullopt;
  return drive::UnexpectedSource{kSetpointSource, isArray(kSetpointSource, series), *setpoint, true};
}

Sentence followsMessage(const DeviceData& device, profile::Series series) noexcept {
  Sentence text;
  const auto found = unexpectedSource(device, series, false);
  if (!found) return text;
  text.format("P%u%s = %d (broadcast): its %s from another inverter", unsigned{found->number},
              found->is_array ? "[-01]" : "", static_cast<int>(found->found),
              found->number == kControlWordSource ? "control word comes" : "setpoint comes");
  return text;
}

}  // namespace nord_driver::cycle

#include "cycle/leaders.h"

#include <algorithm>
#include <numeric>

#include "config/nearest_name.h"
#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "cycle/joint_limits.h"
#include "profile/cycle_parameters.h"
#include "profile/leading_function.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {

namespace {

constexpr char kKey[] = "follows";
constexpr std::uint16_t kControlWordSource = 509, kSetpointSource = 510;
constexpr std::int32_t kTerminalsOnly = 1;

std::optional<DriveIndex> indexOf(const std::string& name, const CycleConfig& config) {
  const auto found = std::find_if(config.drives.begin(), config.drives.end(),
                                  [&name](const DriveSetup& drive) { return drive.name == name; });
  if (found == config.drives.end()) return std::nullopt;
  return static_cast<DriveIndex>(found - config.drives.begin());
}

std::string otherDrives(const CycleConfig& config, DriveIndex drive) {
  std::string names;
  for (DriveIndex i = 0; i < config.drives.size(); ++i) {
    if (i != drive) names += (names.empty() ? "" : ", ") + config.drives[i].name;
  }
  return names.empty() ? "another drive, and there is none" : "one of the other drives: " + names;
}

bool isOfBase(const CycleConfig& config, DriveIndex drive) {
  if (!config.base) return false;
  const std::vector<DriveIndex> drives = config.base->drives();
  return std::find(drives.begin(), drives.end(), drive) != drives.end();
}

bool isArray(std::uint16_t number, profile::Series series) noexcept {
  const profile::CycleParameter* const parameter = profile::findCycleParameter(number, series);
  return parameter != nullptr && profile::isArray(parameter->shape);
}

std::optional<drive::UnexpectedSource> broadcastSource(const DeviceData& device, profile::Series series) noexcept {
  const auto& control_word = device.control_word_source;
  const auto& setpoint = device.setpoint_source;
  if (control_word && profile::isBroadcastControlWord(series, *control_word)) {
    return drive::UnexpectedSource{kControlWordSource, false, *control_word, false};
  }
  if (setpoint && profile::isBroadcastSetpoint(series, *setpoint)) {
    return drive::UnexpectedSource{kSetpointSource, isArray(kSetpointSource, series), *setpoint, false};
  }
  return std::nullopt;
}

// A drive that obeys the control word of this bus, and not its setpoint: enabled, no setpoint 0 stops it. Where P509 is
// the terminals status bit 9 refuses it. P510 of SK 300E, 700E and 750E is the auxiliary setpoint alone.
std::optional<drive::UnexpectedSource> setpointFromElsewhere(const DeviceData& device,
                                                             profile::Series series) noexcept {
  const auto& control_word = device.control_word_source;
  const auto& setpoint = device.setpoint_source;
  if (!control_word || *control_word <= kTerminalsOnly) return std::nullopt;
  if (profile::findCycleParameter(kSetpointSource, series) == nullptr) {
    if (!profile::isControlWordAlone(series, *control_word)) return std::nullopt;
    return drive::UnexpectedSource{kControlWordSource, false, *control_word, false, true};
  }
  if (!setpoint || *setpoint == 0 || *setpoint == *control_word) return std::nullopt;
  return drive::UnexpectedSource{kSetpointSource, isArray(kSetpointSource, series), *setpoint, false, true};
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
    if (isOfBase(config, i)) {
      throw wrongSetting(settings, kKey, found, "no such key of a drive of the base, which is commanded by itself");
    }
    // What a follower makes of its leader's position setpoint, none of the manuals says; and two axes that are stopped
    // by OFF1 each on its own ramp would pull at one load.
    if (drive.position || (drive.leader && config.drives[*drive.leader].position)) {
      throw wrongSetting(settings, kKey, found, "no such key where one of both is `mode: position`");
    }
    refuseJointLimits(settings, "none: this drive follows " + found + ", whose limits count");
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

std::vector<DriveIndex> groupsOf(const CycleConfig& config) {
  std::vector<DriveIndex> groups(config.drives.size());
  std::iota(groups.begin(), groups.end(), DriveIndex{0});
  const std::vector<DriveIndex> of_base = config.base ? config.base->drives() : std::vector<DriveIndex>{};
  for (const DriveIndex drive : of_base) groups[drive] = of_base.front();
  for (DriveIndex i = 0; i < groups.size(); ++i) {
    if (config.drives[i].leader) groups[i] = groups[*config.drives[i].leader];
  }
  return groups;
}

std::optional<drive::UnexpectedSource> unexpectedSource(const DeviceData& device, profile::Series series, bool follows,
                                                        bool told_by_telegram) noexcept {
  const auto& control_word = device.control_word_source;
  const auto& setpoint = device.setpoint_source;
  if (follows) {
    // Enabled by a leader, or by us, it would hold the setpoint of this bus, which nobody gives it: 0, against the
    // other's load. Where one of both was not read the configuration counts.
    if (profile::isLed(series, control_word, setpoint) || !control_word || !setpoint) return std::nullopt;
    return drive::UnexpectedSource{kSetpointSource, isArray(kSetpointSource, series), *setpoint, true};
  }
  const auto broadcast = broadcastSource(device, series);
  if (broadcast || told_by_telegram) return broadcast;
  return setpointFromElsewhere(device, series);
}

Sentence followsMessage(const DeviceData& device, profile::Series series) noexcept {
  Sentence text;
  const auto found = broadcastSource(device, series);
  if (!found) return text;
  text.format("P%u%s = %d (broadcast): its %s from another inverter", unsigned{found->number},
              found->is_array ? "[-01]" : "", static_cast<int>(found->found),
              found->number == kControlWordSource ? "control word comes" : "setpoint comes");
  return text;
}

}  // namespace nord_driver::cycle

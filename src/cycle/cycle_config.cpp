#include "cycle/cycle_config.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "config/drive_common.h"
#include "config/setting_checks.h"
#include "config/setting_choice.h"
#include "config/setting_groups.h"
#include "config/setting_note.h"
#include "cycle/joint_limits.h"
#include "cycle/leaders.h"
#include "cycle/position_bit_setup.h"

namespace nord_driver::cycle {

namespace {

constexpr double kMinCycleRate = 1.0, kMaxCycleRate = 1000.0;  // Hz
constexpr Choice<bool> kAcknowledgeAtStart[] = {{"none", false}, {"bus_timeouts", true}};
constexpr Duration kMinDriveTimeout = std::chrono::milliseconds{50};

std::optional<robot::JointRange> rangeOf(const std::string& joint, const std::string& robot_description) {
  if (joint.empty() || robot_description.empty()) return std::nullopt;
  try {
    return robot::UrdfGeometry{robot_description}.range(joint);
  } catch (const std::invalid_argument& wrong) {
    throw ConfigError(wrong.what());
  }
}

DriveSetup readDrive(const DriveSettings& source, const CycleConfig& config, Duration drive_timeout,
                     const std::string& robot_description) {
  const Settings& settings = *source.settings;
  if (!isRosName(source.name)) {  // it becomes a part of topic names
    throw ConfigError(settings.fullName("") + ": \"" + source.name +
                      "\" is not valid, expected a name of letters, digits and underscores that begins with a letter");
  }
  const DriveCommon common = readDriveCommon(source);
  DriveSetup setup;
  setup.name = common.name;
  setup.joint = common.joint;
  setup.series = common.series;
  setup.address = common.address;
  if (common.typed_max_frequency) setup.typed_max_frequency = common.typed_max_frequency->value;
  setup.rated_current = common.rated_current;
  setup.drive.joint = common.scaling;
  setup.drive.allow_minimum_frequency = common.allow_minimum_frequency;
  setup.drive.drive_timeout = drive_timeout;
  setup.drive.enable_timeout = config.service_timeout;
  setup.drive.shutdown_timeout = config.shutdown_timeout;
  setup.words = readWordSetup(settings, setup.series, config.cmd_vel_timeout);
  if (readDriveMode(settings) == DriveMode::kPosition) {
    setup.position =
        readPositionSetup(settings, {setup.series, common.scaling, rangeOf(setup.joint, robot_description)});
    checkSignalsApart(settings, *setup.position, setup.words.signals);
    setup.drive.position = setup.position->axis;
  } else {
    refusePositionKeys(settings);
  }
  return setup;
}

void refuseJointUsedTwice(const Settings& settings, const DriveSetup& drive, const std::vector<DriveSetup>& others) {
  for (const DriveSetup& other : others) {
    if (drive.joint.empty() || drive.joint != other.joint) continue;
    throw wrongSetting(settings, "joint", "\"" + drive.joint + "\"",
                       "a joint that drive \"" + other.name + "\" does not turn already");
  }
}

void readLimitsOfSingles(const std::vector<DriveSettings>& sources, CycleConfig& config) {
  const std::vector<DriveIndex> wheels = config.base ? config.base->wheels() : std::vector<DriveIndex>{};
  for (DriveIndex i = 0; i < sources.size(); ++i) {
    const Settings& settings = *sources[i].settings;
    const bool is_wheel = std::find(wheels.begin(), wheels.end(), i) != wheels.end();
    if (config.drives[i].position) {
      if (is_wheel) {
        throw wrongSetting(settings, "mode", "\"position\"",
                           "velocity: joint \"" + config.drives[i].joint + "\" is a wheel of the base");
      }
      refuseJointLimits(settings, "position/speed: a drive that positions travels along the inverter's own ramps");
    } else if (!is_wheel) {
      config.drives[i].limits = readJointLimits(settings);
    } else {
      refuseJointLimits(settings,
                        "none: this drive belongs to the base, whose limits are those of linear/x and angular/z");
    }
  }
}

// They follow a fresh velocity command; a steering drive follows what its base does.
void refuseMovingSetpoints(const std::vector<DriveSettings>& sources, const CycleConfig& config) {
  const std::vector<DriveIndex> of_base = config.base ? config.base->drives() : std::vector<DriveIndex>{};
  for (DriveIndex i = 0; i < sources.size(); ++i) {
    if (!config.drives[i].position || std::find(of_base.begin(), of_base.end(), i) != of_base.end()) continue;
    for (const SetpointSetup& setpoint : config.drives[i].words.setpoints) {
      if (!setpoint.moves) continue;
      throw wrongSetting(*sources[i].settings, "setpoints/" + setpoint.name + "/function",
                         "\"" + std::string(setpointWord(setpoint.use)) + "\"",
                         "one that turns no motor: a drive with mode: position has no velocity command");
    }
  }
}

SteeringRanges steeringRanges(const CycleConfig& config) {
  SteeringRanges ranges;
  for (const DriveSetup& setup : config.drives) {
    ranges.emplace_back();
    const bool turns = setup.position && setup.position->axis.unit_per_radian == 1.0;
    if (turns) ranges.back() = SteeringRange{setup.position->axis.lower, setup.position->axis.upper};
  }
  return ranges;
}

drive::StopWay readStopWay(const Settings& settings, const char* key, drive::StopWay fallback, bool may_hold) {
  noteSetting(settings, key,
              {std::string("one of ") + (may_hold ? "setpoint_zero, " : "") + "off1, quick_stop, coast", "", "",
               fallback == drive::StopWay::kSetpointZero ? "setpoint_zero" : "off1"});
  const auto word = settings.text(key);
  if (!word) return fallback;
  if (may_hold && *word == "setpoint_zero") return drive::StopWay::kSetpointZero;
  if (*word == "off1") return drive::StopWay::kOff1;
  if (*word == "quick_stop") return drive::StopWay::kQuickStop;
  if (*word == "coast") return drive::StopWay::kCoast;
  throw wrongSetting(settings, key, "\"" + *word + "\"",
                     std::string(may_hold ? "setpoint_zero, " : "") + "off1, quick_stop or coast");
}

drive::StopWays readStopWays(const Settings& settings) {
  drive::StopWays ways;
  ways.command_timeout = readStopWay(settings, "stop/command_timeout", ways.command_timeout, true);
  ways.disable = readStopWay(settings, "stop/disable", ways.disable, false);
  ways.drive_stopped = readStopWay(settings, "stop/drive_stopped", ways.drive_stopped, true);
  return ways;
}

}  // namespace

CycleConfig readCycleConfig(const Settings& node, const std::vector<DriveSettings>& drives,
                            const std::string& robot_description, bool all_drives) {
  CycleConfig config;
  config.cycle_rate = numberOr(node, "cycle_rate", 100.0, kMinCycleRate, kMaxCycleRate, "Hz");
  config.real_time.priority = static_cast<int>(integerOr(node, "realtime_priority", 0, 0, 99));
  config.real_time.lock_memory = booleanOr(node, "lock_memory", false);
  config.service_timeout = seconds(numberOr(node, "service_timeout", 3.0, 0.1, 60.0, "s"));
  config.shutdown_timeout = seconds(numberOr(node, "shutdown_timeout", 10.0, 0.1, 600.0, "s"));
  config.cmd_vel_timeout = seconds(numberOr(node, "cmd_vel_timeout", 0.5, 0.0, 60.0, "s"));
  config.acknowledge_bus_timeouts = choiceOr(node, "acknowledge_at_start", false, kAcknowledgeAtStart);
  config.stop_ways = readStopWays(node);
  config.drive_timeout_given = node.has("drive_timeout");
  const Duration default_drive_timeout = std::max(kMinDriveTimeout, 3 * config.period());
  const Duration drive_timeout = seconds(
      numberOr(node, "drive_timeout", toSeconds(default_drive_timeout), toSeconds(2 * config.period()), 60.0, "s"));

  if (drives.empty()) {
    throw missingSetting(node, "drives", "at least one drive with its address");
  }
  JointNames joints;
  for (const DriveSettings& source : drives) {
    DriveSetup drive = readDrive(source, config, drive_timeout, robot_description);
    refuseJointUsedTwice(*source.settings, drive, config.drives);
    joints.push_back(drive.joint);
    config.drives.push_back(std::move(drive));
  }
  config.base = readBaseConfig(node, joints, robot_description, steeringRanges(config));
  readLimitsOfSingles(drives, config);
  if (all_drives) refuseMovingSetpoints(drives, config);  // else the base may be unknown, and what it steers
  readLeaders(drives, config, all_drives);
  return config;
}

}  // namespace nord_driver::cycle

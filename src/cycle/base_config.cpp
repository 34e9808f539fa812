#include "cycle/base_config.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "config/setting_checks.h"
#include "robot/steered_reach.h"
#include "robot/urdf_geometry.h"

namespace nord_driver::cycle {

namespace {

std::vector<DriveIndex> readWheels(const Settings& settings, const std::string& key, const JointNames& joints) {
  constexpr const char* kExpected = "the joint name of a drive, or a list of them";
  const auto names = settings.texts(key);
  if (!names) throw missingSetting(settings, key, kExpected);
  if (names->empty()) throw wrongSetting(settings, key, "[]", kExpected);
  std::vector<DriveIndex> wheels;
  for (const std::string& name : *names) {
    const auto at = std::find(joints.begin(), joints.end(), name);
    if (name.empty() || at == joints.end()) {
      throw wrongSetting(settings, key, "\"" + name + "\"", "the `joint` of one of the drives");
    }
    wheels.push_back(static_cast<DriveIndex>(at - joints.begin()));
  }
  return wheels;
}

void refuseWheelsUsedTwice(const Settings& settings, const BaseConfig& base, const JointNames& joints) {
  std::vector<DriveIndex> all = base.wheels();
  std::sort(all.begin(), all.end());
  const auto twice = std::adjacent_find(all.begin(), all.end());
  if (twice != all.end()) {
    throw wrongSetting(settings, "right_wheel", "\"" + joints[*twice] + "\"", "every wheel joint only once");
  }
}

robot::SpeedLimits readLimits(const Settings& settings, const std::string& axis) {
  robot::SpeedLimits limits;
  const auto number = [&](const char* key) { return settings.number(axis + "/" + key); };
  limits.has_velocity_limits = booleanOr(settings, axis + "/has_velocity_limits", false);
  limits.max_velocity = number("max_velocity").value_or(0.0);
  limits.min_velocity = number("min_velocity");
  limits.has_acceleration_limits = booleanOr(settings, axis + "/has_acceleration_limits", false);
  limits.max_acceleration = number("max_acceleration").value_or(0.0);
  limits.min_acceleration = number("min_acceleration");
  limits.has_jerk_limits = booleanOr(settings, axis + "/has_jerk_limits", false);
  limits.max_jerk = number("max_jerk").value_or(0.0);
  limits.min_jerk = number("min_jerk");
  const std::string problem = robot::problemOf(limits, settings.fullName(axis));
  if (!problem.empty()) throw ConfigError(problem);
  return limits;
}

/// Who types a limit in means it to hold; a file that says `false` is taken at its word.
void warnOfLimitsThatAreOff(const Settings& settings, const std::string& axis, std::vector<std::string>& warnings) {
  for (const std::string kind : {"velocity", "acceleration", "jerk"}) {
    const std::string limit = axis + "/max_" + kind, flag = axis + "/has_" + kind + "_limits";
    if (!settings.has(limit) || settings.has(flag)) continue;
    warnings.push_back(settings.fullName(limit) + " limits nothing as long as " + settings.fullName(flag) +
                       " is not true");
  }
}

robot::BaseKind readKind(const Settings& settings) {
  const std::string kind = wordOr(settings, "base_type", "differential", "differential, mecanum, steered");
  if (kind == "differential") return robot::BaseKind::kDifferential;
  if (kind == "mecanum") return robot::BaseKind::kMecanum;
  if (kind == "steered") return robot::BaseKind::kSteered;
  throw wrongSetting(settings, "base_type", "\"" + kind + "\"", "differential, mecanum or steered");
}

/// A size in m: typed in, or from the robot description by `look_up`.
template <typename LookUp>
double readSize(const Settings& settings, const char* key, bool has_description, LookUp look_up) {
  constexpr double kSmallest = 1e-3, kLargest = 100.0;
  if (settings.has(key)) return requiredNumber(settings, key, kSmallest, kLargest, "m");
  if (has_description) return look_up();
  throw missingSetting(settings, key,
                       "a number from " + shortNumber(kSmallest) + " to " + shortNumber(kLargest) +
                           " m, or the robot's URDF in robot_description, which it is taken from then");
}

/// The joints' limits of a description nothing else is taken from: it may be of another part of the robot, without our
/// wheels. What it does not tell is no reason to refuse, but is said, and takes nothing away from the other joints.
std::vector<double> limitsIfThere(const std::string& urdf, const JointNames& wheels,
                                  std::vector<std::string>& warnings) {
  std::optional<robot::UrdfGeometry> description;
  try {
    description.emplace(urdf);
  } catch (const std::invalid_argument& error) {
    warnings.push_back(std::string(error.what()) + "; no velocity limit of its joints is kept");
    return {};
  }
  std::vector<double> limits;
  for (const std::string& joint : wheels) {
    try {
      limits.push_back(description->maxVelocities({joint}).front());
    } catch (const std::invalid_argument& error) {
      warnings.push_back(std::string(error.what()) + "; no velocity limit is kept for it");
      limits.push_back(std::numeric_limits<double>::infinity());
    }
  }
  const bool none = std::all_of(limits.begin(), limits.end(), [](double limit) { return std::isinf(limit); });
  return none ? std::vector<double>{} : limits;
}

/// Robots were drawn for diff_drive_controller with their wheels along x: it takes the distance of the first joints
/// wherever they stand.
double separationFrom(const robot::UrdfGeometry& description, BaseConfig& base, const std::string& base_link,
                      const JointNames& left, const JointNames& right) {
  if (base.kind != robot::BaseKind::kDifferential || !description.inLine(left, right)) {
    return description.wheelSeparation(left, right);
  }
  const double distance = description.jointDistance(left.front(), right.front());
  base.warnings.push_back("robot_description: the joints \"" + left.front() + "\" and \"" + right.front() +
                          "\" stand in line along x of \"" + base_link + "\"; their distance, " +
                          shortNumber(distance) +
                          " m, is taken for wheel_separation, as diff_drive_controller does. Nobody can see there "
                          "whether left and right are exchanged, and odom calls the way the wheels roll x");
  return distance;
}

JointNames namesOf(const std::vector<DriveIndex>& drives, const JointNames& joints) {
  JointNames names;
  for (const DriveIndex drive : drives) names.push_back(joints[drive]);
  return names;
}

void readGeometry(BaseConfig& base, const Settings& settings, const JointNames& joints, const std::string& urdf) {
  const JointNames left = namesOf(base.left, joints);
  const JointNames right = namesOf(base.right, joints);
  const bool all_typed = settings.has("wheel_separation") && settings.has("wheel_radius") &&
                         (base.kind != robot::BaseKind::kMecanum || settings.has("wheel_base"));
  std::optional<robot::UrdfGeometry> description;
  const std::string base_link = textOr(settings, "base_frame_id", "base_link");
  if (!urdf.empty() && !all_typed) description.emplace(urdf, base_link);
  const auto size = [&](const char* key, auto look_up) {
    return readSize(settings, key, description.has_value(), look_up);
  };

  robot::BaseGeometry& geometry = base.geometry;
  geometry.wheel_separation =
      size("wheel_separation", [&] { return separationFrom(*description, base, base_link, left, right); });
  geometry.left_wheel_radius = size("wheel_radius", [&] { return description->wheelRadius(left); });
  geometry.right_wheel_radius = size("wheel_radius", [&] { return description->wheelRadius(right); });
  if (base.kind == robot::BaseKind::kMecanum) {
    geometry.wheel_base = size("wheel_base", [&] { return description->wheelBase(left, right); });
  }
  if (description) {
    base.joint_velocity_limits = description->maxVelocities(namesOf(base.wheels(), joints));
  } else if (!urdf.empty()) {
    base.joint_velocity_limits = limitsIfThere(urdf, namesOf(base.wheels(), joints), base.warnings);
  }

  const auto multiplier = [&](const char* key, double fallback) {
    return numberOr(settings, key, fallback, 0.01, 100.0, "");
  };
  geometry.wheel_separation_multiplier = multiplier("wheel_separation_multiplier", 1.0);
  geometry.left_wheel_radius_multiplier = multiplier("left_wheel_radius_multiplier", 1.0);
  geometry.right_wheel_radius_multiplier = multiplier("right_wheel_radius_multiplier", 1.0);
  // As in diff_drive_controller the common one wins: dynamic_reconfigure leaves the other two on the parameter server,
  // where a later start would find them.
  if (settings.has("wheel_radius_multiplier")) {
    const double both = multiplier("wheel_radius_multiplier", 1.0);
    geometry.left_wheel_radius_multiplier = geometry.right_wheel_radius_multiplier = both;
  }
}

/// As readGeometry does it: what is typed in wins, the description gives the rest and the limits of the wheels.
void readAxles(BaseConfig& base, const Settings& settings, const JointNames& joints, const std::string& urdf,
               const SteeringRanges& ranges) {
  for (const char* key : {"left_wheel", "right_wheel"}) {
    if (settings.has(key)) throw wrongSetting(settings, key, "one", "none beside base_type: steered");
  }
  std::optional<robot::UrdfGeometry> description;
  const std::string base_link = textOr(settings, "base_frame_id", "base_link");
  if (!urdf.empty() && !steeredSizesAreTyped(settings)) description.emplace(urdf, base_link);
  base.steered = readSteeredConfig(settings, joints, description ? &*description : nullptr, ranges);
  const JointNames wheels = namesOf(base.steered->wheels, joints);
  if (description) {
    base.joint_velocity_limits = description->maxVelocities(wheels);
  } else if (!urdf.empty()) {
    base.joint_velocity_limits = limitsIfThere(urdf, wheels, base.warnings);
  }
}

void readAllLimits(BaseConfig& base, const Settings& settings) {
  const auto read = [&](const char* axis) {
    warnOfLimitsThatAreOff(settings, axis, base.warnings);
    return readLimits(settings, axis);
  };
  base.limits.linear_x = read("linear/x");
  base.limits.angular_z = read("angular/z");
  if (base.movesSideways()) base.limits.linear_y = read("linear/y");
  base.limits.limit_axes_independently = booleanOr(settings, "limit_axes_independently", false);
  // Each axis for itself bends the path, and the wheels would have to be steered anew with every step.
  if (base.steered && base.limits.limit_axes_independently) {
    throw wrongSetting(settings, "limit_axes_independently", "true", "false with base_type: steered");
  }
}

}  // namespace

std::vector<DriveIndex> BaseConfig::wheels() const {
  if (steered) return steered->wheels;
  std::vector<DriveIndex> all = left;
  all.insert(all.end(), right.begin(), right.end());
  return all;
}

std::vector<DriveIndex> BaseConfig::drives() const {
  std::vector<DriveIndex> all = wheels();
  if (steered) all.insert(all.end(), steered->steering.begin(), steered->steering.end());
  return all;
}

std::unique_ptr<robot::BaseKinematics> BaseConfig::kinematics() const {
  if (steered) return std::make_unique<robot::SteeredReach>(steered->axles);
  return robot::makeKinematics(kind, geometry, left.size(), right.size());
}

robot::WheelSpeeds wheelLimits(const BaseConfig& config) {
  const std::size_t wheels = config.wheels().size();
  robot::WheelSpeeds limits;
  if (config.joint_velocity_limits.empty()) {
    for (std::size_t i = 0; i < wheels; ++i) limits.push_back(std::numeric_limits<double>::infinity());
  } else if (config.joint_velocity_limits.size() == wheels) {
    for (const double limit : config.joint_velocity_limits) limits.push_back(limit);
  } else {
    throw std::invalid_argument(std::to_string(config.joint_velocity_limits.size()) +
                                " joints have a velocity limit, expected one for each of the base's " +
                                std::to_string(wheels) + " wheels");
  }
  return limits;
}

std::optional<BaseConfig> readBaseConfig(const Settings& settings, const JointNames& joints,
                                         const std::string& robot_description, const SteeringRanges& ranges) {
  BaseConfig base;
  const bool steered = settings.text("base_type") == std::optional<std::string>("steered");
  if (!steered && !settings.has("left_wheel")) {
    if (settings.has("right_wheel")) {
      throw missingSetting(settings, "left_wheel", "it beside " + settings.fullName("right_wheel"));
    }
    return std::nullopt;
  }
  base.kind = readKind(settings);
  if (!steered) {
    base.left = readWheels(settings, "left_wheel", joints);
    base.right = readWheels(settings, "right_wheel", joints);
    refuseWheelsUsedTwice(settings, base, joints);
  }
  try {
    steered ? readAxles(base, settings, joints, robot_description, ranges)
            : readGeometry(base, settings, joints, robot_description);
    base.kinematics();
  } catch (const std::invalid_argument& error) {
    throw ConfigError(error.what());
  }
  readAllLimits(base, settings);
  base.open_loop = booleanOr(settings, "open_loop", false);
  base.velocity_rolling_window_size =
      static_cast<std::size_t>(integerOr(settings, "velocity_rolling_window_size", 10, 1, 10'000));
  return base;
}

}  // namespace nord_driver::cycle

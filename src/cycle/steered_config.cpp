#include "cycle/steered_config.h"

#include <algorithm>
#include <array>

#include "config/setting_checks.h"
#include "config/setting_note.h"
#include "robot/steered_kinematics.h"

namespace nord_driver::cycle {

namespace {

constexpr std::array<const char*, 2> kAxles{"front", "rear"};
constexpr double kLargestPlace = 100.0;        // m
constexpr double kLargestAngle = 18.84955592;  // rad, three turns
constexpr double kTolerance = 0.05;            // rad
constexpr double kSmallestTolerance = 0.001, kLargestTolerance = 0.5;

std::string keyOf(const std::string& axle, const char* key) {
  return "steered/" + axle + "/" + key;
}

DriveIndex readJoint(const Settings& settings, const std::string& key, const std::vector<std::string>& joints) {
  noteSetting(settings, key, {"a text", "", "", ""});
  const std::string name = requiredText(settings, key, "the `joint` of one of the drives");
  const auto at = std::find(joints.begin(), joints.end(), name);
  if (at == joints.end()) throw wrongSetting(settings, key, "\"" + name + "\"", "the `joint` of one of the drives");
  return static_cast<DriveIndex>(at - joints.begin());
}

/// What is typed in, or else taken from the description.
template <typename LookUp>
double readOr(const Settings& settings, const std::string& key, double min, double max, const char* unit,
              const robot::UrdfGeometry* description, LookUp look_up) {
  noteSetting(settings, key, {"a number", shortNumber(min) + " to " + shortNumber(max), unit, ""});
  if (settings.has(key)) return requiredNumber(settings, key, min, max, unit);
  if (description != nullptr) return look_up(*description);
  throw missingSetting(settings, key,
                       "a number from " + shortNumber(min) + " to " + shortNumber(max) + " " + unit +
                           ", or the robot's URDF in robot_description, which it is taken from then");
}

/// The narrower of what is typed in and what holds for the drive.
void readRange(const Settings& settings, const std::string& axle, const SteeringRange& of_drive,
               robot::SteeredAxle& read) {
  constexpr const char* kUnit = "rad";
  const auto limit = [&](const char* key, double min, double max, const std::optional<double>& other, auto narrower) {
    const std::string name = keyOf(axle, key);
    noteSetting(settings, name, {"a number", shortNumber(min) + " to " + shortNumber(max), kUnit, ""});
    if (!settings.has(name)) {
      if (other) return *other;
      throw missingSetting(
          settings, name,
          "a number from " + shortNumber(min) + " to " + shortNumber(max) +
              " rad, or a limit of the steering joint (position/lower, position/upper of its drive, or "
              "the URDF's), which it is taken from then");
    }
    const double typed = requiredNumber(settings, name, min, max, kUnit);
    return other ? narrower(typed, *other) : typed;
  };
  const auto larger = [](double a, double b) { return std::max(a, b); };
  const auto smaller = [](double a, double b) { return std::min(a, b); };
  read.min_angle = limit("min_angle", -kLargestAngle, 0.0, of_drive.lower, larger);
  read.max_angle = limit("max_angle", 0.0, kLargestAngle, of_drive.upper, smaller);
}

robot::SteeredAxle readAxle(const Settings& settings, const std::string& axle, const std::string& steering,
                            const std::string& wheel, const robot::UrdfGeometry* description) {
  using Urdf = robot::UrdfGeometry;
  robot::SteeredAxle read;
  const auto place = [&](const char* key, auto look_up) {
    return readOr(settings, keyOf(axle, key), -kLargestPlace, kLargestPlace, "m", description, look_up);
  };
  read.x = place("x", [&](const Urdf& urdf) { return urdf.steeredWheel(steering, wheel).x; });
  read.y = place("y", [&](const Urdf& urdf) { return urdf.steeredWheel(steering, wheel).y; });
  return read;
}

const SteeringRange& rangeOf(const Settings& settings, const std::string& axle, DriveIndex drive,
                             const std::string& joint, const SteeringRanges& ranges) {
  if (drive < ranges.size() && ranges[drive]) return *ranges[drive];
  throw wrongSetting(settings, keyOf(axle, "steering_joint"), "\"" + joint + "\"",
                     "the joint of a drive with mode: position");
}

void refuseDrivesUsedTwice(const Settings& settings, const SteeredConfig& config,
                           const std::vector<std::string>& joints) {
  std::vector<DriveIndex> seen;
  for (std::size_t i = 0; i < kAxles.size(); ++i) {
    for (const auto& [key, drive] :
         {std::pair{"wheel_joint", config.wheels[i]}, std::pair{"steering_joint", config.steering[i]}}) {
      if (std::find(seen.begin(), seen.end(), drive) != seen.end()) {
        throw wrongSetting(settings, keyOf(kAxles[i], key), "\"" + joints[drive] + "\"",
                           "every joint of the base only once");
      }
      seen.push_back(drive);
    }
  }
}

}  // namespace

bool steeredSizesAreTyped(const Settings& settings) {
  bool typed = settings.has("wheel_radius");
  for (const char* axle : kAxles) {
    for (const char* key : {"x", "y"}) typed = settings.has(keyOf(axle, key)) && typed;
  }
  return typed;
}

SteeredConfig readSteeredConfig(const Settings& settings, const std::vector<std::string>& joints,
                                const robot::UrdfGeometry* description, const SteeringRanges& ranges) {
  SteeredConfig config;
  std::vector<std::string> wheels;
  for (const char* axle : kAxles) {
    config.wheels.push_back(readJoint(settings, keyOf(axle, "wheel_joint"), joints));
    config.steering.push_back(readJoint(settings, keyOf(axle, "steering_joint"), joints));
    wheels.push_back(joints[config.wheels.back()]);
  }
  refuseDrivesUsedTwice(settings, config, joints);
  constexpr double kSmallest = 1e-3;
  const double radius = readOr(settings, "wheel_radius", kSmallest, kLargestPlace, "m", description,
                               [&](const robot::UrdfGeometry& urdf) { return urdf.wheelRadius(wheels); }) *
                        numberOr(settings, "wheel_radius_multiplier", 1.0, 0.01, 100.0, "");
  for (std::size_t i = 0; i < kAxles.size(); ++i) {
    const std::string& steering = joints[config.steering[i]];
    robot::SteeredAxle axle = readAxle(settings, kAxles[i], steering, wheels[i], description);
    readRange(settings, kAxles[i], rangeOf(settings, kAxles[i], config.steering[i], steering, ranges), axle);
    axle.wheel_radius = radius;
    config.axles.push_back(axle);
  }
  config.angle_tolerance =
      numberOr(settings, "steered/angle_tolerance", kTolerance, kSmallestTolerance, kLargestTolerance, "rad");
  robot::SteeredKinematics{config.axles};
  return config;
}

}  // namespace nord_driver::cycle

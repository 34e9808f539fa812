#include "cycle/joint_limits.h"

#include <array>
#include <optional>
#include <string>

#include "config/setting_checks.h"

namespace nord_driver::cycle {

namespace {

struct Limit {
  const char* max;
  const char* min;
  const char* unit;
};
constexpr Limit kVelocity{"max_velocity", "min_velocity", "rad/s"};
constexpr Limit kAcceleration{"max_acceleration", "min_acceleration", "rad/s^2"};
constexpr Limit kJerk{"max_jerk", "min_jerk", "rad/s^3"};
constexpr std::array<Limit, 3> kLimits{kVelocity, kAcceleration, kJerk};

constexpr double kSmallest = 1e-3, kLargest = 1e4;  // of all three, in their units

/// False: neither is given.
bool read(const Settings& drive, const Limit& limit, bool one_way, double& max, std::optional<double>& min) {
  if (!drive.has(limit.max) && !drive.has(limit.min)) return false;
  max = requiredNumber(drive, limit.max, kSmallest, kLargest, limit.unit);
  // A joint may be forbidden to turn backward, but one that cannot speed up or brake would never start or stop.
  const double slowest = one_way ? 0.0 : -kSmallest;
  if (drive.has(limit.min)) min = requiredNumber(drive, limit.min, -kLargest, slowest, limit.unit);
  return true;
}

}  // namespace

robot::SpeedLimits readJointLimits(const Settings& drive) {
  robot::SpeedLimits limits;
  limits.has_velocity_limits = read(drive, kVelocity, true, limits.max_velocity, limits.min_velocity);
  limits.has_acceleration_limits = read(drive, kAcceleration, false, limits.max_acceleration, limits.min_acceleration);
  limits.has_jerk_limits = read(drive, kJerk, false, limits.max_jerk, limits.min_jerk);
  return limits;
}

void refuseJointLimits(const Settings& drive, const std::string& expected) {
  for (const Limit& limit : kLimits) {
    for (const char* key : {limit.max, limit.min}) {
      const auto value = drive.number(key);
      if (!value) continue;
      throw wrongSetting(drive, key, shortNumber(*value), expected);
    }
  }
}

}  // namespace nord_driver::cycle

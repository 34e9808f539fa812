#include "node/ramp_check.h"

#include <algorithm>
#include <cmath>

#include "nord_driver/core/fixed_text.h"
#include "robot/base_kinematics.h"

namespace nord_driver::node {

namespace {

constexpr double kResolution = 0.01;  // s, of P102 and P103

/// The most an axis is asked for, as magnitudes (m/s^2 or rad/s^2).
struct Asked {
  double speed_up = 0.0;
  double brake = 0.0;
};

Asked askedBy(const robot::SpeedLimits& limits) {
  if (!limits.has_acceleration_limits) return {};
  const double max = limits.max_acceleration, min = -limits.minAcceleration();
  const bool reverses = !limits.has_velocity_limits || limits.minVelocity() < 0.0;
  if (!reverses) return {max, min};
  return {std::max(max, min), std::max(max, min)};
}

/// What one unit of motion along an axis is at this wheel, in Hz.
double perUnit(const robot::BaseKinematics& base, const robot::Twist2d& unit, std::size_t wheel,
               const profile::JointScaling& joint) {
  return std::abs(profile::toHertz(RadPerSec{base.wheels(unit)[wheel]}, joint).value);
}

std::string slowerThan(const char* parameter, unsigned set, std::optional<double> time, double max_frequency,
                       double asked, const char* limits) {
  if (!time || asked <= 0.0) return "";
  const double needed = max_frequency / asked;
  if (*time <= needed + kResolution / 2.0) return "";
  FixedText<160> text;
  text.format("%s of set %u is %.2f s (%.1f Hz/s), of which %s ask for up to %.1f Hz/s: %.2f s", parameter, set, *time,
              max_frequency / *time, limits, asked, needed);
  return text.str();
}

}  // namespace

RampCheck::RampCheck(const cycle::CycleConfig& config, DriveIndex drive)
    : typed_max_frequency_(config.drives[drive].typed_max_frequency) {
  const profile::JointScaling& joint = config.drives[drive].drive.joint;
  const std::vector<DriveIndex> wheels = config.base ? config.base->wheels() : std::vector<DriveIndex>{};
  const auto at = std::find(wheels.begin(), wheels.end(), drive);
  if (at == wheels.end()) {
    const Asked asked = askedBy(config.drives[drive].limits);
    const double hertz = std::abs(profile::toHertz(RadPerSec{1.0}, joint).value);
    speed_up_ = asked.speed_up * hertz;
    brake_ = asked.brake * hertz;
    return;
  }
  of_base_ = true;
  const auto wheel = static_cast<std::size_t>(at - wheels.begin());
  const auto base = config.base->kinematics();
  const auto add = [&](const robot::SpeedLimits& limits, const robot::Twist2d& unit) {
    const Asked asked = askedBy(limits);
    const double hertz = perUnit(*base, unit, wheel, joint);
    speed_up_ += asked.speed_up * hertz;
    brake_ += asked.brake * hertz;
  };
  add(config.base->limits.linear_x, {1.0, 0.0, 0.0});
  add(config.base->limits.angular_z, {0.0, 1.0, 0.0});
  add(config.base->limits.linear_y, base->possible({0.0, 0.0, 1.0}));
}

std::string RampCheck::assess(const cycle::DeviceData& device, unsigned parameter_set) const {
  if (parameter_set < 1 || parameter_set > 4) return "";
  const std::size_t set = parameter_set - 1;
  const std::optional<double> max_frequency =
      device.max_frequency[set] ? device.max_frequency[set] : typed_max_frequency_;
  if (!max_frequency) return "";
  const char* limits = of_base_ ? "the base's limits" : "the drive's limits";
  const std::string up =
      slowerThan("P102", parameter_set, device.acceleration_time[set], *max_frequency, speed_up_, limits);
  const std::string down =
      slowerThan("P103", parameter_set, device.deceleration_time[set], *max_frequency, brake_, limits);
  if (up.empty() && down.empty()) return "";
  return std::string("the inverter's ramp is slower than ") + (of_base_ ? "the base: " : "its joint's limits: ") + up +
         (up.empty() || down.empty() ? "" : "; ") + down + ". The " + (of_base_ ? "wheel" : "joint") +
         " lags behind its commands: shorten the ramp, or lower the acceleration limits";
}

}  // namespace nord_driver::node

// A steered base whose axes travel to their angles at a steady rate, and whose wheels turn as they are told.
#pragma once

#include <algorithm>
#include <cmath>

#include "cycle/steered_motion.h"

namespace nord_driver::cycle::steered_bench {

constexpr Duration kCycle = std::chrono::milliseconds{10};
constexpr Duration kTimeout = std::chrono::milliseconds{500};
constexpr double kQuarter = 1.57079632679489662;
constexpr double kTolerance = 0.05;
constexpr double kAcceleration = 1.0;
constexpr double kFullSpeed = 10.0;  // rad/s of a wheel

/// Axles half a metre before and behind the middle, wheels of 0.1 m.
inline BaseConfig config(double range = kQuarter) {
  BaseConfig config;
  config.kind = robot::BaseKind::kSteered;
  SteeredConfig steered;
  steered.wheels = {0, 1};
  steered.steering = {2, 3};
  steered.axles = {{0.5, 0.0, 0.1, -range, range}, {-0.5, 0.0, 0.1, -range, range}};
  steered.angle_tolerance = kTolerance;
  config.steered = steered;
  for (robot::SpeedLimits* axis : {&config.limits.linear_x, &config.limits.angular_z, &config.limits.linear_y}) {
    axis->has_acceleration_limits = true;
    axis->max_acceleration = kAcceleration;
  }
  return config;
}

/// A base whose steering axes travel to their angles at a steady rate, and whose wheels turn as they are told.
struct Base {
  explicit Base(double range = kQuarter) : Base(config(range)) {}
  explicit Base(const BaseConfig& config) : motion(config, kTimeout) {}

  void command(double linear_x, double angular_z = 0.0, double linear_y = 0.0) {
    newest = {{linear_x, angular_z, linear_y}, now, true};
  }
  const robot::SteeredSetpoint& poll() {
    now += kCycle;
    if (keeps_commanding) newest.received = now;
    drives.max_speeds = {full_speed, full_speed};
    setpoint = motion.poll(newest, driving, follow, drives, now, kCycle);
    if (!driving) return setpoint;
    for (std::size_t i = 0; i < 2; ++i) {
      const double most = steering_rate * toSeconds(kCycle);
      drives.angles[i] += std::max(-most, std::min(most, setpoint.angles[i] - drives.angles[i]));
    }
    return setpoint;
  }
  void run(double seconds_long) {
    for (int i = 0; i < static_cast<int>(seconds_long * 100.0); ++i) poll();
  }
  /// How far the wheels stand off the angles that the motion asks for.
  double off() const {
    const robot::SteeredKinematics kinematics{config(9.0).steered->axles};
    return robot::largestDifference(kinematics.solve(motion.limited(), drives.angles, drives.angles).angles,
                                    drives.angles);
  }
  double speed() const {
    return std::hypot(motion.limited().linear_x, motion.limited().linear_y) + std::abs(motion.limited().angular_z);
  }

  SteeredMotion motion;
  SteeredDrives drives{{}, {0.0, 0.0}, {}};
  TwistCommand newest;
  robot::SteeredSetpoint setpoint;
  Instant now{std::chrono::hours{1}};
  double steering_rate = 1.0;  // rad/s
  double full_speed = kFullSpeed;
  bool driving = true;
  bool follow = true;
  bool keeps_commanding = true;
};

}  // namespace nord_driver::cycle::steered_bench

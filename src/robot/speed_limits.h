// The limits of one axis of the base, as the user writes them.
#pragma once

#include <optional>
#include <string>

namespace nord_driver::robot {

/// Names, units and defaults are diff_drive_controller's (`linear/x/...` in m, `angular/z/...` in rad).
/// A `min_` that is not given is the negative of its `max_`. As there, `max_` and `min_` bound the signed value:
/// `min_acceleration` brakes a base that drives forward and speeds up one that drives backward.
struct SpeedLimits {
  bool has_velocity_limits = false;
  double max_velocity = 0.0;           ///< m/s or rad/s, >= 0
  std::optional<double> min_velocity;  ///< m/s or rad/s, <= 0; 0: this axis does not reverse

  bool has_acceleration_limits = false;
  double max_acceleration = 0.0;           ///< m/s^2 or rad/s^2, > 0
  std::optional<double> min_acceleration;  ///< m/s^2 or rad/s^2, < 0

  bool has_jerk_limits = false;
  double max_jerk = 0.0;           ///< m/s^3 or rad/s^3, > 0
  std::optional<double> min_jerk;  ///< m/s^3 or rad/s^3, < 0

  double minVelocity() const noexcept { return min_velocity.value_or(-max_velocity); }
  double minAcceleration() const noexcept { return min_acceleration.value_or(-max_acceleration); }
  double minJerk() const noexcept { return min_jerk.value_or(-max_jerk); }
};

/// What is wrong with these limits, as a sentence that names the key below `axis` ("linear/x"), its value and what was
/// expected; empty when nothing is. Values of a group that is switched off are not looked at.
std::string problemOf(const SpeedLimits& limits, const std::string& axis);

}  // namespace nord_driver::robot

// One step of a ramp towards a target velocity, limited in acceleration and jerk.
#pragma once

#include <limits>

namespace nord_driver::robot {

/// Bounds of a ramp: min_ <= 0 <= max_; infinite where there is no limit.
struct RampLimits {
  double min_acceleration = -std::numeric_limits<double>::infinity();
  double max_acceleration = std::numeric_limits<double>::infinity();
  double min_jerk = -std::numeric_limits<double>::infinity();
  double max_jerk = std::numeric_limits<double>::infinity();
};

/// The acceleration for the next step of `dt` seconds (> 0) when `distance` (target minus present velocity) is left and
/// the last step was made with `acceleration`.
///
/// It is the one that gets to the target soonest inside the limits and, from there, can still be brought back to zero
/// with the jerk limit before the target is passed. diff_drive_controller cuts the jerk without looking ahead and so
/// swings about the target; its factor 2 * dt^2 is not taken over either: here jerk is the change of acceleration per
/// second. The limits are kept even when the target has moved so near that it must be passed.
double nextAcceleration(double distance, double acceleration, const RampLimits& limits, double dt) noexcept;

}  // namespace nord_driver::robot

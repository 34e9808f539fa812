#include "nord_driver/robot/ramp.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::robot {
namespace {

/// The largest acceleration a whose step plus the steps a - u, a - 2u, ... down to zero gain no more velocity than
/// `distance` > 0, where u = `jerk` * dt is what the jerk limit takes off in one step.
///
/// With n further steps the gain is dt * ((n + 1) * a - u * n * (n + 1) / 2); n is the largest for which the gain of
/// a = n * u still fits.
double approachAcceleration(double distance, double jerk, double dt) noexcept {
  const double gain = distance / dt;
  const double u = jerk * dt;
  if (!std::isfinite(u)) return gain;
  const double n = std::floor((std::sqrt(1.0 + 8.0 * gain / u) - 1.0) / 2.0);
  return gain / (n + 1.0) + u * n / 2.0;
}

}  // namespace

double nextAcceleration(double distance, double acceleration, const RampLimits& limits, double dt) noexcept {
  if (distance < 0.0) {
    const RampLimits mirrored{-limits.max_acceleration, -limits.min_acceleration, -limits.max_jerk, -limits.min_jerk};
    return -nextAcceleration(-distance, -acceleration, mirrored, dt);
  }
  const double wanted = distance > 0.0 ? approachAcceleration(distance, -limits.min_jerk, dt) : 0.0;
  const double by_jerk =
      std::max(acceleration + limits.min_jerk * dt, std::min(acceleration + limits.max_jerk * dt, wanted));
  return std::max(limits.min_acceleration, std::min(limits.max_acceleration, by_jerk));
}

}  // namespace nord_driver::robot

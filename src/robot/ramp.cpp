#include "robot/ramp.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::robot {
namespace {

/// The largest acceleration a that can still be wound down to zero within `distance` > 0 after a step of `dt` with it,
/// however short or long the steps after it are: cycles are late, and the next ones early. Winding down at `jerk` gains
/// less than a^2 / (2 jerk), and the shorter its steps, the nearer to that: a * dt + a^2 / (2 jerk) = distance.
double approachAcceleration(double distance, double jerk, double dt) noexcept {
  const double u = jerk * dt;
  if (!std::isfinite(u)) return distance / dt;
  // u * (sqrt(1 + x) - 1) without the loss of digits where x is small
  const double x = 2.0 * distance / (u * dt);
  return u * x / (std::sqrt(1.0 + x) + 1.0);
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

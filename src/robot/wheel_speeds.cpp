#include "nord_driver/robot/wheel_speeds.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::robot {
namespace {

double shareOf(double speed, double max) noexcept {
  const double magnitude = std::abs(speed);
  return magnitude > max ? max / magnitude : 1.0;
}

}  // namespace

WheelSpeeds scaleInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept {
  // Written so that a NaN limit fails the comparison too.
  if (!(max.left > 0.0) || !(max.right > 0.0)) return {};
  if (!std::isfinite(wanted.left) || !std::isfinite(wanted.right)) return {};
  const double factor = std::min(shareOf(wanted.left, max.left), shareOf(wanted.right, max.right));
  return {wanted.left * factor, wanted.right * factor};
}

}  // namespace nord_driver::robot

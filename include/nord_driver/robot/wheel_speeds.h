// The speeds of the two sides of a base, and keeping them inside what the drives can turn.
#pragma once

namespace nord_driver::robot {

/// Angular velocities at the wheel joints, rad/s, positive: the wheel rolls the base forward.
struct WheelSpeeds {
  double left = 0.0;
  double right = 0.0;
};

constexpr bool operator==(const WheelSpeeds& a, const WheelSpeeds& b) noexcept {
  return a.left == b.left && a.right == b.right;
}

/// Scales both sides by one factor, so that neither exceeds its limit and the path keeps its curvature.
/// A side cut alone would bend the path. `max` holds magnitudes in rad/s (share 100 % of P105 at the joint, or less);
/// a limit that is not positive, or speeds that are not finite, give zero on both sides.
WheelSpeeds scaleInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept;

}  // namespace nord_driver::robot

// Motion of a wheeled base in its own plane (REP-103: x forward, y left, yaw counter-clockwise).
#pragma once

#include <cmath>

namespace nord_driver::robot {

/// Velocity of the base in its own frame. Sideways comes last, so that {linear, angular} stays the motion of a base
/// that cannot go sideways.
struct Twist2d {
  double linear_x = 0.0;   ///< m/s, positive forward
  double angular_z = 0.0;  ///< rad/s, positive counter-clockwise seen from above
  double linear_y = 0.0;   ///< m/s, positive to the left
};

inline bool isFinite(const Twist2d& twist) noexcept {
  return std::isfinite(twist.linear_x) && std::isfinite(twist.angular_z) && std::isfinite(twist.linear_y);
}

constexpr bool operator==(const Twist2d& a, const Twist2d& b) noexcept {
  return a.linear_x == b.linear_x && a.angular_z == b.angular_z && a.linear_y == b.linear_y;
}
constexpr bool operator!=(const Twist2d& a, const Twist2d& b) noexcept {
  return !(a == b);
}

/// On the same path, with the speed times `factor`; rest for 0, also of what is not finite.
constexpr Twist2d times(double factor, const Twist2d& twist) noexcept {
  if (factor == 0.0) return {};
  return {factor * twist.linear_x, factor * twist.angular_z, factor * twist.linear_y};
}

}  // namespace nord_driver::robot

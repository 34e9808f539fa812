// Motion of a wheeled base in its own plane (REP-103: x forward, yaw counter-clockwise).
#pragma once

#include <cmath>

namespace nord_driver::robot {

/// Velocity of the base in its own frame. A third field (sideways) comes with bases that can do it.
struct Twist2d {
  double linear_x = 0.0;   ///< m/s, positive forward
  double angular_z = 0.0;  ///< rad/s, positive counter-clockwise seen from above
};

inline bool isFinite(const Twist2d& twist) noexcept {
  return std::isfinite(twist.linear_x) && std::isfinite(twist.angular_z);
}

constexpr bool operator==(const Twist2d& a, const Twist2d& b) noexcept {
  return a.linear_x == b.linear_x && a.angular_z == b.angular_z;
}
constexpr bool operator!=(const Twist2d& a, const Twist2d& b) noexcept {
  return !(a == b);
}

}  // namespace nord_driver::robot

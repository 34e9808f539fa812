// Limits the axes of a base together, so that a limit changes how fast the path is driven and not which path.
#pragma once

#include <array>

#include "nord_driver/core/time.h"
#include "robot/speed_limiter.h"
#include "robot/twist.h"

namespace nord_driver::robot {

struct TwistLimits {
  SpeedLimits linear_x;
  SpeedLimits angular_z;
  SpeedLimits linear_y;                   ///< for bases that can go sideways
  bool limit_axes_independently = false;  ///< as diff_drive_controller does: each axis for itself, the path may bend
};

/// Follows a target twist step by step.
///
/// By default all axes are scaled by the same factor: a target beyond a velocity limit is scaled down as a whole, and
/// a change runs along the straight line from the present to the wanted twist, at the pace of the axis that needs
/// longer. So from standstill, to standstill and between speeds on one path the curvature does not change, and the base
/// stands as soon as it would with each axis braking for itself. Where the jerk limit and the curvature contradict each
/// other (a new path while still accelerating on the old one) the limits win.
///
/// Last of all stands a check that the result is finite; NaN and infinity never pass.
class TwistLimiter {
 public:
  /// Throws std::invalid_argument with a sentence naming the key, e.g. "linear/x/max_velocity ...".
  explicit TwistLimiter(const TwistLimits& limits);

  /// The twist after a step of `dt` towards `target`; a `dt` that is not positive changes nothing.
  /// A target with a value that is not finite brakes every axis to zero.
  Twist2d limit(const Twist2d& target, Duration dt) noexcept;
  /// As limit(), but on the straight line to the target in any case, all axes together: an acceleration that leads beside
  /// it, or past its end, is dropped at once, whatever the jerk limit. For whom a twist beside that line is not possible.
  Twist2d limitOnLine(const Twist2d& target, Duration dt) noexcept;
  /// The step of limit() where `isPossible(twist)` says so of it, and that of limitOnLine() otherwise.
  template <typename IsPossible>
  Twist2d limitWhere(const IsPossible& isPossible, const Twist2d& target, Duration dt) noexcept {
    const TwistLimiter before = *this;
    if (isPossible(limit(target, dt))) return twist();
    *this = before;
    return limitOnLine(target, dt);
  }
  /// Where limit() leads to: the target inside the velocity limits.
  Twist2d allowed(const Twist2d& target) const noexcept;
  /// For a stop: see SpeedLimiter.
  void endAcceleration() noexcept {
    for (SpeedLimiter& axis : axes_) axis.endAcceleration();
  }
  /// Continues from this twist: zero after a stop that the drives made by themselves.
  void reset(const Twist2d& twist = {}) noexcept;

  Twist2d twist() const noexcept { return {axes_[0].velocity(), axes_[1].velocity(), axes_[2].velocity()}; }

 private:
  using Values = std::array<double, 3>;  // in the order of Twist2d's fields

  static Values valuesOf(const Twist2d& twist) noexcept { return {twist.linear_x, twist.angular_z, twist.linear_y}; }
  static Twist2d twistOf(const Values& values) noexcept { return {values[0], values[1], values[2]}; }
  Values intoLimits(Values target) const noexcept;
  Values wayTo(const Values& target) const noexcept;
  RampLimits commonRamp(const Values& way) const noexcept;
  double accelerationAlong(const Values& way) const noexcept;
  void keepOnLine(const Values& target) noexcept;
  void followTogether(const Values& target, double dt) noexcept;

  std::array<SpeedLimiter, 3> axes_;
  bool independent_;
  bool ended_ = false;  // the last step was planned to end at its target
};

}  // namespace nord_driver::robot

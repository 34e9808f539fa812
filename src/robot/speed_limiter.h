// Limits the velocity, acceleration and jerk of one axis.
#pragma once

#include <string>

#include "nord_driver/core/time.h"
#include "robot/ramp.h"
#include "robot/speed_limits.h"

namespace nord_driver::robot {

/// Follows a target velocity step by step. Braking along the deceleration limit is following a target of zero.
///
/// The result never leaves the velocity limits (unless `reset` set it outside: then it comes back along the
/// acceleration limit), and never the acceleration limits. The jerk limit gives way in two places only: it never
/// carries the axis through standstill while the target is zero, and never past a velocity limit.
class SpeedLimiter {
 public:
  /// Throws std::invalid_argument with `problemOf(limits, axis)`.
  SpeedLimiter(const SpeedLimits& limits, const std::string& axis);

  /// The velocity after a step of `dt` towards `target`; a `dt` that is not positive changes nothing.
  /// A target that is not finite is a target of zero.
  double limit(double target, Duration dt) noexcept;
  /// Continues from this velocity at rest in acceleration; a value that is not finite counts as zero.
  void reset(double velocity = 0.0) noexcept;

  /// What it gains speed by ends at once, whatever the jerk limit: for a stop, which slows down from its first step on.
  void endAcceleration() noexcept {
    if (acceleration_ * velocity_ > 0.0) acceleration_ = 0.0;
  }

  double velocity() const noexcept { return velocity_; }

 private:
  friend class TwistLimiter;

  /// The target, cut at the velocity limits.
  double clampVelocity(double target) const noexcept;
  /// True when one step inside the limits ends at `target`, and the step after it can stay there.
  bool canEndAt(double target, double dt) const noexcept;
  /// True when the jerk limit lets the velocity change by this in one step.
  bool canStepBy(double change, double dt) const noexcept;
  /// Takes `velocity` as the next one, cut where a limit forbids it, and remembers the acceleration it takes.
  void step(double velocity, double target, double dt) noexcept;

  SpeedLimits limits_;
  RampLimits ramp_;
  double velocity_ = 0.0;
  double acceleration_ = 0.0;
};

}  // namespace nord_driver::robot

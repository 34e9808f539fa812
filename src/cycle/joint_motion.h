// From the newest command of a drive that belongs to no base to the velocity of its joint, along limits of its own.
#pragma once

#include "nord_driver/core/time.h"
#include "robot/speed_limits.h"
#include "robot/twist_limiter.h"

namespace nord_driver::cycle {

/// What the drive makes of a velocity, in this cycle.
struct JointBounds {
  double max_speed = 0.0;       ///< rad/s, 100 % of the setpoint at the joint
  double min_speed = 0.0;       ///< rad/s, P104 at the joint: below it the motor turns at it all the same; 0: none
  bool coming_to_rest = false;  ///< on its way to rest by OFF1, for P104: it would not follow yet
  bool stops = false;           ///< nobody asks for the target: it is 0, and approached from the first step on
  double rests_below = 0.0;     ///< rad/s: a target that is slower is taken for 0, and told as saturated
  double only_direction = 0.0;  ///< +1 or -1: a target in the other direction is taken for 0, and told; 0: it has both
};

/// A drive that is not driving forgets its velocity, so that the next start begins from standstill. The ramp is the
/// base's (TwistLimiter), with one axis.
class JointMotion {
 public:
  /// Throws std::invalid_argument: limits that cannot be.
  explicit JointMotion(const robot::SpeedLimits& limits);

  /// The velocity in rad/s for this cycle, `dt` after the last. `driving`: the drive follows setpoints now. `target`: as
  /// commanded, 0 where no command may be followed; it is gone to along the limits.
  double pollVelocity(double target, bool driving, const JointBounds& bounds, Duration dt) noexcept;
  /// The last target was beyond 100 % of the setpoint, too slow, in a direction that there is not, or in one that is
  /// limited to less than P104.
  bool isSaturated() const noexcept { return saturated_; }

 private:
  robot::TwistLimiter limiter_;
  bool saturated_ = false;
};

}  // namespace nord_driver::cycle

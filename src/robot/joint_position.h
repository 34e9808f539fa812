// The angle of a wheel joint, counted on without end.
#pragma once

#include "nord_driver/core/time.h"

namespace nord_driver::robot {

/// Integrates the joint's measured velocity (trapezoid rule, as Odometry does): the drive reports no position. The
/// angle is continuous, does not wrap and starts at zero.
class JointPosition {
 public:
  /// The joint turns with `velocity` (rad/s) now, `dt` after the last update. The first sample after construction or
  /// `rebase` moves nothing; a sample that is not finite is ignored, and so is its time.
  void update(double velocity, Duration dt) noexcept;
  /// Keeps the angle, forgets the velocity: call it when the drive comes back.
  void rebase() noexcept;

  double position() const noexcept { return position_; }  ///< rad
  double velocity() const noexcept { return velocity_; }  ///< rad/s, the last sample; 0 after `rebase`

 private:
  double position_ = 0.0;
  double velocity_ = 0.0;
  bool has_last_ = false;
};

}  // namespace nord_driver::robot

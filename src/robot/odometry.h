// Where the base is, from how it moved.
#pragma once

#include <cstddef>
#include <vector>

#include "nord_driver/core/time.h"
#include "robot/twist.h"

namespace nord_driver::robot {

/// Position and heading in the odometry frame.
struct Pose2d {
  double x = 0.0;        ///< m
  double y = 0.0;        ///< m
  double heading = 0.0;  ///< rad, in (-pi, pi]
};

/// Integrates velocities to a pose that never jumps.
///
/// The bus gives velocities (IW1), not wheel angles, so the way of a cycle is the mean of the velocities at its two
/// ends times its measured duration (trapezoid rule), and that way is laid out as the exact arc, sideways motion
/// included. Closed loop hands in the twist of the measured wheel speeds, open loop the limited command. What happens
/// while a drive is away cannot be seen: `rebase` before the first sample after a gap keeps the gap out of the pose.
class Odometry {
 public:
  static constexpr std::size_t kMaxWindow = 10000;

  /// `velocity_rolling_window_size`: samples the reported velocity is the mean of, 1 to kMaxWindow.
  /// Throws std::invalid_argument with a sentence naming it.
  explicit Odometry(std::size_t velocity_rolling_window_size);

  /// The base moves with `twist` now, `dt` after the last update. The first sample after construction, `reset` or
  /// `rebase` only sets the velocity to go on from. A sample that is not finite is ignored, and so is its time; a `dt`
  /// that is not positive moves nothing.
  void update(const Twist2d& twist, Duration dt) noexcept;
  /// Moves the pose along an arc: `forward` and `left` in m (signed, in the base's frame, which turns along), turning
  /// by `angle` in rad. Values that are not finite move nothing.
  void moveAlongArc(double forward, double angle, double left = 0.0) noexcept;

  /// Puts the base at `pose`, at rest.
  void reset(const Pose2d& pose = {}) noexcept;
  /// Keeps the pose, forgets the velocity: the next update starts anew.
  void rebase() noexcept;

  const Pose2d& pose() const noexcept { return pose_; }
  /// Mean velocity over the window, weighted by time; zero before the first step.
  Twist2d velocity() const noexcept;

 private:
  struct Step {
    double forward = 0.0;
    double angle = 0.0;
    double left = 0.0;
    double dt = 0.0;
  };

  Pose2d pose_;
  Twist2d last_;
  bool has_last_ = false;
  std::vector<Step> window_;  // ring, allocated once
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace nord_driver::robot

// From the newest velocity command to the speeds of the wheels, and from the wheels' speeds to the pose of the base.
#pragma once

#include <memory>

#include "cycle/base_config.h"
#include "cycle/commands.h"
#include "cycle/minimum_speeds.h"
#include "nord_driver/core/time.h"
#include "robot/base_kinematics.h"
#include "robot/odometry.h"
#include "robot/twist_limiter.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::cycle {

/// One base. Stale commands and commands that may not be followed are targets of zero; a base that is not driving
/// forgets its velocity, so that the next start begins from standstill.
class BaseMotion {
 public:
  /// Throws std::invalid_argument in words: a geometry, limit or number of wheels that cannot be.
  BaseMotion(const BaseConfig& config, Duration cmd_vel_timeout);

  /// The wheel speeds for this cycle. `driving`: the drives follow setpoints now; `follow`: the command may be followed
  /// (otherwise the base ramps to zero along the deceleration limit). `max_speeds`: what 100 % of the setpoint means at
  /// each wheel, in rad/s: a base that would exceed it, or a joint's own limit, is scaled as a whole.
  robot::WheelSpeeds pollWheels(const TwistCommand& command, bool driving, bool follow,
                                const robot::WheelSpeeds& max_speeds, Instant now, Duration dt,
                                const MinimumSpeeds& minimum = {}) noexcept;
  /// It rests although a velocity is commanded, for `MinimumSpeeds`.
  bool belowMinimum() const noexcept { return below_minimum_; }
  /// The command is beyond 100 % of the setpoint of a wheel: it is scaled down. Of a joint's own limit it does not tell.
  bool beyondFull() const noexcept { return beyond_full_; }
  /// The last wheel speeds were made from the command; false: the base rests, or comes to rest, without one.
  bool obeys() const noexcept { return obeys_ && !below_minimum_; }
  /// The velocity behind the last wheel speeds (what `cmd_vel_out` tells).
  const robot::Twist2d& limited() const noexcept { return limited_; }

  /// Other multipliers, from the next time on that the base is commanded to stand: while it drives they would be a step
  /// of the wheels' speeds beyond every limit. Multipliers that cannot be change nothing.
  void tune(const BaseTuning& tuning) noexcept;

  /// The wheels turn with these speeds now, `dt` after the last call.
  void handleWheels(const robot::WheelSpeeds& measured, Duration dt) noexcept;
  /// A drive is away: its way cannot be seen. The pose stays; the next sample starts anew.
  void handleGap() noexcept { odometry_.rebase(); }
  void resetOdometry() noexcept { odometry_.reset(); }

  const robot::Odometry& odometry() const noexcept { return odometry_; }

 private:
  /// Where the limiter leads to, inside the limits of the axes and of the wheels.
  robot::Twist2d targetOf(const robot::Twist2d& asked, const robot::WheelSpeeds& limits) const noexcept;
  robot::WheelSpeeds ramp(const robot::Twist2d& target, const robot::WheelSpeeds& limits, const MinimumSpeeds& minimum,
                          Duration dt) noexcept;
  robot::WheelSpeeds rest() noexcept;

  robot::BaseGeometry geometry_;
  std::unique_ptr<robot::BaseKinematics> kinematics_;
  robot::WheelSpeeds joint_limits_;
  robot::TwistLimiter limiter_;
  robot::Odometry odometry_;
  Duration timeout_;
  bool open_loop_;
  bool obeys_ = false;
  bool below_minimum_ = false;
  bool beyond_full_ = false;
  bool drives_ = false;  // the wheels were commanded to turn
  robot::Twist2d limited_;
};

}  // namespace nord_driver::cycle

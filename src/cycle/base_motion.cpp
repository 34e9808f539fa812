#include "nord_driver/cycle/base_motion.h"

namespace nord_driver::cycle {

BaseMotion::BaseMotion(const BaseConfig& config, Duration cmd_vel_timeout)
    : kinematics_(config.geometry),
      limiter_(config.limits),
      odometry_(config.velocity_rolling_window_size),
      timeout_(cmd_vel_timeout),
      open_loop_(config.open_loop) {}

robot::WheelSpeeds BaseMotion::pollWheels(const TwistCommand& command, bool driving, bool follow,
                                          const robot::WheelSpeeds& max_speeds, Instant now, Duration dt) noexcept {
  if (!driving) {
    limiter_.reset();
    limited_ = {};
    return {};
  }
  const bool obey = follow && !isStale(command, timeout_, now);
  limited_ = limiter_.limit(obey ? command.twist : robot::Twist2d{}, dt);
  // Beyond 100 % of P105 the whole base is scaled: a wheel cut alone would bend the path.
  const robot::WheelSpeeds wanted = kinematics_.wheels(limited_);
  const robot::WheelSpeeds possible = robot::scaleInto(wanted, max_speeds);
  if (!(possible == wanted)) limited_ = kinematics_.twist(possible);
  return possible;
}

void BaseMotion::handleWheels(const robot::WheelSpeeds& measured, Duration dt) noexcept {
  odometry_.update(open_loop_ ? limited_ : kinematics_.twist(measured), dt);
}

}  // namespace nord_driver::cycle

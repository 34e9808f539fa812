#include "cycle/base_motion.h"

namespace nord_driver::cycle {

BaseMotion::BaseMotion(const BaseConfig& config, Duration cmd_vel_timeout)
    : geometry_(config.geometry),
      kinematics_(robot::makeKinematics(config.kind, config.geometry, config.left.size(), config.right.size())),
      joint_limits_(wheelLimits(config)),
      limiter_(config.limits),
      odometry_(config.velocity_rolling_window_size),
      timeout_(cmd_vel_timeout),
      open_loop_(config.open_loop) {}

robot::WheelSpeeds BaseMotion::pollWheels(const TwistCommand& command, bool driving, bool follow,
                                          const robot::WheelSpeeds& max_speeds, Instant now, Duration dt,
                                          const MinimumSpeeds& minimum) noexcept {
  obeys_ = below_minimum_ = beyond_full_ = false;
  if (!driving) {
    limiter_.reset();
    return rest();
  }
  const robot::WheelSpeeds limits = robot::tighterOf(max_speeds, joint_limits_);
  obeys_ = follow && !minimum.coming_to_rest && !command.held && !isStale(command, timeout_, now);
  if (!obeys_) limiter_.endAcceleration();
  const robot::Twist2d asked = obeys_ ? command.twist : robot::Twist2d{};
  beyond_full_ = robot::areBeyond(kinematics_->wheels(asked), max_speeds);
  robot::Twist2d target = targetOf(asked, limits);
  // Taken as zero at once, it is left along the limits.
  below_minimum_ = anyBelow(kinematics_->wheels(target), minimum);
  if (below_minimum_) target = {};
  if (target == robot::Twist2d{} && !drives_) {  // what the limiter has come to alone is no motion that has to be ended
    limiter_.reset();
    return rest();
  }
  const robot::WheelSpeeds wheels = ramp(target, limits, minimum, dt);
  if (!anyBelow(wheels, minimum)) {
    drives_ = !robot::standsStill(wheels);
    return wheels;
  }
  // On the way up the limiter goes on alone until every wheel is fast enough; on the way down it has arrived.
  below_minimum_ = below_minimum_ || target != robot::Twist2d{};
  if (drives_) limiter_.reset();
  return rest();
}

// Beyond 100 % of P105, or a joint's limit, the whole base is scaled: a wheel cut alone would bend the path. The target is
// scaled first, so that the limiter never runs ahead of the wheels and braking begins at once. Where each axis is cut at
// a limit of its own, that bends the path, and a wheel may be beyond its limit again.
robot::Twist2d BaseMotion::targetOf(const robot::Twist2d& asked, const robot::WheelSpeeds& limits) const noexcept {
  const auto into = [&](const robot::Twist2d& twist) {
    return robot::times(robot::factorInto(kinematics_->wheels(twist), limits), twist);
  };
  return into(limiter_.allowed(into(kinematics_->possible(asked))));
}

robot::WheelSpeeds BaseMotion::rest() noexcept {
  limited_ = {};
  drives_ = false;
  return kinematics_->wheels(limited_);
}

// Independent axes and jerk limits lead off the straight line between two twists. Where only that line is possible for
// the wheels, it is kept: to rest at once would be a step of every wheel, and so would be what the limiter has come to
// meanwhile; and scaled in each step, beyond its limits, the base would lose in each what it has gained of acceleration.
robot::WheelSpeeds BaseMotion::ramp(const robot::Twist2d& target, const robot::WheelSpeeds& limits,
                                    const MinimumSpeeds& minimum, Duration dt) noexcept {
  const robot::WheelSpeeds before = kinematics_->wheels(limiter_.twist());
  const robot::WheelSpeeds end = kinematics_->wheels(target);
  const auto isPossible = [&](const robot::Twist2d& twist) {
    const robot::WheelSpeeds next = kinematics_->wheels(twist);
    return robot::areWithin(next, limits) && !anyBelow(next, minimum) && !anyTurnsAway(before, next, end, minimum);
  };
  limited_ = limiter_.limitWhere(isPossible, target, dt);
  const robot::WheelSpeeds wanted = kinematics_->wheels(limited_);
  const double factor = robot::factorInto(wanted, limits);
  if (!robot::areWithin(wanted, limits)) {  // the limits have become tighter
    limited_ = robot::times(factor, limited_);
    limiter_.reset(limited_);
  }
  return robot::times(factor, wanted);
}

void BaseMotion::tune(const BaseTuning& tuning) noexcept {
  const bool same = tuning.wheel_separation_multiplier == geometry_.wheel_separation_multiplier &&
                    tuning.left_wheel_radius_multiplier == geometry_.left_wheel_radius_multiplier &&
                    tuning.right_wheel_radius_multiplier == geometry_.right_wheel_radius_multiplier;
  if (!tuning.given || same || limited_ != robot::Twist2d{}) return;
  robot::BaseGeometry tuned = geometry_;
  tuned.wheel_separation_multiplier = tuning.wheel_separation_multiplier;
  tuned.left_wheel_radius_multiplier = tuning.left_wheel_radius_multiplier;
  tuned.right_wheel_radius_multiplier = tuning.right_wheel_radius_multiplier;
  if (kinematics_->setGeometry(tuned)) geometry_ = tuned;
}

void BaseMotion::handleWheels(const robot::WheelSpeeds& measured, Duration dt) noexcept {
  odometry_.update(open_loop_ ? limited_ : kinematics_->twist(measured), dt);
}

}  // namespace nord_driver::cycle

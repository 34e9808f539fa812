#include "nord_driver/robot/twist_limiter.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::robot {
namespace {

/// Cuts the bounds of the common ramp (twists per target distance) at those of one axis, which has `distance` to go.
void narrow(RampLimits& common, const RampLimits& axis, double distance) noexcept {
  if (distance == 0.0) return;
  const bool up = distance > 0.0;
  const double size = std::abs(distance);
  const auto low = [up, size](double min, double max) { return (up ? min : -max) / size; };
  const auto high = [up, size](double min, double max) { return (up ? max : -min) / size; };
  common.min_acceleration = std::max(common.min_acceleration, low(axis.min_acceleration, axis.max_acceleration));
  common.max_acceleration = std::min(common.max_acceleration, high(axis.min_acceleration, axis.max_acceleration));
  common.min_jerk = std::max(common.min_jerk, low(axis.min_jerk, axis.max_jerk));
  common.max_jerk = std::min(common.max_jerk, high(axis.min_jerk, axis.max_jerk));
}

}  // namespace

TwistLimiter::TwistLimiter(const TwistLimits& limits)
    : linear_(limits.linear_x, "linear/x"),
      angular_(limits.angular_z, "angular/z"),
      independent_(limits.limit_axes_independently) {}

Twist2d TwistLimiter::limit(const Twist2d& target, Duration dt) noexcept {
  const double time = toSeconds(dt);
  if (!(time > 0.0)) return twist();
  const Twist2d wanted = isFinite(target) ? target : Twist2d{};
  if (independent_) {
    linear_.limit(wanted.linear_x, dt);
    angular_.limit(wanted.angular_z, dt);
  } else {
    followTogether(wanted, time);
  }
  // Nothing after this line computes.
  if (!isFinite(twist())) reset();
  return twist();
}

void TwistLimiter::reset(const Twist2d& twist) noexcept {
  linear_.reset(twist.linear_x);
  angular_.reset(twist.angular_z);
}

void TwistLimiter::followTogether(Twist2d target, double dt) noexcept {
  const auto share = [](double wanted, double allowed) { return wanted == allowed ? 1.0 : allowed / wanted; };
  const double scale = std::min(share(target.linear_x, linear_.clampVelocity(target.linear_x)),
                                share(target.angular_z, angular_.clampVelocity(target.angular_z)));
  target = {target.linear_x * scale, target.angular_z * scale};

  // The last step goes exactly there: a rest of rounding would be the next step's way, in a direction of its own.
  if (linear_.canEndAt(target.linear_x, dt) && angular_.canEndAt(target.angular_z, dt)) {
    linear_.step(target.linear_x, target.linear_x, dt);
    angular_.step(target.angular_z, target.angular_z, dt);
    return;
  }

  // The way to the target counts from 0 to 1 on the straight line between the two twists.
  const double linear = target.linear_x - linear_.velocity_;
  const double angular = target.angular_z - angular_.velocity_;
  const double size = std::max(std::abs(linear), std::abs(angular));
  double progress = 0.0;
  if (size > 0.0) {
    RampLimits common;
    narrow(common, linear_.ramp_, linear);
    narrow(common, angular_.ramp_, angular);
    // The part of the present acceleration that points along the line; divided by `size` first, against overflow.
    const double x = linear / size;
    const double z = angular / size;
    const double acceleration = (linear_.acceleration_ * x + angular_.acceleration_ * z) / (x * x + z * z) / size;
    progress = nextAcceleration(1.0, acceleration, common, dt) * dt;
  }
  linear_.step(linear_.velocity_ + progress * linear, target.linear_x, dt);
  angular_.step(angular_.velocity_ + progress * angular, target.angular_z, dt);
}

}  // namespace nord_driver::robot

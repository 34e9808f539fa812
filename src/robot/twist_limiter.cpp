#include "robot/twist_limiter.h"

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

/// Of the longest of them.
double sizeOf(const std::array<double, 3>& way) noexcept {
  return std::max({std::abs(way[0]), std::abs(way[1]), std::abs(way[2])});
}

}  // namespace

TwistLimiter::TwistLimiter(const TwistLimits& limits)
    : axes_{SpeedLimiter{limits.linear_x, "linear/x"}, SpeedLimiter{limits.angular_z, "angular/z"},
            SpeedLimiter{limits.linear_y, "linear/y"}},
      independent_(limits.limit_axes_independently) {}

Twist2d TwistLimiter::limit(const Twist2d& target, Duration dt) noexcept {
  const double time = toSeconds(dt);
  if (!(time > 0.0)) return twist();
  const Values wanted = valuesOf(isFinite(target) ? target : Twist2d{});
  if (independent_) {
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].limit(wanted[i], dt);
  } else {
    followTogether(intoLimits(wanted), time);
  }
  // Nothing after this line computes.
  if (!isFinite(twist())) reset();
  return twist();
}

Twist2d TwistLimiter::limitOnLine(const Twist2d& target, Duration dt) noexcept {
  const double time = toSeconds(dt);
  if (!(time > 0.0)) return twist();
  const Values wanted = valuesOf(allowed(target));
  keepOnLine(wanted);
  followTogether(wanted, time);
  if (!isFinite(twist())) reset();
  return twist();
}

Twist2d TwistLimiter::allowed(const Twist2d& target) const noexcept {
  return isFinite(target) ? twistOf(intoLimits(valuesOf(target))) : Twist2d{};
}

void TwistLimiter::reset(const Twist2d& twist) noexcept {
  const Values values = valuesOf(twist);
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].reset(values[i]);
  ended_ = false;
}

TwistLimiter::Values TwistLimiter::intoLimits(Values target) const noexcept {
  if (independent_) {
    for (std::size_t i = 0; i < axes_.size(); ++i) target[i] = axes_[i].clampVelocity(target[i]);
    return target;
  }
  double scale = 1.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double allowed = axes_[i].clampVelocity(target[i]);
    if (allowed != target[i]) scale = std::min(scale, allowed / target[i]);
  }
  for (double& value : target) value *= scale;
  return target;
}

// The way to the target counts from 0 to 1 on the straight line between the two twists.
TwistLimiter::Values TwistLimiter::wayTo(const Values& target) const noexcept {
  Values way{};
  for (std::size_t i = 0; i < axes_.size(); ++i) way[i] = target[i] - axes_[i].velocity_;
  return way;
}

RampLimits TwistLimiter::commonRamp(const Values& way) const noexcept {
  RampLimits common;
  for (std::size_t i = 0; i < axes_.size(); ++i) narrow(common, axes_[i].ramp_, way[i]);
  return common;
}

// The part of the present acceleration that points along the line; divided by `size` first, against overflow. Only the axes
// with a jerk limit remember theirs: the others would count as if they stood, and hold these back.
double TwistLimiter::accelerationAlong(const Values& way) const noexcept {
  const double size = sizeOf(way);
  double along = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (!axes_[i].limits_.has_jerk_limits) continue;
    const double part = way[i] / size;
    along += axes_[i].acceleration_ * part;
    square += part * part;
  }
  return square > 0.0 ? along / square / size : 0.0;
}

// What is left of the acceleration is along the line, inside the limits there, and can be wound down before its end.
void TwistLimiter::keepOnLine(const Values& target) noexcept {
  const Values way = wayTo(target);
  double along = 0.0;
  if (sizeOf(way) > 0.0) {
    const RampLimits common = commonRamp(way);
    const double most = std::min(common.max_acceleration, std::sqrt(-2.0 * common.min_jerk));
    along = std::clamp(accelerationAlong(way), 0.0, most);
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].acceleration_ = axes_[i].limits_.has_jerk_limits ? along * way[i] : 0.0;
  }
}

void TwistLimiter::followTogether(const Values& target, double dt) noexcept {
  // There the acceleration has one step to end in, as planned, also when this step is shorter than the last.
  const auto at_target = [&](std::size_t i) { return axes_[i].velocity_ == target[i]; };
  if (ended_ && at_target(0) && at_target(1) && at_target(2)) {
    for (SpeedLimiter& axis : axes_) axis.acceleration_ = 0.0;
    return;
  }
  ended_ = false;

  // The last step goes exactly there: a rest of rounding would be the next step's way, in a direction of its own.
  bool one_step = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) one_step = one_step && axes_[i].canEndAt(target[i], dt);
  if (one_step) {
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].step(target[i], target[i], dt);
    ended_ = true;
    return;
  }

  const Values way = wayTo(target);
  double progress = 0.0;
  if (sizeOf(way) > 0.0) progress = nextAcceleration(1.0, accelerationAlong(way), commonRamp(way), dt) * dt;
  // An acceleration from before that points elsewhere can only be wound down; until it is, each axis goes its own
  // shortest way, so that no axis waits for another.
  bool possible = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) possible = possible && axes_[i].canStepBy(progress * way[i], dt);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    SpeedLimiter& axis = axes_[i];
    const double change =
        possible ? progress * way[i] : nextAcceleration(way[i], axis.acceleration_, axis.ramp_, dt) * dt;
    axis.step(axis.velocity_ + change, target[i], dt);
  }
}

}  // namespace nord_driver::robot

#include "robot/speed_limiter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nord_driver::robot {

SpeedLimiter::SpeedLimiter(const SpeedLimits& limits, const std::string& axis) : limits_(limits) {
  const std::string problem = problemOf(limits, axis);
  if (!problem.empty()) throw std::invalid_argument(problem);
  if (limits.has_acceleration_limits) {
    ramp_.min_acceleration = limits.minAcceleration();
    ramp_.max_acceleration = limits.max_acceleration;
  }
  if (limits.has_jerk_limits) {
    ramp_.min_jerk = limits.minJerk();
    ramp_.max_jerk = limits.max_jerk;
  }
}

double SpeedLimiter::limit(double target, Duration dt) noexcept {
  const double time = toSeconds(dt);
  if (!(time > 0.0)) return velocity_;
  const double wanted = std::isfinite(target) ? clampVelocity(target) : 0.0;
  const double acceleration = nextAcceleration(wanted - velocity_, acceleration_, ramp_, time);
  step(velocity_ + acceleration * time, wanted, time);
  return velocity_;
}

void SpeedLimiter::reset(double velocity) noexcept {
  velocity_ = std::isfinite(velocity) ? velocity : 0.0;
  acceleration_ = 0.0;
}

double SpeedLimiter::clampVelocity(double target) const noexcept {
  if (!limits_.has_velocity_limits) return target;
  return std::max(limits_.minVelocity(), std::min(limits_.max_velocity, target));
}

bool SpeedLimiter::canEndAt(double target, double dt) const noexcept {
  const double needed = (target - velocity_) / dt;
  const double down = -ramp_.min_jerk * dt;
  const double up = ramp_.max_jerk * dt;
  // Planned steps run along these bounds; rounding must not push them out.
  const double slack = std::isfinite(up) ? 1e-9 * (up + down) : 0.0;
  return needed >= ramp_.min_acceleration && needed <= ramp_.max_acceleration &&  //
         needed >= acceleration_ - down - slack && needed <= acceleration_ + up + slack && needed >= -up - slack &&
         needed <= down + slack;
}

bool SpeedLimiter::canStepBy(double change, double dt) const noexcept {
  const double needed = change / dt;
  const double down = -ramp_.min_jerk * dt;
  const double up = ramp_.max_jerk * dt;
  // Wide enough for the rounding of velocities over a short step; `step` cuts what is beyond.
  const double slack = std::isfinite(up) ? 1e-6 * (up + down) : 0.0;
  return needed >= acceleration_ - down - slack && needed <= acceleration_ + up + slack;
}

void SpeedLimiter::step(double velocity, double target, double dt) noexcept {
  // Jerk, acceleration, velocity: the later one wins.
  double next = std::max(velocity_ + (acceleration_ + ramp_.min_jerk * dt) * dt,
                         std::min(velocity_ + (acceleration_ + ramp_.max_jerk * dt) * dt, velocity));
  next = std::max(velocity_ + ramp_.min_acceleration * dt, std::min(velocity_ + ramp_.max_acceleration * dt, next));
  if (limits_.has_velocity_limits) {
    const double low = std::min(limits_.minVelocity(), velocity_);
    const double high = std::max(limits_.max_velocity, velocity_);
    next = std::max(low, std::min(high, next));
  }
  // A stop ends in standstill: the jerk limit must not carry a heavy base through zero and back.
  const bool passes_zero = velocity_ == 0.0 || std::signbit(velocity_) != std::signbit(next);
  if (target == 0.0 && passes_zero) next = 0.0;
  if (!std::isfinite(next)) next = 0.0;
  if (limits_.has_jerk_limits) acceleration_ = (next - velocity_) / dt;
  velocity_ = next;
}

}  // namespace nord_driver::robot

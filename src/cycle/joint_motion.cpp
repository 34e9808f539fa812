#include "cycle/joint_motion.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::cycle {

namespace {

// Of P104: a limit that is meant to be the same speed is no slower one.
constexpr double kRoundingOfLeast = 1e-9;

robot::TwistLimits oneAxis(const robot::SpeedLimits& limits) {
  robot::TwistLimits twist;
  twist.linear_x = limits;
  return twist;
}

}  // namespace

JointMotion::JointMotion(const robot::SpeedLimits& limits) : limiter_(oneAxis(limits)) {}

double JointMotion::pollVelocity(double target, bool driving, const JointBounds& bounds, Duration dt) noexcept {
  // Cut before the ramp, which must not run ahead of the joint: braking begins at once.
  double possible = std::max(-bounds.max_speed, std::min(bounds.max_speed, target));
  if (std::abs(possible) < bounds.rests_below || possible * bounds.only_direction < 0.0) possible = 0.0;
  // Limited to less than P104, in that direction, the motor would turn at P104 all the same: faster than it may.
  const double least = bounds.min_speed * (1.0 - kRoundingOfLeast);
  const double allowed = std::abs(limiter_.allowed({std::copysign(bounds.min_speed, possible)}).linear_x);
  if (allowed > 0.0 && allowed < least) possible = 0.0;
  saturated_ = driving && possible != target;
  if (!driving || bounds.coming_to_rest) {
    limiter_.reset();
    return 0.0;
  }
  if (bounds.stops) limiter_.endAcceleration();
  const double end = limiter_.allowed({possible}).linear_x;
  const double velocity = limiter_.limit({possible}, dt).linear_x;
  // On its way below P104 the motor would turn at P104: on the way up the ramp runs on alone until it is fast enough,
  // on the way down the joint has arrived. A target that is too slow itself goes out, and is told as saturated.
  if (velocity == end || std::abs(velocity) >= least) return velocity;
  if (end == 0.0) limiter_.reset();
  return 0.0;
}

}  // namespace nord_driver::cycle

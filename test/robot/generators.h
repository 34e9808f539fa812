// Random inputs for the property tests of this folder.
#pragma once

#include <rapidcheck.h>

#include <tuple>
#include <vector>

#include "robot/speed_limits.h"
#include "robot/twist.h"

namespace nord_driver::robot {

/// A number from a grid of 10000 steps, both ends included: values that shrink to readable ones.
inline rc::Gen<double> number(double low, double high) {
  constexpr int kSteps = 10000;
  return rc::gen::map(rc::gen::inRange(0, kSteps + 1),
                      [low, high](int i) { return low + (high - low) * static_cast<double>(i) / kSteps; });
}

inline rc::Gen<Twist2d> twistWithin(double linear, double angular) {
  return rc::gen::map(rc::gen::pair(number(-linear, linear), number(-angular, angular)), [](const auto& pair) {
    return Twist2d{pair.first, pair.second};
  });
}

/// Sideways too.
inline rc::Gen<Twist2d> twistWithin(double forward, double angular, double sideways) {
  return rc::gen::map(rc::gen::tuple(number(-forward, forward), number(-angular, angular), number(-sideways, sideways)),
                      [](const auto& values) {
                        return Twist2d{std::get<0>(values), std::get<1>(values), std::get<2>(values)};
                      });
}

/// Limits of all three kinds, with bounds that are not symmetrical.
inline SpeedLimits anyLimits(bool with_jerk) {
  SpeedLimits limits;
  limits.has_velocity_limits = true;
  limits.max_velocity = *number(0.1, 3.0);
  limits.min_velocity = -*number(0.1, 3.0);
  limits.has_acceleration_limits = true;
  limits.max_acceleration = *number(0.2, 5.0);
  limits.min_acceleration = -*number(0.2, 5.0);
  limits.has_jerk_limits = with_jerk;
  limits.max_jerk = *number(0.5, 20.0);
  limits.min_jerk = -*number(0.5, 20.0);
  return limits;
}

}  // namespace nord_driver::robot

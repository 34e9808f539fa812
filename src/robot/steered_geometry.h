// What has to be known of a base with steered wheels to turn its motion into wheel speeds and steering angles.
#pragma once

#include <cstddef>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::robot {

constexpr std::size_t kMaxSteeredAxles = 8;

/// A driven wheel whose steering axis stands upright through its contact point.
struct SteeredAxle {
  double x = 0.0;             ///< m, of the contact point in the base's frame, forward
  double y = 0.0;             ///< m, likewise, to the left
  double wheel_radius = 0.0;  ///< m, of the loaded wheel, corrected
  double min_angle = 0.0;     ///< rad, of the steering joint; at 0 the wheel rolls forward
  double max_angle = 0.0;     ///< rad, counter-clockwise seen from above
};

/// In the order in which wheels and angles are counted.
using SteeredAxles = FixedVector<SteeredAxle, kMaxSteeredAxles>;

/// Angles of the steering joints, rad, counter-clockwise seen from above, one for each axle.
using SteeringAngles = FixedVector<double, kMaxSteeredAxles>;

}  // namespace nord_driver::robot

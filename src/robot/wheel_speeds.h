// The speeds of the wheels of a base, and keeping them inside what drives and joints can turn.
#pragma once

#include <cstddef>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver::robot {

constexpr std::size_t kMaxWheels = 16;

/// Angular velocities at the wheel joints, rad/s, positive: the wheel rolls the base forward. The left wheels first,
/// front to rear, then the right ones likewise.
using WheelSpeeds = FixedVector<double, kMaxWheels>;

/// True when every wheel is to stand.
bool standsStill(const WheelSpeeds& wheels) noexcept;

/// Scales all wheels by one factor, so that none exceeds its limit and the path keeps its curvature: a wheel cut alone
/// would bend it. `max` holds a magnitude in rad/s for each wheel (share 100 % of P105 at the joint, or less; infinity:
/// no limit); a limit that is not positive or missing, or a speed that is not finite, gives zero on all wheels.
WheelSpeeds scaleInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept;

/// The factor by which scaleInto() does so: from 0 (nothing may move) to 1. A motion is scaled by it itself: found anew
/// from the scaled wheels it would have a rest of rounding on an axis that is zero.
double factorInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept;

/// Each wheel's speed times `factor`; rest for 0, also of what is not finite.
WheelSpeeds times(double factor, const WheelSpeeds& wheels) noexcept;

/// One of them cannot turn that fast, and it is not that nothing may move.
inline bool areBeyond(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept {
  const double factor = factorInto(wanted, max);
  return factor > 0.0 && factor < 1.0;
}

/// None of them is beyond its limit by more than rounding. Where nothing may move they are not, be they standing.
bool areWithin(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept;

/// The tighter of two limits, wheel by wheel; none (so that nothing moves) when they are not of one base.
WheelSpeeds tighterOf(const WheelSpeeds& a, const WheelSpeeds& b) noexcept;

}  // namespace nord_driver::robot

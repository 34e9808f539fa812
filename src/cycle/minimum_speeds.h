// What a minimum frequency (P104 > 0) of its wheels' drives asks of a base.
#pragma once

#include "robot/wheel_speeds.h"

namespace nord_driver::cycle {

/// What P104 > 0 of its drives asks of the base. Without a velocity such a wheel turns at P104 to the right all the
/// same, inverted or not, so it is brought to rest by OFF1; below P104 it turns faster than commanded. So the base
/// drives as a whole or rests as a whole: while any such wheel would be slower than its P104, all wheels are commanded
/// zero.
struct MinimumSpeeds {
  robot::WheelSpeeds wheels;           ///< rad/s of each wheel, 0: none; empty: of no wheel
  bool coming_to_rest = false;         ///< a wheel has not come to rest yet: it would not follow
  robot::WheelSpeeds directions = {};  ///< +1 or -1: the only direction in which a wheel turns; 0, or missing: both
};

/// A wheel with a P104 would be slower than it can turn, or is to turn in a direction that it does not have.
bool anyBelow(const robot::WheelSpeeds& wheels, const MinimumSpeeds& minimum) noexcept;

}  // namespace nord_driver::cycle

// What wheels that cannot turn at every speed ask of a base: a minimum frequency (P104 > 0), or one direction only.
#pragma once

#include "robot/wheel_speeds.h"

namespace nord_driver::cycle {

/// What P104 > 0 of its drives, and drives without a reverse, ask of the base. With P104 > 0 a wheel without a velocity
/// turns at P104 to the right all the same, inverted or not, so it is brought to rest by OFF1; below P104 it turns faster
/// than commanded. Told to turn in a direction that its drive does not have, a wheel stands, whatever its P104, and the
/// others alone would turn the base about it. So the base drives as a whole or rests as a whole: while any wheel would be
/// slower than its P104, or would have to turn that way, all wheels are commanded zero.
struct MinimumSpeeds {
  robot::WheelSpeeds wheels;           ///< rad/s of each wheel, 0: none; empty: of no wheel
  bool coming_to_rest = false;         ///< a wheel has not come to rest yet: it would not follow
  robot::WheelSpeeds directions = {};  ///< +1 or -1: the only direction in which a wheel turns; 0, or missing: both
};

/// A wheel would be slower than its P104, or is to turn in a direction that it does not have.
bool anyBelow(const robot::WheelSpeeds& wheels, const MinimumSpeeds& minimum) noexcept;

/// From `before` a wheel with a P104 would come to turn against the direction that it has at the target. It would have to
/// come back through standstill.
bool anyTurnsAway(const robot::WheelSpeeds& before, const robot::WheelSpeeds& next, const robot::WheelSpeeds& target,
                  const MinimumSpeeds& minimum) noexcept;

}  // namespace nord_driver::cycle

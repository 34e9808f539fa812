#include "cycle/minimum_speeds.h"

#include <cmath>

namespace nord_driver::cycle {

bool anyBelow(const robot::WheelSpeeds& wheels, const MinimumSpeeds& minimum) noexcept {
  if (robot::standsStill(wheels)) return false;
  for (std::size_t i = 0; i < wheels.size() && i < minimum.wheels.size(); ++i) {
    const bool has_minimum = minimum.wheels[i] > 0.0;
    const bool against = i < minimum.directions.size() && wheels[i] * minimum.directions[i] < 0.0;
    if (std::abs(wheels[i]) < minimum.wheels[i] || (has_minimum && against)) return true;
  }
  return false;
}

}  // namespace nord_driver::cycle

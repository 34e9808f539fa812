#include "cycle/minimum_speeds.h"

#include <cmath>

namespace nord_driver::cycle {

bool anyBelow(const robot::WheelSpeeds& wheels, const robot::WheelSpeeds& minimum) noexcept {
  if (robot::standsStill(wheels)) return false;
  for (std::size_t i = 0; i < wheels.size() && i < minimum.size(); ++i) {
    if (std::abs(wheels[i]) < minimum[i]) return true;
  }
  return false;
}

}  // namespace nord_driver::cycle

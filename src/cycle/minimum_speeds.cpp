#include "cycle/minimum_speeds.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::cycle {

namespace {

// Of the fastest wheel: what rounding leaves to a wheel that stands while the base turns about it. It is no step of a
// setpoint.
constexpr double kRoundingOfWheels = 1e-9;

double fastestOf(const robot::WheelSpeeds& wheels) noexcept {
  double fastest = 0.0;
  for (const double speed : wheels) fastest = std::max(fastest, std::abs(speed));
  return fastest;
}

}  // namespace

bool anyBelow(const robot::WheelSpeeds& wheels, const MinimumSpeeds& minimum) noexcept {
  if (robot::standsStill(wheels)) return false;
  const double rounding = kRoundingOfWheels * fastestOf(wheels);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (i < minimum.wheels.size() && std::abs(wheels[i]) < minimum.wheels[i]) return true;
    if (i < minimum.directions.size() && wheels[i] * minimum.directions[i] < -rounding) return true;
  }
  return false;
}

bool anyTurnsAway(const robot::WheelSpeeds& before, const robot::WheelSpeeds& next, const robot::WheelSpeeds& target,
                  const MinimumSpeeds& minimum) noexcept {
  for (std::size_t i = 0; i < minimum.wheels.size() && i < next.size(); ++i) {
    if (minimum.wheels[i] > 0.0 && before[i] * target[i] >= 0.0 && next[i] * target[i] < 0.0) return true;
  }
  return false;
}

}  // namespace nord_driver::cycle

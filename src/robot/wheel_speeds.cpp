#include "robot/wheel_speeds.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::robot {

bool standsStill(const WheelSpeeds& wheels) noexcept {
  return std::all_of(wheels.begin(), wheels.end(), [](double speed) { return speed == 0.0; });
}

double factorInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept {
  if (max.size() != wanted.size()) return 0.0;
  double factor = 1.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    // Written so that a NaN limit fails the comparison too.
    if (!(max[i] > 0.0) || !std::isfinite(wanted[i])) return 0.0;
    const double size = std::abs(wanted[i]);
    if (size > max[i]) factor = std::min(factor, max[i] / size);
  }
  return factor;
}

bool areWithin(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept {
  constexpr double kRounding = 1e-9;
  return factorInto(wanted, max) >= 1.0 - kRounding;
}

WheelSpeeds times(double factor, const WheelSpeeds& wheels) noexcept {
  WheelSpeeds scaled;
  scaled.resize(wheels.size());
  if (factor == 0.0) return scaled;
  for (std::size_t i = 0; i < wheels.size(); ++i) scaled[i] = wheels[i] * factor;
  return scaled;
}

WheelSpeeds scaleInto(const WheelSpeeds& wanted, const WheelSpeeds& max) noexcept {
  return times(factorInto(wanted, max), wanted);
}

WheelSpeeds tighterOf(const WheelSpeeds& a, const WheelSpeeds& b) noexcept {
  WheelSpeeds tighter;
  if (a.size() != b.size()) return tighter;
  // A NaN on either side stays, and moves nothing.
  for (std::size_t i = 0; i < a.size(); ++i) tighter.push_back(a[i] < b[i] || std::isnan(a[i]) ? a[i] : b[i]);
  return tighter;
}

}  // namespace nord_driver::robot

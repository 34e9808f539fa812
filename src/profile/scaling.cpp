#include "profile/scaling.h"

#include <algorithm>
#include <cmath>

namespace nord_driver::profile {

namespace {

constexpr double kTwoPi = 6.283185307179586476925;

double radiansPerPeriod(const JointScaling& scaling) noexcept {
  const double magnitude = kTwoPi / (scaling.pole_pairs * scaling.gear_ratio);
  return scaling.inverted ? -magnitude : magnitude;
}

}  // namespace

Hertz toHertz(RadPerSec joint, const JointScaling& scaling) noexcept {
  return {joint.value / radiansPerPeriod(scaling)};
}

RadPerSec toRadPerSec(Hertz frequency, const JointScaling& scaling) noexcept {
  return {frequency.value * radiansPerPeriod(scaling)};
}

Setpoint toSetpoint1(Hertz wanted, Hertz max_frequency) noexcept {
  Setpoint result;
  const double share = wanted.value / max_frequency.value;
  // The finite check comes last, after all arithmetic, right before the wire.
  if (!std::isfinite(wanted.value) || !(max_frequency.value > 0.0) || !std::isfinite(share)) {
    result.invalid = true;
    return result;
  }
  result.saturated = std::fabs(share) > 1.0;
  const double held = result.saturated ? std::copysign(1.0, share) : share;
  result.word = static_cast<std::int16_t>(std::lround(held * kHundredPercent));
  return result;
}

double atLeastOneRpm(double rpm) noexcept {
  return rpm == 0.0 ? 0.0 : std::copysign(std::max(1.0, std::fabs(rpm)), rpm);
}

Hertz fromActualValue1(std::int16_t word, Hertz max_frequency) noexcept {
  return {max_frequency.value * word / kHundredPercent};
}

}  // namespace nord_driver::profile

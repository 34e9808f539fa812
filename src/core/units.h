// Types that carry their unit, for the places where two plain doubles could be swapped.
#pragma once

namespace nord_driver {

constexpr double kPi = 3.14159265358979323846;

/// Angular velocity in rad/s, positive by the right-hand rule about the joint's axis.
struct RadPerSec {
  double value = 0.0;
};

/// Electrical frequency in Hz; the sign is the direction of rotation (positive: right-hand field).
struct Hertz {
  double value = 0.0;
};

constexpr bool operator==(RadPerSec a, RadPerSec b) noexcept {
  return a.value == b.value;
}
constexpr bool operator==(Hertz a, Hertz b) noexcept {
  return a.value == b.value;
}

}  // namespace nord_driver

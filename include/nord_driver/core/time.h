// Points in time and spans of time, as every layer below the ROS node uses them.
//
// Only the type of the steady clock is used here: the protocol engines are handed the time and never ask for it.
#pragma once

#include <chrono>

namespace nord_driver {

using Duration = std::chrono::nanoseconds;
using Instant = std::chrono::time_point<std::chrono::steady_clock, Duration>;

/// A span given in seconds (configuration, messages), rounded to the nanosecond.
constexpr Duration seconds(double value) noexcept {
  return Duration{static_cast<Duration::rep>(value * 1e9)};
}

/// A span in seconds, for messages and arithmetic in SI units.
constexpr double toSeconds(Duration span) noexcept {
  return static_cast<double>(span.count()) * 1e-9;
}

}  // namespace nord_driver

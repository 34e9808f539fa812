// The slave's watchdog time as two factors.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::profibus {

/// The longest watchdog a slave can be told: both factors 255, in units of 10 ms (EN 50170-8, Set_Prm).
constexpr Duration kLongestWatchdog = std::chrono::milliseconds{650'250};
/// What a slave's clock may be behind ours when its watchdog is waited for.
constexpr Duration kWatchdogTolerance = std::chrono::milliseconds{250};

/// Set_Prm carries the watchdog time as f1 * f2 * 10 ms, both factors 1 to 255 (EN 50170-8, Set_Prm).
struct WatchdogFactors {
  std::uint8_t f1 = 1;
  std::uint8_t f2 = 1;

  /// The factors with the smallest f2. Nothing when the time is outside 10 ms to 650.25 s, no multiple of 10 ms, or no
  /// such product (2.57 s is not: 257 is a prime number).
  static std::optional<WatchdogFactors> from(Duration time) noexcept;
  /// The shortest time that is not below `time` and can be written as factors; nothing above 650.25 s.
  static std::optional<Duration> representableFrom(Duration time) noexcept;
};

}  // namespace nord_driver::profibus

#include "profibus/watchdog_factors.h"

namespace nord_driver::profibus {

namespace {

constexpr Duration kBase = std::chrono::milliseconds{10};
constexpr Duration::rep kMaxFactor = 255;
static_assert(kMaxFactor * kMaxFactor * kBase == kLongestWatchdog);

}  // namespace

std::optional<WatchdogFactors> WatchdogFactors::from(Duration time) noexcept {
  if (time < kBase || time > kLongestWatchdog || time % kBase != Duration::zero()) return std::nullopt;
  const Duration::rep product = time / kBase;
  for (Duration::rep f2 = 1; f2 <= kMaxFactor; ++f2) {
    if (product % f2 != 0 || product / f2 > kMaxFactor) continue;
    return WatchdogFactors{static_cast<std::uint8_t>(product / f2), static_cast<std::uint8_t>(f2)};
  }
  return std::nullopt;
}

std::optional<Duration> WatchdogFactors::representableFrom(Duration time) noexcept {
  Duration candidate = time < kBase ? kBase : (time + kBase - Duration{1}) / kBase * kBase;
  for (; candidate <= kLongestWatchdog; candidate += kBase) {
    if (from(candidate)) return candidate;
  }
  return std::nullopt;
}

}  // namespace nord_driver::profibus

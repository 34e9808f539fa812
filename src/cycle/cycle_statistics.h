// Distribution of the bus cycle's length over the last second.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

struct CycleTimes {
  double min = 0.0;   ///< s
  double mean = 0.0;  ///< s
  double p99 = 0.0;   ///< s, 99th percentile
  double max = 0.0;   ///< s
};

/// Collects one sample per cycle and sums up once a second. Never allocates; beyond 2048 cycles a second the later ones
/// of that second still count for minimum, mean and maximum, but not for the percentile.
class CycleStatistics {
 public:
  /// Called at the start of every cycle.
  void handleCycleStart(Instant now) noexcept;
  /// The last whole second; all zero before the first has passed.
  const CycleTimes& times() const noexcept { return times_; }
  std::uint64_t cycles() const noexcept { return cycles_; }

 private:
  void sumUp() noexcept;

  static constexpr std::size_t kMaxSamples = 2048;
  std::array<float, kMaxSamples> samples_{};
  std::size_t sample_count_ = 0;
  std::uint64_t counted_ = 0;
  double sum_ = 0.0;
  double min_ = 0.0;
  double max_ = 0.0;
  std::uint64_t cycles_ = 0;
  Instant last_start_{};
  Instant second_start_{};
  CycleTimes times_;
};

}  // namespace nord_driver::cycle

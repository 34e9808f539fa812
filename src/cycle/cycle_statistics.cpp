#include "cycle/cycle_statistics.h"

#include <algorithm>

namespace nord_driver::cycle {

void CycleStatistics::handleCycleStart(Instant now) noexcept {
  if (cycles_++ == 0) {
    second_start_ = now;
    last_start_ = now;
    return;
  }
  const double length = toSeconds(now - last_start_);
  last_start_ = now;
  min_ = counted_ == 0 ? length : std::min(min_, length);
  max_ = counted_ == 0 ? length : std::max(max_, length);
  sum_ += length;
  ++counted_;
  if (sample_count_ < kMaxSamples) samples_[sample_count_++] = static_cast<float>(length);
  if (now - second_start_ >= std::chrono::seconds{1}) {
    sumUp();
    second_start_ = now;
  }
}

void CycleStatistics::sumUp() noexcept {
  // The smallest value that at least 99 % of the samples do not exceed.
  const std::size_t rank = (sample_count_ * 99 + 99) / 100 - 1;
  std::nth_element(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(rank),
                   samples_.begin() + static_cast<std::ptrdiff_t>(sample_count_));
  times_ = {min_, sum_ / static_cast<double>(counted_), static_cast<double>(samples_[rank]), max_};
  sample_count_ = 0;
  counted_ = 0;
  sum_ = 0.0;
}

}  // namespace nord_driver::cycle

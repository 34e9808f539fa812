// The process data of a drive in the cycles before its fault.
#pragma once

#include <array>
#include <cstddef>

#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/process_data.h"

namespace nord_driver::cycle {

/// What was exchanged with one drive in one cycle.
struct CycleData {
  Instant time{};
  bool answered = false;  ///< false: `input` is not of this cycle
  profile::ProcessOutput output;
  profile::ProcessInput input;
};

/// Cycles before the one in which the fault was seen.
constexpr std::size_t kCyclesBeforeFault = 32;

/// Those and that one, the oldest first.
using FaultRecord = FixedVector<CycleData, kCyclesBeforeFault + 1>;

/// Remembers the last cycles of one drive. Allocates nothing.
class FaultRecorder {
 public:
  void handleCycle(const CycleData& data) noexcept {
    ring_[next_] = data;
    next_ = (next_ + 1) % ring_.size();
    if (size_ < ring_.size()) ++size_;
  }
  /// The last cycle and up to 32 before it.
  void write(FaultRecord& to) const noexcept {
    to.clear();
    for (std::size_t i = 0; i < size_; ++i) to.push_back(ring_[(next_ + ring_.size() - size_ + i) % ring_.size()]);
  }

 private:
  std::array<CycleData, kCyclesBeforeFault + 1> ring_{};
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace nord_driver::cycle

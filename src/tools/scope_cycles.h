// Cycles that come one after the other, collected for a scope; where one is missing, it is counted.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tools/live_drive.h"

namespace nord_driver::tools {

class ScopeCycles {
 public:
  explicit ScopeCycles(double duration) : duration_(duration) {}

  /// What comes after the duration is left out.
  void take(const std::vector<LiveCycle>& cycles) {
    for (const LiveCycle& cycle : cycles) {
      if (done_) return;
      // A node that was started anew counts from the beginning.
      if (last_ && cycle.number < *last_) done_ = restarted_ = true;
      if (done_) return;
      if (last_ && cycle.number == *last_) continue;
      if (last_) missing_ += cycle.number - *last_ - 1;
      last_ = cycle.number;
      if (samples_.empty()) start_ = cycle.sample.time;
      samples_.push_back(cycle.sample);
      samples_.back().time -= start_;
      done_ = samples_.back().time >= duration_;
    }
  }

  /// The duration is full.
  bool done() const noexcept { return done_; }
  /// The node was started anew before that: what came until then is there.
  bool restarted() const noexcept { return restarted_; }
  /// Cycles between the first and the last that never came.
  std::uint64_t missing() const noexcept { return missing_; }
  /// Times from the first one on.
  const std::vector<ScopeSample>& samples() const noexcept { return samples_; }

 private:
  double duration_;  // s
  double start_ = 0.0;
  bool done_ = false;
  bool restarted_ = false;
  std::optional<std::uint64_t> last_;
  std::uint64_t missing_ = 0;
  std::vector<ScopeSample> samples_;
};

}  // namespace nord_driver::tools

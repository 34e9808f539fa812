// Keeps what one drive does, cycle by cycle, in memory that is taken before.
#pragma once

#include "cycle/cycle_observer.h"
#include "tools/scope_record.h"

namespace nord_driver::tools {

class ScopeObserver final : public cycle::CycleObserver {
 public:
  /// Of the first drive of the cycle; `cycles` at most.
  explicit ScopeObserver(std::size_t cycles) { samples_.reserve(cycles); }

  void handleCycle(const std::vector<profile::ProcessOutput>& outputs, const std::vector<DriveExchange>& inputs,
                   const cycle::CycleSnapshot& snapshot) noexcept override {
    if (samples_.size() == samples_.capacity()) return;
    if (samples_.empty()) start_ = snapshot.time;
    ScopeSample sample;
    sample.time = toSeconds(snapshot.time - start_);
    sample.answered = inputs.front().inverter_answers;
    sample.output = outputs.front();
    sample.input = inputs.front().input;
    samples_.push_back(sample);
  }

  /// Times from the first one on.
  const std::vector<ScopeSample>& samples() const noexcept { return samples_; }

 private:
  std::vector<ScopeSample> samples_;
  Instant start_{};
};

}  // namespace nord_driver::tools

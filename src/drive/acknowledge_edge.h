// The rising edge of the acknowledge bit: low, high, low again, each long enough to reach the inverter.
//
// The inverter acknowledges on the change from 0 to 1 only, and a bit left standing would hide every other edge, a
// digital input's too (BU 0020 7.3.3 bit 7).
#pragma once

#include <cstdint>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

class AcknowledgeEdge {
 public:
  /// `hold`: how long each level is sent at least; at least one telegram carries each, however slow the cycle.
  explicit AcknowledgeEdge(Duration hold) : hold_(hold) {}

  void start() noexcept {
    stage_ = Stage::kLow;
    begun_ = false;
  }
  /// The bit in the telegram sent now. High from one telegram to the first that is `hold` later.
  bool poll(Instant now) noexcept {
    if (!begun_) {
      begun_ = true;
      since_ = now;
    } else if (stage_ != Stage::kAfter && now - since_ >= hold_) {
      stage_ = stage_ == Stage::kLow ? Stage::kHigh : Stage::kAfter;
      since_ = now;
    }
    return stage_ == Stage::kHigh;
  }
  /// The edge was given, and as much time again has passed: nothing more will come of it.
  bool ended(Instant now) const noexcept { return stage_ == Stage::kAfter && now - since_ >= hold_; }

 private:
  enum class Stage : std::uint8_t { kLow, kHigh, kAfter };

  Duration hold_;
  Stage stage_ = Stage::kLow;
  bool begun_ = false;
  Instant since_{};
};

}  // namespace nord_driver::drive

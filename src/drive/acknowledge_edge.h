// The rising edge of the acknowledge bit: low, high, low again, each long enough to reach the inverter.
//
// A time alone does not tell that: where a telegram takes longer than it (a gateway polled every 150 ms) a level could come
// and go between two telegrams, and what came of the edge be read before it had arrived. So answers are counted as well: the
// first may belong to a telegram from before, the second was asked for after this level was handed on.
//
// The inverter acknowledges on the change from 0 to 1 only, and a bit left standing would hide every other edge, a
// digital input's too (BU 0020 7.3.3 bit 7).
#pragma once

#include <cstdint>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

class AcknowledgeEdge {
 public:
  static constexpr std::uint8_t kAnswers = 2;

  /// `hold`: how long each level is sent at least, and until `kAnswers` have come. A drive that does not answer ends the
  /// acknowledging as offline.
  explicit AcknowledgeEdge(Duration hold) : hold_(hold) {}

  void start() noexcept {
    stage_ = Stage::kLow;
    begun_ = false;
    answers_ = 0;
  }
  /// With every telegram the drive answered.
  void handleAnswer() noexcept {
    if (begun_ && answers_ < kAnswers) ++answers_;
  }
  /// The bit in the telegram sent now.
  bool poll(Instant now) noexcept {
    if (!begun_) {
      begun_ = true;
      since_ = now;
    } else if (stage_ != Stage::kAfter && isOver(now)) {
      stage_ = stage_ == Stage::kLow ? Stage::kHigh : Stage::kAfter;
      since_ = now;
      answers_ = 0;
    }
    return stage_ == Stage::kHigh;
  }
  /// The edge was given, and as much time and as many answers again have passed: nothing more will come of it.
  bool ended(Instant now) const noexcept { return stage_ == Stage::kAfter && isOver(now); }

 private:
  enum class Stage : std::uint8_t { kLow, kHigh, kAfter };

  bool isOver(Instant now) const noexcept { return now - since_ >= hold_ && answers_ >= kAnswers; }

  Duration hold_;
  Stage stage_ = Stage::kLow;
  bool begun_ = false;
  std::uint8_t answers_ = 0;  // in this stage
  Instant since_{};
};

}  // namespace nord_driver::drive

// Setting the count of a drive anew where its shaft stands: how long the bit that asks for it is high, and what counts as
// done.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

/// "Reset position" is bit 10 of the POSICON control bits (BU 0020 7.3.5, BU 0070 6.1). Which of its edges sets the count,
/// and to what, stands in BU 0510 and BU 0710, not at hand: the bit rises, stands, falls and stays low, each for `hold`
/// counted from an answer of the drive, and the run is over when the position is what it is to be.
class ResetRun {
 public:
  /// `timeout`: longer than that it does not take.
  void start(Instant now, Duration hold, Duration timeout) noexcept;
  void end() noexcept { stage_ = Stage::kNone; }
  bool isRunning() const noexcept { return stage_ != Stage::kNone; }
  /// What is high in the telegram sent now.
  bool bit() const noexcept { return stage_ == Stage::kHigh; }

  /// With every telegram the drive answered. `is_new`: its position is believed, and is what it is to be. True when the
  /// run has ended.
  bool handleAnswer(bool is_new, Instant now) noexcept;
  /// Before bit(): it takes longer than the time-out.
  bool isOverdue(Instant now) const noexcept { return isRunning() && now >= until_; }

 private:
  enum class Stage : std::uint8_t { kNone, kHigh, kLow };

  Stage stage_ = Stage::kNone;
  std::optional<Instant> since_;  // answered in this stage
  Duration hold_{};
  Instant until_{};
};

}  // namespace nord_driver::drive

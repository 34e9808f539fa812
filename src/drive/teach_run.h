// Teaching a drive its present position: the order and the length of the bits that ask for it.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

/// What is high in the telegram sent now (POSICON control bits 8 and 9: BU 0020 7.3.5, BU 0070 6.1).
struct TeachBits {
  bool teach_in = false;  ///< with it the bits that choose the element
  bool quit = false;      ///< its rising edge writes the position
};

/// The manuals of the buses name the bits, and not their order (BU 0510 and BU 0710 are not at hand): teach-in alone, quit
/// beside it, teach-in alone, none. So quit rises and falls while the element stands, whichever edge counts. Each stage
/// lasts `hold`, counted from an answer of the drive in it: a drive that is not heard is not taken for taught.
class TeachRun {
 public:
  /// `timeout`: longer than that it does not take.
  void start(Instant now, Duration hold, Duration timeout) noexcept;
  void end() noexcept { stage_ = Stage::kNone; }
  bool isRunning() const noexcept { return stage_ != Stage::kNone; }
  TeachBits bits() const noexcept;

  /// With every telegram the drive answered: true when it has ended.
  bool handleAnswer(Instant now) noexcept;
  /// Before bits(): it takes longer than the time-out.
  bool isOverdue(Instant now) const noexcept { return isRunning() && now >= until_; }

 private:
  enum class Stage : std::uint8_t { kNone, kTeachIn, kQuit, kTeachInAfter, kLow };

  Stage stage_ = Stage::kNone;
  std::optional<Instant> since_;  // answered in this stage
  Duration hold_{};
  Instant until_{};
};

}  // namespace nord_driver::drive

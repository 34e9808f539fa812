// The targets of a drive that positions, on their way from users: each is handed on once, and what becomes of it told.
#pragma once

#include <cstdint>
#include <optional>

#include "cycle/commands.h"
#include "drive/position_report.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

class PositionTargets {
 public:
  /// Refusals that go on are told once in this time.
  static constexpr Duration kTellInterval = std::chrono::seconds{1};

  /// The newest target, when it is another one than last time: rad or m.
  std::optional<double> poll(const PositionCommand& newest) noexcept;
  /// What the drive made of it. The sentence, when it is to be told.
  std::optional<Sentence> handleAnswer(const char* drive, double target, drive::TargetRefusal refusal,
                                       Instant now) noexcept;

  /// Of the newest target; empty: it was taken.
  const Sentence& refused() const noexcept { return refused_; }

 private:
  std::uint64_t taken_ = 0;
  Sentence refused_;
  drive::TargetRefusal told_ = drive::TargetRefusal::kNone;
  Instant told_at_{};
};

}  // namespace nord_driver::cycle

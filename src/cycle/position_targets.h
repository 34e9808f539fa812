// The targets of a drive that positions, on their way from users: each is handed on once, and what becomes of it told.
#pragma once

#include <cstdint>
#include <optional>

#include "cycle/commands.h"
#include "drive/position_report.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::cycle {

/// Where a user wants the axis.
struct AskedPosition {
  enum class Kind : std::uint8_t {
    kTarget,
    kIncrement,  ///< onward from the present target
    kElement,    ///< where an element of its array is
  };
  Kind kind = Kind::kTarget;
  double value = 0.0;        ///< rad or m; of an element what was read
  std::uint8_t element = 0;  ///< with kElement
  std::int32_t raw = 0;      ///< with kElement, as read: 0.001 revolutions
};

class PositionTargets {
 public:
  /// Refusals that go on are told once in this time.
  static constexpr Duration kTellInterval = std::chrono::seconds{1};

  /// What was not handed on yet, the target before the increments that came after it; to be called until there is none.
  std::optional<AskedPosition> poll(const PositionCommand& newest) noexcept;
  /// What the drive made of it. `at`: rad or m, the target an increment would have led
  /// to; no number: there was none. The sentence, when it is to be told.
  std::optional<Sentence> handleAnswer(const char* drive, const AskedPosition& asked, drive::TargetRefusal refusal,
                                       double at, Instant now) noexcept;

  /// A target that was not even put to the drive.
  std::optional<Sentence> refuse(const Sentence& why, Instant now) noexcept;

  /// Of the newest target; empty: it was taken.
  const Sentence& refused() const noexcept { return refused_; }

 private:
  std::optional<Sentence> tell(int reason, Instant now) noexcept;

  std::uint64_t taken_ = 0;
  std::uint64_t increases_taken_ = 0;
  double increments_taken_ = 0.0;  // of the sum after the target taken
  Sentence refused_;
  int told_ = 0;  // the reason told last
  Instant told_at_{};
};

}  // namespace nord_driver::cycle

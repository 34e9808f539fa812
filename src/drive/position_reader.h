// The position a drive tells in its actual values, as one count without jumps.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"
#include "profile/position_words.h"

namespace nord_driver::drive {

/// The words of one telegram belong together, but a gateway may put those of two moments into one: a low word that has
/// just passed its border and a high one that has not are 65 536 steps away. So a value that the motor's speed cannot
/// have led to is held back, and believed when those after it agree for kConfirm: only a new zero of the drive's count
/// (reference run, reset position) does that. 16 bits are continued past their border. Unheard for so long that the motor can
/// have led further than those halves are apart, it begins anew, as after a gap.
class PositionReader {
 public:
  static constexpr Duration kConfirm = std::chrono::milliseconds{100};

  /// With every fresh telegram. `max_speed`: steps/s, the most the motor can do.
  void handleValues(const profile::PositionField& field, const profile::ProcessValues& words, double max_speed,
                    Instant now) noexcept;
  /// The drive was not heard, or another function stands in its words: the next value is a first one, believed when those of
  /// the next 20 ms agree with it. One of 16 bits is still continued from the last.
  void handleGap() noexcept;
  /// At standstill the drive has set its count anew, perhaps to a value that looks like going on: that was no motion, and
  /// 16 bits are what their word is again.
  void handleNewZero(const profile::PositionField& field) noexcept;

  /// A value is believed, and was told since the last gap.
  bool isKnown() const noexcept { return known_; }
  /// Steps; the last one believed.
  std::int64_t steps() const noexcept { return steps_; }
  /// Steps/s, over kSpeedWindow.
  double speed() const noexcept { return speed_; }
  /// The newest value is held back.
  bool isHeldBack() const noexcept { return doubtful_.has_value(); }
  /// A value beyond what the speed allows has just been believed.
  bool hasJumped() const noexcept { return jumped_; }

 private:
  struct Value {
    std::int64_t steps = 0;
    Instant at{};
    Instant since{};  // of the doubt
  };

  void believe(std::int64_t steps, Instant now) noexcept;
  void doubt(std::int64_t steps, double max_speed, Instant now) noexcept;
  bool goesOnFromDoubtful(std::int64_t steps, double max_speed, Instant now) const noexcept;

  bool known_ = false;
  bool jumped_ = false;
  bool continued_ = false;  // steps_ is of this drive, though perhaps from before a gap
  std::int64_t steps_ = 0;
  Instant at_{};
  Instant seen_{};  // the last telegram
  double speed_ = 0.0;
  Value speed_from_;
  std::optional<Value> doubtful_;
};

}  // namespace nord_driver::drive

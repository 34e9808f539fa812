// The position a drive tells in its actual values, as one count without jumps.
#pragma once

#include <array>
#include <cstddef>
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
  static constexpr Duration kShortestWindow = std::chrono::milliseconds{40};
  static constexpr Duration kLongestWindow = std::chrono::milliseconds{500};

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
  /// Steps/s, over speedWindow(), told anew every kShortestWindow.
  double speed() const noexcept { return speed_; }
  /// 40 to 500 ms: long enough that one step in it, an encoder that flickers at rest, is no more than 1 % of the most
  /// the motor can do. Where that is less than 200 steps/s, it is more all the same.
  Duration speedWindow() const noexcept { return window_; }
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

  struct Sample {
    std::int64_t steps = 0;
    Instant at{};
  };
  // At least kShortestWindow apart, they go back kLongestWindow.
  static constexpr std::size_t kSamples = (kLongestWindow + kShortestWindow - Duration{1}) / kShortestWindow;

  void measureFrom(std::int64_t steps, Instant at) noexcept;
  void measure() noexcept;
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
  Duration window_ = kShortestWindow;
  std::array<Sample, kSamples> samples_{};  // the newest first
  std::optional<Value> doubtful_;
};

}  // namespace nord_driver::drive

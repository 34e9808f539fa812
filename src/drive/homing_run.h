// A reference run, from the bit that asks for it to its end: how long the bit is held, and what counts as done.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::drive {

/// What the drive shows in one cycle.
struct HomingView {
  bool reached = false;            ///< status bit 8
  bool still = false;              ///< it does not turn
  bool in_doubt = false;           ///< its newest position cannot be: the count may be getting its new zero
  std::optional<bool> referenced;  ///< a bit of the drive that says so; none: there is no such bit
};

/// How a reference run ends is in the manuals of POSICON (BU 0510, BU 0710), not at hand. Here: it has begun when the
/// drive turned, or its status bit 8 fell, and is over when bit 8 is high again and the shaft has stood still for
/// kQuiet, or for as long as its speed is told over, with the bit that says "referenced" high where there is one.
class HomingRun {
 public:
  static constexpr Duration kQuiet = std::chrono::milliseconds{200};

  /// `window`: what `still` is told over; a longer one than kQuiet takes its place.
  void start(Instant now, Duration timeout, Duration window = Duration{0}) noexcept;
  void end() noexcept { running_ = false; }
  /// The bit that asks for it is high.
  bool isRunning() const noexcept { return running_; }

  enum class Outcome : std::uint8_t { kGoesOn, kDone, kTimedOut };
  /// While it runs, with every telegram. kDone and kTimedOut end it.
  Outcome handleView(const HomingView& view, Instant now) noexcept;

 private:
  bool running_ = false;
  bool settled_ = false;  // it has been seen where it was held: what was before the run is over
  bool begun_ = false;
  std::optional<Instant> quiet_since_;
  Duration quiet_ = kQuiet;
  Instant until_{};
};

}  // namespace nord_driver::drive

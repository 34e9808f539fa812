// The pauses between attempts to connect: short at first, twice as long after each failure, short again after a success.
#pragma once

#include <algorithm>

#include "nord_driver/core/time.h"

namespace nord_driver::link {

/// Asks no clock: it is told the time.
class Backoff {
 public:
  Backoff(Duration first, Duration longest) noexcept : first_(first), longest_(longest), next_(first) {}

  /// When to try again after a failure at `now`.
  Instant failed(Instant now) noexcept {
    const Instant until = now + next_;
    next_ = std::min(2 * next_, longest_);
    fresh_ = false;
    return until;
  }
  void succeeded() noexcept {
    next_ = first_;
    fresh_ = true;
  }
  /// The last attempt was a success, or there was none.
  bool fresh() const noexcept { return fresh_; }

 private:
  Duration first_;
  Duration longest_;
  Duration next_;
  bool fresh_ = true;
};

}  // namespace nord_driver::link

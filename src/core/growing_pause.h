// The pause between attempts that fail: twice as long each time, up to a limit.
#pragma once

#include <algorithm>

#include "nord_driver/core/time.h"

namespace nord_driver {

class GrowingPause {
 public:
  /// The first pause is `first`, every further one at most `longest`.
  GrowingPause(Duration first, Duration longest) noexcept : first_(first), longest_(longest), next_(first) {}

  /// The pause before the next attempt.
  Duration next() noexcept {
    const Duration pause = next_;
    next_ = std::min(2 * pause, longest_);
    return pause;
  }
  /// An attempt succeeded.
  void reset() noexcept { next_ = first_; }

 private:
  Duration first_;
  Duration longest_;
  Duration next_;
};

}  // namespace nord_driver

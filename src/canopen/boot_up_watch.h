// Whether a node sends its boot-up again and again.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class BootUpWatch {
 public:
  /// True when this boot-up is one of more than three that came closely one after the other: no start any more.
  bool handleBootUp(Instant now) noexcept {
    const bool together = last_ && now - *last_ < kBelongTogether;
    in_a_row_ = together ? in_a_row_ + 1 : 1;
    last_ = now;
    return in_a_row_ > kMost;
  }

 private:
  static constexpr Duration kBelongTogether = std::chrono::seconds{2};
  static constexpr std::uint32_t kMost = 3;

  std::optional<Instant> last_;
  std::uint32_t in_a_row_ = 0;
};

}  // namespace nord_driver::canopen

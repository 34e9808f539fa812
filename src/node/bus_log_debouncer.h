// What of the bus's state is worth a line in the log. Every start passes through "no station answers", and a loose
// contact through ten sentences a second: a warning that comes without a reason is not read when there is one.
#pragma once

#include <optional>
#include <string>

#include "nord_driver/core/time.h"

namespace nord_driver::node {

class BusLogDebouncer {
 public:
  struct Line {
    bool good = false;
    std::string text;
  };

  /// The state at `now`: `good` when all drives answer. Trouble is told when it has lasted a second, then at most once
  /// a second in other words; its end, and the first good state, at once.
  std::optional<Line> poll(const std::string& text, bool good, Instant now);

 private:
  std::string told_;
  bool troubled_ = false;
  Instant due_{};  // while troubled
};

}  // namespace nord_driver::node

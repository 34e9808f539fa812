// Whose parameter result is handed on next: the drives take turns, so that none waits for another one's many.
#pragma once

#include <cstddef>
#include <optional>

#include "nord_driver/profile/parameter_request.h"

namespace nord_driver {

class ResultTurns {
 public:
  /// `Drives`: a vector of what has a pollResult().
  template <typename Drives>
  std::optional<profile::ParameterResult> poll(Drives& drives) noexcept {
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (auto result = drives[next_].pollResult()) return result;
      next_ = (next_ + 1) % drives.size();
    }
    return std::nullopt;
  }

 private:
  std::size_t next_ = 0;
};

}  // namespace nord_driver

// Which frames concern us, decided as the kernel's filters of a SocketCAN link decide it.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "core/can_frame.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// Data frames with exactly these 11 bit identifiers; without any identifier every frame.
class CanIdFilter {
 public:
  explicit CanIdFilter(const std::vector<std::uint32_t>& ids) noexcept : all_(ids.empty()) {
    for (const std::uint32_t id : ids) {
      if (id <= kHighestStandardId) wanted_[id] = true;
    }
  }

  bool passes(const CanFrame& frame) const noexcept {
    if (all_) return true;
    return !frame.extended && !frame.remote && frame.id <= kHighestStandardId && wanted_[frame.id];
  }

 private:
  bool all_;
  std::bitset<kHighestStandardId + 1> wanted_;
};

}  // namespace nord_driver::link

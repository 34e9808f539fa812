// Which frames concern us, decided as the kernel's filters of a SocketCAN link decide it.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "core/can_frame.h"
#include "link/can/can_settings.h"

namespace nord_driver::link {

/// Data frames with exactly the 11 bit identifiers `ids`, remote frames with exactly `remote_ids`; without any of `ids`
/// every frame.
class CanIdFilter {
 public:
  explicit CanIdFilter(const std::vector<std::uint32_t>& ids,
                       const std::vector<std::uint32_t>& remote_ids = {}) noexcept
      : all_(ids.empty()) {
    take(ids, wanted_);
    take(remote_ids, wanted_remote_);
  }

  bool passes(const CanFrame& frame) const noexcept {
    if (all_) return true;
    if (frame.extended || frame.id > kHighestStandardId) return false;
    return frame.remote ? wanted_remote_[frame.id] : wanted_[frame.id];
  }

 private:
  using Identifiers = std::bitset<kHighestStandardId + 1>;

  static void take(const std::vector<std::uint32_t>& ids, Identifiers& wanted) noexcept {
    for (const std::uint32_t id : ids) {
      if (id <= kHighestStandardId) wanted[id] = true;
    }
  }

  bool all_;
  Identifiers wanted_;
  Identifiers wanted_remote_;
};

}  // namespace nord_driver::link

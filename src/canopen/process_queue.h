// Which process data this cycle has still to send: at most each RPDO once, and SYNC. The values stay in their slots.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nord_driver::canopen {

/// An RPDO, or SYNC.
struct ProcessFrame {
  std::uint8_t node = 0;
  std::uint16_t pdo = 0;
  bool unheard = false;  // for a node that fell silent
  bool sync = false;

  bool operator==(const ProcessFrame& other) const noexcept {
    return node == other.node && pdo == other.pdo && sync == other.sync;
  }
};

constexpr ProcessFrame kSyncOfCycle{0, 0, false, true};

class ProcessQueue {
 public:
  /// `pdos`: most there can be in one cycle, beside SYNC.
  explicit ProcessQueue(std::size_t pdos) { due_.reserve(pdos + 1); }

  /// A new cycle: whatever was not sent is dropped.
  void clear() noexcept {
    due_.clear();
    next_ = 0;
  }
  /// At most as often as the constructor was told, between two `clear()`.
  void add(ProcessFrame frame) noexcept {
    if (due_.size() < due_.capacity()) due_.push_back(frame);
  }
  /// The order stays, but this one is the first, if it is there: for one that found no place in the cycle before.
  void beginWith(ProcessFrame frame) noexcept {
    const auto found = std::find(due_.begin(), due_.end(), frame);
    if (found != due_.end()) std::rotate(due_.begin(), found, due_.end());
  }

  bool empty() const noexcept { return next_ == due_.size(); }
  ProcessFrame take() noexcept { return due_[next_++]; }

 private:
  std::vector<ProcessFrame> due_;
  std::size_t next_ = 0;
};

}  // namespace nord_driver::canopen

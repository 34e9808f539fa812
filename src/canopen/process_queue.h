// Which process data this cycle has still to send: at most each RPDO once, then SYNC. The values stay in their slots.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nord_driver::canopen {

struct PdoReference {
  std::uint8_t node = 0;
  std::uint16_t pdo = 0;
  bool unheard = false;  // for a node that fell silent

  bool operator==(const PdoReference& other) const noexcept { return node == other.node && pdo == other.pdo; }
};

class ProcessQueue {
 public:
  /// `pdos`: most there can be in one cycle.
  explicit ProcessQueue(std::size_t pdos) { due_.reserve(pdos); }

  /// A new cycle: whatever was not sent is dropped.
  void clear() noexcept {
    due_.clear();
    next_ = 0;
    sync_ = false;
  }
  /// At most as often as the constructor was told, between two `clear()`.
  void add(PdoReference pdo) noexcept {
    if (due_.size() < due_.capacity()) due_.push_back(pdo);
  }
  void addSync() noexcept { sync_ = true; }
  /// The order stays, but this one is the first, if it is there: for one that found no place in the cycle before.
  void beginWith(PdoReference pdo) noexcept {
    const auto found = std::find(due_.begin(), due_.end(), pdo);
    if (found != due_.end()) std::rotate(due_.begin(), found, due_.end());
  }

  bool hasPdo() const noexcept { return next_ < due_.size(); }
  PdoReference takePdo() noexcept { return due_[next_++]; }
  bool takeSync() noexcept {
    const bool due = sync_;
    sync_ = false;
    return due;
  }
  bool syncDue() const noexcept { return sync_; }

 private:
  std::vector<PdoReference> due_;
  std::size_t next_ = 0;
  bool sync_ = false;
};

}  // namespace nord_driver::canopen

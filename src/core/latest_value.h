// Hands the newest value of one thread to another without a lock: the writer never waits, the reader never waits.
//
// A triple buffer: one slot is being written, one is being read, one lies between. One writer thread, one reader
// thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace nord_driver {

template <typename T>
class LatestValue {
 public:
  LatestValue() = default;
  explicit LatestValue(const T& initial) : slots_{initial, initial, initial} {}
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer thread only.
  void write(const T& value) {
    slots_[back_] = value;
    back_ = middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader thread only: the newest value written, or the initial one. The reference holds until the next `read()`.
  const T& read() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) != 0) {
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    }
    return slots_[front_];
  }

 private:
  static constexpr std::uint8_t kIndex = 0x03;
  static constexpr std::uint8_t kFresh = 0x04;

  std::array<T, 3> slots_{};
  std::uint8_t back_ = 0;                // writer's
  std::uint8_t front_ = 1;               // reader's
  std::atomic<std::uint8_t> middle_{2};  // slot between them, plus "newer than the reader's"
};

}  // namespace nord_driver

// A queue of fixed size from one thread to another; what does not fit is counted, never waited for.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace nord_driver {

/// One writer thread, one reader thread. Holds up to Capacity events; when full, the *newest* is dropped and counted.
template <typename T, std::size_t Capacity>
class EventRing {
 public:
  using Event = T;

  EventRing() = default;
  EventRing(const EventRing&) = delete;
  EventRing& operator=(const EventRing&) = delete;

  /// Writer thread only. False when the ring is full: the event is lost and counted.
  bool push(const T& event) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t next = (tail + 1) % kSlots;
    if (next == head_.load(std::memory_order_acquire)) {
      overflow_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[tail] = event;
    tail_.store(next, std::memory_order_release);
    return true;
  }

  /// Reader thread only.
  std::optional<T> pop() noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return std::nullopt;
    std::optional<T> event{slots_[head]};
    head_.store((head + 1) % kSlots, std::memory_order_release);
    return event;
  }

  /// Events lost since construction. Any thread.
  std::uint64_t overflow() const noexcept { return overflow_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kSlots = Capacity + 1;

  std::array<T, kSlots> slots_{};
  std::atomic<std::size_t> head_{0};
  std::atomic<std::size_t> tail_{0};
  std::atomic<std::uint64_t> overflow_{0};
};

}  // namespace nord_driver

// The last records of one thread, for another to copy while the first goes on: a trace.
//
// Every record carries its own sequence number (a seqlock per record). The writer never waits and never looks at its
// readers; a reader that meets a record in the middle of being overwritten sees it in the number and drops the record.
// Freezing the ring or handing over two buffers in turns would lose what happens while somebody copies, which is just
// after a fault.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>
#include <vector>

namespace nord_driver {

/// One writer thread, any number of reader threads. All memory is taken at construction.
template <typename T>
class HistoryRing {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  /// `capacity` is at least 1.
  explicit HistoryRing(std::size_t capacity) : slots_(capacity) {}
  HistoryRing(const HistoryRing&) = delete;
  HistoryRing& operator=(const HistoryRing&) = delete;

  /// Writer thread only.
  void push(const T& record) noexcept {
    const std::uint64_t number = pushed_.load(std::memory_order_relaxed);
    Slot& slot = slots_[number % slots_.size()];
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &record, sizeof(T));
    slot.sequence.store(whole(number) - 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    for (std::size_t i = 0; i < kWords; ++i) slot.words[i].store(words[i], std::memory_order_relaxed);
    slot.sequence.store(whole(number), std::memory_order_release);
    pushed_.store(number + 1, std::memory_order_release);
  }

  /// Records pushed since construction; they are numbered from 0. Any thread.
  std::uint64_t pushed() const noexcept { return pushed_.load(std::memory_order_acquire); }
  /// The number of the oldest record that may still be there. Any thread.
  std::uint64_t oldest() const noexcept {
    const std::uint64_t end = pushed();
    return end > slots_.size() ? end - slots_.size() : 0;
  }
  /// Nothing when the record has been overwritten, is being overwritten, or has not come yet. Any thread.
  std::optional<T> read(std::uint64_t number) const noexcept {
    const Slot& slot = slots_[number % slots_.size()];
    if (slot.sequence.load(std::memory_order_acquire) != whole(number)) return std::nullopt;
    std::array<std::uint64_t, kWords> words;
    for (std::size_t i = 0; i < kWords; ++i) words[i] = slot.words[i].load(std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (slot.sequence.load(std::memory_order_relaxed) != whole(number)) return std::nullopt;
    T record;
    std::memcpy(static_cast<void*>(&record), words.data(), sizeof(T));
    return record;
  }
  std::size_t capacity() const noexcept { return slots_.size(); }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;

  /// Sequence number of a slot that holds record `number` completely; one less while it is being written.
  static constexpr std::uint64_t whole(std::uint64_t number) noexcept { return 2 * number + 2; }

  struct Slot {
    std::atomic<std::uint64_t> sequence{0};
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };
  std::vector<Slot> slots_;
  std::atomic<std::uint64_t> pushed_{0};
};

}  // namespace nord_driver

// A vector with a fixed capacity that never allocates: telegrams, frames and lists of the cycle thread.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>

namespace nord_driver {

/// Elements are default-constructed up to the capacity; T must be cheap to construct and assign.
template <typename T, std::size_t Capacity>
class FixedVector {
 public:
  constexpr FixedVector() = default;
  constexpr FixedVector(std::initializer_list<T> values) noexcept {
    for (const T& value : values) push_back(value);
  }

  /// Appends; false (and nothing stored) when full.
  constexpr bool push_back(const T& value) noexcept {
    if (size_ == Capacity) return false;
    items_[size_++] = value;
    return true;
  }
  /// Grows with default values or shrinks; the size is cut at the capacity.
  constexpr void resize(std::size_t size) noexcept {
    if (size > Capacity) size = Capacity;
    for (std::size_t i = size_; i < size; ++i) items_[i] = T{};
    size_ = size;
  }
  /// Takes the first `count` elements away and moves the rest to the front.
  constexpr void eraseFront(std::size_t count) noexcept {
    if (count > size_) count = size_;
    for (std::size_t i = count; i < size_; ++i) items_[i - count] = items_[i];
    size_ -= count;
  }
  /// Takes the first element away and returns it; nothing when empty.
  constexpr std::optional<T> takeFront() noexcept {
    if (size_ == 0) return std::nullopt;
    const std::optional<T> first{items_[0]};
    eraseFront(1);
    return first;
  }
  constexpr void clear() noexcept { size_ = 0; }

  constexpr std::size_t size() const noexcept { return size_; }
  static constexpr std::size_t capacity() noexcept { return Capacity; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr bool full() const noexcept { return size_ == Capacity; }

  constexpr T& operator[](std::size_t i) noexcept {
    assert(i < size_);
    return items_[i];
  }
  constexpr const T& operator[](std::size_t i) const noexcept {
    assert(i < size_);
    return items_[i];
  }
  constexpr T* data() noexcept { return items_.data(); }
  constexpr const T* data() const noexcept { return items_.data(); }
  constexpr T* begin() noexcept { return items_.data(); }
  constexpr T* end() noexcept { return items_.data() + size_; }
  constexpr const T* begin() const noexcept { return items_.data(); }
  constexpr const T* end() const noexcept { return items_.data() + size_; }

  friend constexpr bool operator==(const FixedVector& a, const FixedVector& b) noexcept {
    if (a.size_ != b.size_) return false;
    for (std::size_t i = 0; i < a.size_; ++i) {
      if (!(a.items_[i] == b.items_[i])) return false;
    }
    return true;
  }
  friend constexpr bool operator!=(const FixedVector& a, const FixedVector& b) noexcept { return !(a == b); }

 private:
  std::array<T, Capacity> items_{};
  std::size_t size_ = 0;
};

template <std::size_t Capacity>
using FixedBytes = FixedVector<std::uint8_t, Capacity>;

}  // namespace nord_driver

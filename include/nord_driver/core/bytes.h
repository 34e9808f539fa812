// Views of bytes, and a reader and a writer whose verbs carry the byte order.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver {

/// A process-data word as the profile layer sees it: no byte order.
using Word = std::uint16_t;

/// The two's complement value of a word: C000h is -16384 (some manuals print -16385 or -16383).
constexpr std::int16_t toSigned(Word word) noexcept {
  return static_cast<std::int16_t>(word);
}
constexpr Word toWord(std::int16_t value) noexcept {
  return static_cast<Word>(value);
}

/// Read-only bytes owned by somebody else.
class ByteView {
 public:
  constexpr ByteView() = default;
  constexpr ByteView(const std::uint8_t* data, std::size_t size) noexcept : data_(data), size_(size) {}
  template <std::size_t N>
  constexpr ByteView(const FixedBytes<N>& bytes) noexcept : data_(bytes.data()), size_(bytes.size()) {}
  template <std::size_t N>
  constexpr ByteView(const std::array<std::uint8_t, N>& bytes) noexcept : data_(bytes.data()), size_(N) {}
  ByteView(const std::vector<std::uint8_t>& bytes) noexcept : data_(bytes.data()), size_(bytes.size()) {}

  constexpr const std::uint8_t* data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr const std::uint8_t* begin() const noexcept { return data_; }
  constexpr const std::uint8_t* end() const noexcept { return data_ + size_; }
  constexpr std::uint8_t operator[](std::size_t i) const noexcept {
    assert(i < size_);
    return data_[i];
  }
  /// `count` bytes from `offset`, cut at the end.
  constexpr ByteView sub(std::size_t offset, std::size_t count = static_cast<std::size_t>(-1)) const noexcept {
    if (offset > size_) offset = size_;
    const std::size_t rest = size_ - offset;
    return {data_ + offset, count < rest ? count : rest};
  }

  friend constexpr bool operator==(ByteView a, ByteView b) noexcept {
    if (a.size_ != b.size_) return false;
    for (std::size_t i = 0; i < a.size_; ++i) {
      if (a.data_[i] != b.data_[i]) return false;
    }
    return true;
  }
  friend constexpr bool operator!=(ByteView a, ByteView b) noexcept { return !(a == b); }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Takes numbers from the front of a view. Reading past the end gives 0 and is remembered: check `ok()` once, at the
/// end.
class ByteReader {
 public:
  constexpr explicit ByteReader(ByteView bytes) noexcept : bytes_(bytes) {}

  constexpr std::uint8_t u8() noexcept {
    if (position_ >= bytes_.size()) {
      ok_ = false;
      return 0;
    }
    return bytes_[position_++];
  }
  constexpr std::uint16_t u16be() noexcept {
    const unsigned high = u8();
    return static_cast<std::uint16_t>(high << 8 | u8());
  }
  constexpr std::uint16_t u16le() noexcept {
    const unsigned low = u8();
    return static_cast<std::uint16_t>(static_cast<unsigned>(u8()) << 8 | low);
  }
  constexpr std::uint32_t u32be() noexcept {
    const std::uint32_t high = u16be();
    return high << 16 | u16be();
  }
  constexpr std::uint32_t u32le() noexcept {
    const std::uint32_t low = u16le();
    return static_cast<std::uint32_t>(u16le()) << 16 | low;
  }
  /// The bytes not read yet.
  constexpr ByteView rest() const noexcept { return bytes_.sub(position_); }
  constexpr std::size_t remaining() const noexcept { return bytes_.size() - position_; }
  constexpr bool ok() const noexcept { return ok_; }

 private:
  ByteView bytes_;
  std::size_t position_ = 0;
  bool ok_ = true;
};

/// Appends numbers to a fixed buffer. A full buffer drops the byte and is remembered: check `ok()` once, at the end.
template <std::size_t N>
class ByteWriter {
 public:
  constexpr explicit ByteWriter(FixedBytes<N>& bytes) noexcept : bytes_(bytes) {}

  constexpr void u8(std::uint8_t value) noexcept { ok_ = bytes_.push_back(value) && ok_; }
  constexpr void u16be(std::uint16_t value) noexcept {
    u8(static_cast<std::uint8_t>(value >> 8));
    u8(static_cast<std::uint8_t>(value & 0xFFu));
  }
  constexpr void u16le(std::uint16_t value) noexcept {
    u8(static_cast<std::uint8_t>(value & 0xFFu));
    u8(static_cast<std::uint8_t>(value >> 8));
  }
  constexpr void u32be(std::uint32_t value) noexcept {
    u16be(static_cast<std::uint16_t>(value >> 16));
    u16be(static_cast<std::uint16_t>(value & 0xFFFFu));
  }
  constexpr void u32le(std::uint32_t value) noexcept {
    u16le(static_cast<std::uint16_t>(value & 0xFFFFu));
    u16le(static_cast<std::uint16_t>(value >> 16));
  }
  constexpr void append(ByteView bytes) noexcept {
    for (const std::uint8_t byte : bytes) u8(byte);
  }
  constexpr bool ok() const noexcept { return ok_; }

 private:
  FixedBytes<N>& bytes_;
  bool ok_ = true;
};

/// "68 05 05 68": upper-case pairs with a space between, as the manuals print telegrams.
std::string toHex(ByteView bytes);

/// Reads hexadecimal digits with any white space between bytes.
/// Throws std::invalid_argument when a character is no hexadecimal digit or a digit is left over.
std::vector<std::uint8_t> fromHex(const std::string& text);

/// "047E": four upper-case digits.
std::string toHexWord(Word word);

}  // namespace nord_driver

// One classic CAN frame, as links carry it and engines read and write it.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "nord_driver/core/bytes.h"

namespace nord_driver {

/// Most data bytes of a classic CAN frame (ISO 11898-1).
constexpr std::size_t kCanDataLength = 8;

struct CanFrame {
  std::uint32_t id = 0;   ///< 11 bits, or 29 with `extended`
  bool extended = false;  ///< CANopen never uses these; a foreign node may
  bool remote = false;    ///< RTR: no data, `size` is the length asked for
  std::uint8_t size = 0;  ///< 0..8
  std::array<std::uint8_t, kCanDataLength> data{};

  /// The data bytes; none in a remote frame. Lives as long as the frame.
  ByteView bytes() const noexcept {
    assert(size <= kCanDataLength);
    return {data.data(), remote ? std::size_t{0} : std::size_t{size}};
  }
};

inline bool operator==(const CanFrame& a, const CanFrame& b) noexcept {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote && a.size == b.size && a.bytes() == b.bytes();
}
inline bool operator!=(const CanFrame& a, const CanFrame& b) noexcept {
  return !(a == b);
}

/// A data frame with an 11 bit identifier; at most 8 bytes.
inline CanFrame dataFrame(std::uint32_t id, ByteView bytes) noexcept {
  assert(bytes.size() <= kCanDataLength);
  CanFrame frame;
  frame.id = id;
  frame.size = static_cast<std::uint8_t>(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) frame.data[i] = bytes[i];
  return frame;
}

/// A request for the data of `id` (node guarding uses it, CiA 301 7.2.8.3.2.1); `size`: bytes asked for.
inline CanFrame remoteFrame(std::uint32_t id, std::uint8_t size) noexcept {
  CanFrame frame;
  frame.id = id;
  frame.remote = true;
  frame.size = size;
  return frame;
}

}  // namespace nord_driver

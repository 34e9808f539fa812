// Process data of up to 33 bytes as frames: whole up to 8 bytes, else in fragments that nobody acknowledges.
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "sim/devicenet/dn_identifiers.h"

namespace nord_driver::sim {

constexpr std::size_t kDnMostProcessData = 33;  ///< BU 0280 4.2.1
using DnProcessBytes = FixedBytes<kDnMostProcessData>;

/// Puts the messages of one connection together.
class DnIoReceiver {
 public:
  /// `size`: what the connection consumes; beyond 8 bytes every message is fragmented. The message, once complete.
  std::optional<DnProcessBytes> receive(ByteView data, std::size_t size) noexcept;
  void reset() noexcept { collecting_ = false; }

 private:
  DnProcessBytes bytes_;
  bool collecting_ = false;
  std::uint8_t count_ = 0;
};

/// Frames of one message.
class DnIoSender {
 public:
  explicit DnIoSender(ByteView message) noexcept : message_(message), fragmented_(message.size() > 8) {}
  /// The next frame; nothing after the last one. An empty message is one empty frame.
  std::optional<FixedBytes<8>> next() noexcept;

 private:
  ByteView message_;
  bool fragmented_;
  bool done_ = false;
  std::size_t offset_ = 0;
  std::uint8_t count_ = 0;
};

}  // namespace nord_driver::sim

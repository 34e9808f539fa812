// Fragmented I/O: a connection of more than eight bytes sends every message as [fragment byte][up to seven bytes], and
// nobody acknowledges. A message with a gap is dropped as a whole.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/can_frame.h"
#include "devicenet/fragment.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::devicenet {

/// Most bytes of one I/O message each way; NORD's have up to 33 (BU 0280 4.2.2).
constexpr std::size_t kIoCapacity = 64;
/// A larger connection is fragmented, however short the single message.
constexpr std::size_t kUnfragmented = kCanDataLength;

using IoBytes = FixedBytes<kIoCapacity>;
using FramePayload = FixedBytes<kCanDataLength>;

/// How many frames a message of that many bytes takes on a connection of `connection_size`.
std::size_t ioFrames(std::size_t bytes, std::size_t connection_size) noexcept;

/// One message on its way out.
class IoSender {
 public:
  explicit IoSender(std::size_t connection_size) noexcept : fragmented_(connection_size > kUnfragmented) {}

  /// A new message, copied; the rest of the one before is dropped.
  void start(ByteView message) noexcept;
  void drop() noexcept { pending_ = false; }
  bool pending() const noexcept { return pending_; }
  /// A part of the message is out, and a part is not.
  bool hasBegun() const noexcept { return pending_ && sent_ > 0; }
  /// The data of its next frame.
  bool next(FramePayload& payload) noexcept;

 private:
  bool fragmented_;
  bool pending_ = false;
  IoBytes message_;
  std::size_t sent_ = 0;
  std::uint8_t count_ = 0;
};

/// One message on its way in.
class IoReceiver {
 public:
  enum class Result : std::uint8_t { kNeedMore, kComplete, kBroken };

  explicit IoReceiver(std::size_t connection_size) noexcept
      : size_(connection_size), fragmented_(connection_size > kUnfragmented) {}

  void reset() noexcept { assembling_ = false; }
  /// kComplete: `message()` is there until the next call. kBroken: the frame does not belong where it came, or the
  /// message is longer than the connection; what there was of it is dropped.
  Result handle(ByteView payload) noexcept;
  const IoBytes& message() const noexcept { return message_; }

 private:
  Result append(ByteView data) noexcept;

  std::size_t size_;
  bool fragmented_;
  bool assembling_ = false;
  std::uint8_t expected_ = 0;
  IoBytes message_;
};

}  // namespace nord_driver::devicenet

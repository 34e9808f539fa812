// Takes our own telegrams out of what an RS-485 adapter with an open receiver hears.
#pragma once

#include <cstddef>
#include <cstdint>

#include "link/serial/serial_settings.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::link {

/// The echo comes before anything else can: byte by byte it must be what was sent. A difference is a collision; what
/// was held back as a supposed echo is then handed on like the rest, so that nothing heard is ever lost here.
///
/// With EchoMode::kAuto the first telegrams decide. No answer equals its request (EN 50170: the addresses change
/// places), so one whole echo proves that there is one, and kStrangersToBeOff answers without it prove the contrary.
class EchoFilter {
 public:
  static constexpr std::size_t kLongestTelegram = 255;
  static constexpr std::size_t kLongestChunk = 256;
  static constexpr int kStrangersToBeOff = 3;

  explicit EchoFilter(EchoMode mode) noexcept { reset(mode); }

  /// The line was opened.
  void reset(EchoMode mode) noexcept;
  /// This telegram went out. One whose echo is still missing never came back: a collision, too.
  void sent(ByteView telegram) noexcept;
  /// At most kLongestChunk bytes were heard. What is no echo is to be taken by `take()` before the next call.
  void heard(ByteView bytes) noexcept;
  /// Bytes for the receiver; the count.
  std::size_t take(std::uint8_t* buffer, std::size_t capacity) noexcept;
  /// Throws away what was heard and is not taken.
  void discard() noexcept;

  bool hasBytes() const noexcept { return taken_ < ready_.size(); }
  /// An echo may still come: bytes have to pass through `heard()`.
  bool expects() const noexcept { return matched_ < expected_.size(); }
  /// kAuto as long as it is not decided.
  EchoMode mode() const noexcept { return mode_; }
  /// Since construction.
  std::uint64_t collisions() const noexcept { return collisions_; }

 private:
  void giveBack() noexcept;

  EchoMode mode_ = EchoMode::kAuto;
  FixedBytes<kLongestTelegram> expected_;
  std::size_t matched_ = 0;
  FixedBytes<kLongestTelegram + kLongestChunk> ready_;
  std::size_t taken_ = 0;
  int strangers_ = 0;
  std::uint64_t collisions_ = 0;
};

}  // namespace nord_driver::link

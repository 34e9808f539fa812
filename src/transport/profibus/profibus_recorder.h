// Cuts the bytes of a PROFIBUS line into the telegrams of a trace.
#pragma once

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/time.h"
#include "nord_driver/trace/telegram_trace.h"
#include "profibus/telegram.h"

namespace nord_driver {

/// Reads along beside the master, by the master's own parser: what that one discards is noise here.
class ProfibusRecorder {
 public:
  /// `trace` must outlive the recorder.
  explicit ProfibusRecorder(TelegramTrace& trace) noexcept : trace_(trace) {}

  /// What was received before and is no whole telegram will be none.
  void handleSent(ByteView telegram, Instant now) noexcept;
  void handleReceived(ByteView bytes, Instant now) noexcept;
  /// Nothing belongs to the bytes received so far any more: the line was closed.
  void flush() noexcept;

 private:
  void split(Instant now) noexcept;
  void addNoise(std::uint8_t byte) noexcept;
  void flushNoise() noexcept;

  TelegramTrace& trace_;
  profibus::Frame pending_;
  Instant pending_since_{};
  profibus::Frame noise_;
  Instant noise_since_{};
};

}  // namespace nord_driver

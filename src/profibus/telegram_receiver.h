// Finds telegrams in a stream of bytes that comes in chunks of any size and with noise between.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nord_driver/core/bytes.h"
#include "profibus/telegram.h"

namespace nord_driver::profibus {

struct ReceiverCounters {
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_in_telegrams = 0;
  std::uint64_t bytes_discarded = 0;
  std::uint64_t telegrams = 0;
  std::uint64_t checksum_errors = 0;  ///< what looked like a telegram to its end, but had a wrong FCS
};

/// Holds always: bytes received = bytes in telegrams + bytes discarded + bytes buffered.
/// After malformed bytes it drops the first of them and looks at the next: a telegram behind noise is never lost,
/// except when the noise itself is a telegram. Gaps between chunks mean nothing here (an adapter makes gaps that are
/// not on the wire); whoever owns the time calls `discard()` when the rest will not come.
class TelegramReceiver {
 public:
  /// Hands every complete telegram to `on_telegram(const Telegram&)`; its data are valid during that call only.
  template <typename OnTelegram>
  void receive(ByteView bytes, OnTelegram&& on_telegram) noexcept {
    counters_.bytes_received += bytes.size();
    while (!bytes.empty()) {
      bytes = bytes.sub(fill(bytes));
      std::size_t used = 0;
      for (ParseResult result = next(used); result.kind == Parse::kOk; result = next(used))
        on_telegram(result.telegram);
      buffer_.eraseFront(used);
    }
  }

  /// Gives up an incomplete telegram; its bytes are counted as discarded.
  void discard() noexcept;

  std::size_t buffered() const noexcept { return buffer_.size(); }
  const ReceiverCounters& counters() const noexcept { return counters_; }

 private:
  std::size_t fill(ByteView bytes) noexcept;
  ParseResult next(std::size_t& used) noexcept;

  Frame buffer_;
  ReceiverCounters counters_;
};

}  // namespace nord_driver::profibus

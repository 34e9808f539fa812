#include "profibus/telegram_receiver.h"

#include <algorithm>

namespace nord_driver::profibus {

void TelegramReceiver::discard() noexcept {
  counters_.bytes_discarded += buffer_.size();
  buffer_.clear();
}

// An incomplete telegram is at most 254 bytes long, so that there is always room for one more byte.
std::size_t TelegramReceiver::fill(ByteView bytes) noexcept {
  const std::size_t count = std::min(bytes.size(), Frame::capacity() - buffer_.size());
  for (std::size_t i = 0; i < count; ++i) buffer_.push_back(bytes[i]);
  return count;
}

ParseResult TelegramReceiver::next(std::size_t& used) noexcept {
  while (true) {
    const ParseResult result = parse(ByteView{buffer_}.sub(used));
    if (result.kind == Parse::kNeedMore) return result;
    if (result.kind == Parse::kOk) {
      used += result.eaten;
      counters_.bytes_in_telegrams += result.eaten;
      ++counters_.telegrams;
      return result;
    }
    if (result.defect == Defect::kChecksum) ++counters_.checksum_errors;
    ++counters_.bytes_discarded;
    ++used;
  }
}

}  // namespace nord_driver::profibus

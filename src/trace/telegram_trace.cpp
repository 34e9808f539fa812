#include "nord_driver/trace/telegram_trace.h"

#include <algorithm>
#include <utility>

namespace nord_driver {

TelegramTrace::TelegramTrace(std::uint32_t link_type, Describe describe, std::size_t capacity, Describe raw)
    : link_type_(link_type), describe_(std::move(describe)), raw_(std::move(raw)), ring_(capacity) {}

void TelegramTrace::record(TraceKind kind, ByteView bytes, Instant time) noexcept {
  while (!bytes.empty()) {
    TraceRecord record;
    const ByteView part = bytes.sub(0, record.bytes.size());
    record.time = time;
    record.kind = kind;
    record.length = static_cast<std::uint8_t>(part.size());
    std::copy(part.begin(), part.end(), record.bytes.begin());
    ring_.push(record);
    bytes = bytes.sub(part.size());
  }
}

std::vector<TraceRecord> TelegramTrace::copy() const {
  const std::uint64_t end = ring_.pushed();
  std::vector<TraceRecord> records;
  records.reserve(ring_.capacity());
  for (std::uint64_t number = ring_.oldest(); number < end; ++number) {
    if (const auto record = ring_.read(number)) records.push_back(*record);
  }
  return records;
}

}  // namespace nord_driver

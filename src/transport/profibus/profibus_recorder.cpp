#include "transport/profibus/profibus_recorder.h"

#include <algorithm>

namespace nord_driver {

void ProfibusRecorder::handleSent(ByteView telegram, Instant now) noexcept {
  flush();
  trace_.record(TraceKind::kSent, telegram, now);
}

void ProfibusRecorder::handleReceived(ByteView bytes, Instant now) noexcept {
  while (!bytes.empty()) {
    if (pending_.empty()) pending_since_ = now;
    const std::size_t count = std::min(bytes.size(), profibus::Frame::capacity() - pending_.size());
    for (const std::uint8_t byte : bytes.sub(0, count)) pending_.push_back(byte);
    bytes = bytes.sub(count);
    split(now);
  }
}

void ProfibusRecorder::flush() noexcept {
  for (const std::uint8_t byte : pending_) addNoise(byte);
  pending_.clear();
  flushNoise();
}

// The longest telegram is shorter than the buffer: afterwards there is always room for one more byte.
void ProfibusRecorder::split(Instant now) noexcept {
  std::size_t used = 0;
  for (;;) {
    const ByteView rest = ByteView{pending_}.sub(used);
    const profibus::ParseResult result = profibus::parse(rest);
    if (result.kind == profibus::Parse::kNeedMore) break;
    if (result.kind == profibus::Parse::kMalformed) {
      addNoise(rest[0]);
      ++used;
      continue;
    }
    flushNoise();
    trace_.record(TraceKind::kReceived, rest.sub(0, result.eaten), now);
    used += result.eaten;
    pending_since_ = now;
  }
  pending_.eraseFront(used);
}

void ProfibusRecorder::addNoise(std::uint8_t byte) noexcept {
  if (noise_.full()) flushNoise();
  if (noise_.empty()) noise_since_ = pending_since_;
  noise_.push_back(byte);
}

void ProfibusRecorder::flushNoise() noexcept {
  trace_.record(TraceKind::kNoise, noise_, noise_since_);
  noise_.clear();
}

}  // namespace nord_driver

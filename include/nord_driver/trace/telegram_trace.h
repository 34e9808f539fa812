// The last telegrams of a bus, of any kind: filled by the thread of the bus, copied by another one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/history_ring.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

enum class TraceKind : std::uint8_t {
  kSent,
  kReceived,
  kNoise,  ///< received, but no telegram: broken, foreign or cut off
};

/// One telegram as the trace's link type defines a packet (PROFIBUS: start to end delimiter).
struct TraceRecord {
  Instant time{};  ///< sent: at its first byte; received: when its last byte was read
  TraceKind kind = TraceKind::kSent;
  std::uint8_t length = 0;
  std::array<std::uint8_t, 255> bytes{};

  ByteView view() const noexcept { return {bytes.data(), length}; }
};

/// Link types of the pcap format (www.tcpdump.org/linktypes.html).
constexpr std::uint32_t kLinkTypeProfibusDl = 257;
constexpr std::uint32_t kLinkTypeCanSocketCan = 227;

/// Never waits for its readers and takes no memory after construction. What a copy cannot have whole it does not have:
/// records overwritten during `copy()` are missing at its old end.
class TelegramTrace {
 public:
  /// A telegram in a few words for people; called by whoever writes the trace, in any thread.
  using Describe = std::function<std::string(const TraceRecord&)>;

  static constexpr std::size_t kCapacity = 10'000;

  /// `raw`: its bytes as people write them on this bus; without it they are written in hexadecimal.
  TelegramTrace(std::uint32_t link_type, Describe describe, std::size_t capacity = kCapacity, Describe raw = {});

  /// The bus's thread only. Longer than 255 bytes: several records.
  void record(TraceKind kind, ByteView bytes, Instant time) noexcept;

  /// Oldest first. Any thread.
  std::vector<TraceRecord> copy() const;
  /// Since construction. Any thread.
  std::uint64_t recorded() const noexcept { return ring_.pushed(); }

  std::uint32_t linkType() const noexcept { return link_type_; }
  std::string describe(const TraceRecord& record) const { return describe_ ? describe_(record) : std::string{}; }
  std::string raw(const TraceRecord& record) const { return raw_ ? raw_(record) : toHex(record.view()); }

 private:
  std::uint32_t link_type_;
  Describe describe_;
  Describe raw_;
  HistoryRing<TraceRecord> ring_;
};

}  // namespace nord_driver

// Writes traces into a directory: a text and, for the telegrams, a pcap file; and removes the oldest.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "nord_driver/trace/telegram_trace.h"
#include "trace/process_data_history.h"
#include "trace/trace_config.h"
#include "trace/trace_text.h"

namespace nord_driver::trace {

/// What a trace is written for.
struct TraceCause {
  std::string tag;                   ///< part of the file's name: "fault_left"
  std::vector<std::string> reasons;  ///< sentences
  Instant time{};
  std::uint64_t cycle = 0;  ///< the last whose process data are shown
};

struct TraceResult {
  bool written = false;
  std::string message;  ///< the path of the text, or why there is none
  std::string warning;  ///< an old trace that could not be removed; empty otherwise
};

/// Any thread but the bus's; several may write, one after the other.
class TraceWriter {
 public:
  /// `telegrams` (nullptr: none) and `history` must outlive the writer.
  TraceWriter(TraceConfig config, std::vector<TracedDrive> drives, const TelegramTrace* telegrams,
              const ProcessDataHistory& history);

  /// Why nothing could be written now: the directory is missing or read-only. Empty: nothing stands against it.
  std::string whyNotWritable() const;
  /// "<directory>/nord_driver_20261121T170503.123Z_fault_left.txt" and ".pcap", or neither.
  TraceResult write(const TraceCause& cause, const TraceClock& clock);
  /// On a user's request: now, with the last cycles there are.
  TraceResult writeNow(const TraceClock& clock);

  const std::vector<TracedDrive>& drives() const noexcept { return drives_; }

 private:
  std::string freeStem(const TraceCause& cause, const TraceClock& clock) const;
  std::string pcapBytes(const std::vector<TraceRecord>& telegrams, const TraceClock& clock) const;
  /// Never `newest`, whatever the clock made of its name.
  std::string removeOldest(const std::string& newest, std::chrono::microseconds now) const;

  TraceConfig config_;
  std::vector<TracedDrive> drives_;
  const TelegramTrace* telegrams_;
  const ProcessDataHistory& history_;
  std::mutex mutex_;
};

}  // namespace nord_driver::trace

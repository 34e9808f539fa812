// A trace as a page to read: why, when, the process data before it, then every telegram in a line.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"
#include "nord_driver/trace/telegram_trace.h"
#include "trace/process_data_history.h"

namespace nord_driver::trace {

/// The same moment on the clock of the bus and on the wall.
struct TraceClock {
  Instant bus{};
  std::chrono::system_clock::time_point wall{};

  /// Since 1970-01-01 UTC.
  std::chrono::microseconds wallTime(Instant when) const noexcept;
};

struct TracedDrive {
  std::string name;
  std::string address;  ///< "PROFIBUS station 3"
};

struct TracePage {
  std::vector<std::string> reasons;  ///< sentences
  Instant time{};                    ///< the moment that is time 0 on the page
  std::vector<ProcessDataRecord> process_data;
  std::vector<TraceRecord> telegrams;
};

/// "2026-11-21 17:05:03.123456"
std::string utcText(std::chrono::microseconds since_1970);

/// `trace` gives the words for the telegrams; nullptr: the bus keeps none, and the page says so.
std::string traceText(const TracePage& page, const std::vector<TracedDrive>& drives, const TelegramTrace* trace,
                      const TraceClock& clock);

}  // namespace nord_driver::trace

// Decides when a fault becomes a trace: a moment later, so that its consequences are in it, and once per incident.
#pragma once

#include <optional>

#include "trace/trace_feed.h"
#include "trace/trace_writer.h"

namespace nord_driver::trace {

/// A fault often brings others (the base stops, the next drive trips): what follows the first within 0.2 s stands in
/// the same trace. One thread.
class FaultTracer {
 public:
  static constexpr Duration kAfterFault = std::chrono::milliseconds{200};

  /// Both must outlive the tracer.
  FaultTracer(TraceFeed& feed, TraceWriter& writer) : feed_(feed), writer_(writer) {}

  /// To be called more often than every 0.1 s. The result when a trace was due.
  std::optional<TraceResult> poll(const TraceClock& clock);
  /// The bus has ended: writes what waits.
  std::optional<TraceResult> finish(const TraceClock& clock);

 private:
  void take();
  std::optional<TraceResult> write(const TraceClock& clock);

  TraceFeed& feed_;
  TraceWriter& writer_;
  std::optional<TraceCause> waiting_;
};

}  // namespace nord_driver::trace

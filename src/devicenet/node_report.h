// One device's voice: its status, and what is told and counted of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "devicenet/counters.h"
#include "devicenet/devicenet_event.h"
#include "devicenet/node_status.h"

namespace nord_driver::devicenet {

class NodeReport {
 public:
  /// The references live longer than this.
  NodeReport(std::size_t node, Counters& counters, DevicenetEvents& events) noexcept
      : node_(node), counters_(counters), events_(events) {}

  NodeStatus& status() noexcept { return status_; }
  const NodeStatus& status() const noexcept { return status_; }
  Counters& busCounters() noexcept { return counters_; }

  /// Sets state and reason; an empty one clears it.
  void enter(NodeState state, const Sentence& reason, Instant now) noexcept;
  void tell(DevicenetEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept;
  /// Counts every frame, tells of one per second.
  void malformed(const CanFrame& frame, const char* what, Instant now) noexcept;

 private:
  std::size_t node_;
  Counters& counters_;
  DevicenetEvents& events_;
  NodeStatus status_;
  std::optional<Instant> told_malformed_;
};

}  // namespace nord_driver::devicenet

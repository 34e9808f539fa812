// Others on the bus: nodes that are not configured, a second master, somebody with our own node id. Counted always,
// told once per node or once per second.
#pragma once

#include <bitset>
#include <cstdint>

#include "canopen/canopen_event.h"
#include "canopen/cob_id_table.h"
#include "canopen/counters.h"
#include "canopen/nmt.h"
#include "core/can_frame.h"
#include "core/timer_table.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class BusWatch {
 public:
  /// The references live longer than this.
  BusWatch(Counters& counters, CanopenEvents& events) noexcept : counters_(counters), events_(events) {}

  /// Everything is told again.
  void restart() noexcept;
  /// `id`: of a node that is not configured.
  void foreignNode(std::uint8_t id, Instant now) noexcept;
  void secondMaster(const CanFrame& frame, CobIdUse::Kind kind, Instant now) noexcept;
  void ownIdUsed(const CanFrame& frame, Instant now) noexcept;
  /// An NMT frame that is none.
  void malformedNmt(const CanFrame& frame, Instant now) noexcept;

 private:
  enum class Finding : std::uint8_t { kSecondMaster, kOwnIdUsed, kMalformedNmt, kCount };

  void tell(CanopenEventKind kind, const Sentence& text, std::uint32_t value, Instant now) noexcept;
  bool mayTell(Finding finding, Instant now) noexcept;

  Counters& counters_;
  CanopenEvents& events_;
  std::bitset<kMaxNodeId + 1> told_nodes_;
  TimerTable<Finding> pauses_;  // until then the same finding is not told again
};

}  // namespace nord_driver::canopen

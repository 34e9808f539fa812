// Others on the bus: nodes that are not configured, a second master, somebody with our own node id. Counted always,
// told once per node or once per second.
#pragma once

#include <cstdint>

#include "canopen/canopen_event.h"
#include "canopen/cob_id_table.h"
#include "canopen/counters.h"
#include "canopen/nmt.h"
#include "core/bus_findings.h"
#include "core/can_frame.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

class BusWatch {
 public:
  /// The references live longer than this.
  BusWatch(Counters& counters, CanopenEvents& events) noexcept : counters_(counters), findings_(events) {}

  /// Everything is told again.
  void restart() noexcept { findings_.restart(); }
  /// `id`: of a node that is not configured.
  void foreignNode(std::uint8_t id, Instant now) noexcept;
  void secondMaster(const CanFrame& frame, CobIdUse::Kind kind, Instant now) noexcept;
  void ownIdUsed(const CanFrame& frame, Instant now) noexcept;
  /// An NMT frame that is none.
  void malformedNmt(const CanFrame& frame, Instant now) noexcept;

 private:
  enum class Finding : std::uint8_t { kSecondMaster, kOwnIdUsed, kMalformedNmt, kCount };

  Counters& counters_;
  BusFindings<CanopenEvents, Finding> findings_;
};

}  // namespace nord_driver::canopen

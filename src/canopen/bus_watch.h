// Others on the bus: nodes that are not configured and their master, a second master of our nodes, somebody with our own
// node id. Counted always, told once per node or once per second.
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
  /// Of what a master says to our nodes.
  void secondMaster(const CanFrame& frame, CobIdUse::Kind kind, Instant now) noexcept;
  /// NMT for a node that is not ours, by the master it has.
  void foreignCommand(const CanFrame& frame, Instant now) noexcept;
  void ownIdUsed(const CanFrame& frame, Instant now) noexcept;
  /// An NMT frame that is none.
  void malformedNmt(const CanFrame& frame, Instant now) noexcept;

 private:
  /// What stops a drive is not hidden by what was told a moment ago: NMT and control words have a second of their own.
  enum class Finding : std::uint8_t {
    kSecondMaster,
    kSecondNmt,
    kControlWord,
    kForeignCommand,
    kOwnIdUsed,
    kMalformedNmt,
    kCount
  };
  static Finding findingOf(CobIdUse::Kind kind) noexcept;

  Counters& counters_;
  BusFindings<CanopenEvents, Finding> findings_;
};

}  // namespace nord_driver::canopen

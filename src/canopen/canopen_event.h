// What a CANopen master tells the layer above when it happens.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/event_ring.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

enum class CanopenEventKind : std::uint8_t {
  kNodeFound,        ///< answers, or has sent its boot-up
  kNodeOperational,  ///< PDOs are exchanged from the next cycle on
  kNodeLost,         ///< was operational, and its heartbeat or guarding failed, or it left the state by itself
  kNodeRefused,      ///< must not or will not run. Told when the reason changes
  kEmergency,        ///< `value`: error code << 8 | error register
  kToggleError,      ///< guarding answered twice with the same toggle bit
  kBootUpRepeated,   ///< boot-ups while it was being started: two nodes with one id, or a heartbeat that says 0
  kDoubleId,         ///< more answers than questions: two nodes with one id
  kMalformed,        ///< a frame of a wrong length or an impossible value; `value`: its identifier
  // Not of a configured node: `node` is kNoNode.
  kForeignNode,     ///< `value`: id of a node that is not configured; told once per node until `restart()`
  kForeignCommand,  ///< somebody else sends NMT to a node that is not configured: nothing to us; `value`: the identifier
  kSecondMaster,    ///< somebody else sends NMT, SYNC, guarding, RPDOs or SDO requests; `value`: the identifier
  kOwnIdUsed        ///< somebody else sends boot-up or heartbeat with our own node id
};

constexpr std::size_t kNoNode = static_cast<std::size_t>(-1);

struct CanopenEvent {
  CanopenEventKind kind = CanopenEventKind::kNodeFound;
  std::size_t node = kNoNode;  ///< index as configured
  std::uint32_t value = 0;
  Instant at{};
  Sentence text;  ///< for a technician; subject left out when it is a node of ours
};

using CanopenEvents = EventRing<CanopenEvent, 256>;

}  // namespace nord_driver::canopen

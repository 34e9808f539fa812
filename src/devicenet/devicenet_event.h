// What a DeviceNet scanner tells the layer above when it happens.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/event_ring.h"
#include "nord_driver/core/fixed_text.h"
#include "nord_driver/core/time.h"

namespace nord_driver::devicenet {

enum class DevicenetEventKind : std::uint8_t {
  kNodeFound,       ///< has let itself be allocated
  kNodeExchanging,  ///< process data are exchanged from the next cycle on; explicit messaging alone: connected
  kNodeLost,        ///< was exchanging, and fell silent, shut down or ended the connection
  kNodeRefused,     ///< must not or will not run. Told when the reason changes
  kHeartbeat,       ///< its state or faults, when they changed; `value`: state << 8 | fault flags
  kShutdown,        ///< says that it leaves; `value`: its code
  kDoubleMac,       ///< two devices have its MAC id
  kMalformed,       ///< a frame of a wrong length or with an impossible value; `value`: its identifier
  // Not of a configured device: `node` is kNoNode.
  kForeignNode,         ///< `value`: MAC id of a device that is not configured; told once until `restart()`
  kSecondScanner,       ///< another master works with one of our devices; `value`: the identifier
  kOnline,              ///< nobody else has our MAC id
  kCommunicationFault,  ///< somebody else has our MAC id; `value`: its serial number
  kBusLost              ///< `Scanner::handleBusLost()`
};

constexpr std::size_t kNoNode = static_cast<std::size_t>(-1);

struct DevicenetEvent {
  DevicenetEventKind kind = DevicenetEventKind::kNodeFound;
  std::size_t node = kNoNode;  ///< index as configured
  std::uint32_t value = 0;
  Instant at{};
  Sentence text;  ///< for a technician; subject left out when it is a device of ours
};

using DevicenetEvents = EventRing<DevicenetEvent, 256>;

}  // namespace nord_driver::devicenet

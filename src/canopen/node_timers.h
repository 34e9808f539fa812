// The deadlines of one node, its start-up and its error control together.
#pragma once

#include <cstdint>

#include "core/timer_table.h"

namespace nord_driver::canopen {

enum class NodeTimer : std::uint8_t {
  kBoot,           ///< of the phase the start-up is in: a time-out or the end of a pause
  kHeartbeat,      ///< the next heartbeat is due (CiA 301 7.2.8.3.2.2)
  kGuardQuestion,  ///< the next question of node guarding
  kGuardLife,      ///< the node life time without a good answer (CiA 301 7.2.8.3.2.1)
  kSilence,        ///< `NodeConfig::silence` without a TPDO
  kCount
};
using NodeTimers = TimerTable<NodeTimer>;

}  // namespace nord_driver::canopen

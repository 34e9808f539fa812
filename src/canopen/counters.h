// What a CANopen master counts for the bus as a whole, since construction.
#pragma once

#include <cstdint>

namespace nord_driver::canopen {

struct Counters {
  std::uint64_t cycles = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_received = 0;
  std::uint64_t syncs = 0;
  std::uint64_t not_sent = 0;       ///< frames the link had no room for
  std::uint64_t superseded = 0;     ///< RPDOs and SYNCs that were not sent in their cycle
  std::uint64_t malformed = 0;      ///< of our nodes, and NMT commands of others
  std::uint64_t foreign = 0;        ///< identifiers and nodes that are not configured, NMT for such nodes included
  std::uint64_t second_master = 0;  ///< frames only a master of our nodes sends
  std::uint64_t own_id_used = 0;
  std::uint64_t sdo_timeouts = 0;
  std::uint64_t sdo_aborts = 0;
  std::uint64_t stray_sdo = 0;  ///< SDO answers nobody waited for
};

}  // namespace nord_driver::canopen

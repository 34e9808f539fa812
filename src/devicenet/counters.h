// What a DeviceNet scanner counts for the bus as a whole, since construction.
#pragma once

#include <cstdint>

namespace nord_driver::devicenet {

struct Counters {
  std::uint64_t cycles = 0;
  std::uint64_t frames_sent = 0;
  std::uint64_t frames_received = 0;
  std::uint64_t strobes = 0;
  std::uint64_t not_sent = 0;        ///< frames the link had no room for
  std::uint64_t superseded = 0;      ///< process data that were not sent whole in their cycle
  std::uint64_t malformed = 0;       ///< of our devices, and duplicate-MAC messages of anybody
  std::uint64_t foreign = 0;         ///< identifiers and devices that are not configured
  std::uint64_t second_scanner = 0;  ///< frames only the master of one of our devices sends
  std::uint64_t own_mac_used = 0;    ///< duplicate-MAC messages with our MAC id that were no harmless question
  std::uint64_t mac_answers = 0;     ///< questions about our MAC id that we answered
  std::uint64_t request_timeouts = 0;
  std::uint64_t request_errors = 0;
  std::uint64_t stray_answers = 0;  ///< explicit responses nobody waited for
};

}  // namespace nord_driver::devicenet

// What the rostests know of the bus under the robot of this run: its launch file says which one it is.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "nord_driver/transport/transport.h"
#include "support/map_settings.h"

namespace nord_driver::test {

/// Why a parameter access is refused.
enum class Refusal : std::uint8_t { kUnknownParameter, kReadOnly, kOutOfLimits, kNoSuchIndex };

struct BusUnderTest {
  const char* end_point;   ///< key of the group `bus`
  bool end_point_is_file;  ///< seen in the file system, and to be removed from it
  const char* parameter_channel;
  std::uint32_t ident;             ///< of the simulated modules
  const char* protection;          ///< what of this bus stops a drive, with the times of these tests
  const char* default_protection;  ///< the same with those of the driver
  /// A drive that is left at the driver's end is let go before it could miss anybody; otherwise its watchdog expires.
  bool lets_go;
  /// The fault of a drive whose master has died, as P700 shows it.
  std::uint16_t master_lost;
  /// Parameters can be written to RAM alone; otherwise P560 is switched off and on, which are two writes.
  bool has_ram_orders;
  /// A drive that fell silent is offline after this share of drive_timeout at the earliest: its last sign of life may be
  /// older than its last answer.
  double shortest_silence;
  /// s that a module is silent on this bus before it takes part: DeviceNet's duplicate-MAC check.
  double module_start;
  /// What a refusal says.
  const char* refusals[4];
  /// A transport of this bus, and what has to be set for it: the driver's own end point.
  std::unique_ptr<Transport> (*make_transport)();
  void (*set_bus)(MapSettings& bus);
  void (*set_drive)(MapSettings& drive);

  const char* refusal(Refusal reason) const { return refusals[static_cast<int>(reason)]; }
};

/// Of this run.
const BusUnderTest& bus();

}  // namespace nord_driver::test

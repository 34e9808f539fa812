// How many EEPROM writes which drive has had: as a file has it, and in memory.
//
//     schema: 1
//     drives:
//       "/dev/ttyUSB0, address 3, inverter 1, sk5xxe": {day: 2026-11-23, writes: 3, total: 41}
//
// The lines are YAML for whoever looks, and are read exactly as they are written: what differs is broken.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "state/state_error.h"

namespace nord_driver::state {

struct EepromCount {
  std::int64_t day = 0;      ///< by UTC, since 1970-01-01
  std::uint64_t writes = 0;  ///< on that day
  std::uint64_t total = 0;   ///< since the file was begun
};

/// By the drive's name in the file.
using EepromCounts = std::map<std::string, EepromCount>;

std::string textOf(const EepromCounts& counts);
/// Throws StateError naming `file`, line and what was expected.
EepromCounts countsFrom(const std::string& text, const std::string& file);

}  // namespace nord_driver::state

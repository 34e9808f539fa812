// The GSD files of a configuration, and what they say of a station.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "core/baud_rate.h"
#include "nord_driver/config/settings.h"
#include "profibus/gsd_file.h"
#include "transport/profibus/ppo.h"

namespace nord_driver {

struct GsdEntry {
  std::string path;
  profibus::GsdFile file;
  bool used = false;
};

class ProfibusGsdLibrary {
 public:
  /// Reads the files named by `bus/gsd`. Throws ConfigError for one that cannot be read; what is wrong in its text is a
  /// warning.
  ProfibusGsdLibrary(const Settings& bus, BaudRate baud, std::vector<std::string>& warnings);

  /// The file the drive names itself (`gsd`), or the one of this ident number; nullptr: none. Where two have the ident
  /// number, the one that knows the baud rate: older modules have a file up to 1.5 Mbit/s and one up to 12 Mbit/s.
  const GsdEntry* find(const Settings& drive, std::uint16_t ident);

  /// Names what no station uses.
  void warnOfUnused();

 private:
  GsdEntry& load(const Settings& settings, const std::string& path);

  BaudRate baud_;
  std::vector<std::string>& warnings_;
  std::deque<GsdEntry> entries_;
};

bool supportsRate(const profibus::GsdFile& file, BaudRate baud);

/// The module of a GSD file for PPO `type`: by its name ("PPO Type 2"), or by the identifiers the manuals give; nullptr
/// when neither fits, or names fit that differ.
const profibus::GsdModule* findPpoModule(const profibus::GsdFile& file, std::uint8_t type,
                                         const profile::PpoLayout& layout);

}  // namespace nord_driver

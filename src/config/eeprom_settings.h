// What the configuration says of EEPROM writes; the node and nord_param read it alike.
#pragma once

#include <cstdint>
#include <string>

#include "nord_driver/config/settings.h"

namespace nord_driver {

struct EepromSettings {
  std::uint32_t budget = 1000;  ///< writes of each drive and day
  std::string state_file;       ///< an absolute path; empty: the one of this user
};

/// `eeprom_budget` and `eeprom_state_file`. Throws ConfigError.
EepromSettings readEepromSettings(const Settings& settings);

}  // namespace nord_driver

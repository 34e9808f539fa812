// A write to a drive whose EEPROM is counted: asked for before, noted after. The node and the programs write by it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "config/eeprom_settings.h"
#include "cycle/request.h"
#include "nord_driver/config/settings.h"
#include "state/drive_eeprom.h"

namespace nord_driver::tools {

/// The counts in the file of `settings`; without one in that of this user (ROS_HOME, else HOME).
state::EepromBudget eepromBudget(const EepromSettings& settings);

/// `end_point`: what the transport opens, as configured; `transport`: its name, for one that opens nothing. The drive's
/// settings have been checked.
state::DrivePlace placeOf(const std::string& end_point, const std::string& transport, const DriveSettings& drive);

struct CountedWrite {
  std::string refusal;                          ///< a sentence; nothing was begun then
  std::optional<cycle::Completion> completion;  ///< nothing: not answered, it may still be carried out
  std::string note;                             ///< what could not be noted, a sentence; may be empty
};

/// `parameter` is one to write; `write` does it and waits. Waits for the disk as well: not in the bus cycle.
CountedWrite countedWrite(state::DriveEeprom& eeprom, const profile::ParameterRequest& parameter,
                          const std::function<std::optional<cycle::Completion>()>& write);

}  // namespace nord_driver::tools

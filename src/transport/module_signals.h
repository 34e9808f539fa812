// Does a drive's configuration use inputs or outputs of its bus module (drives/<name>/signals)?
#pragma once

#include <string>

#include "config/setting_groups.h"
#include "nord_driver/config/settings.h"

namespace nord_driver {

inline bool usesModuleSignals(const Settings& drive) {
  for (const std::string& name : keysBelow(drive, "signals")) {
    const auto source = drive.text("signals/" + name + "/source");
    if (source && source->compare(0, 7, "module_") == 0) return true;
  }
  return false;
}

}  // namespace nord_driver

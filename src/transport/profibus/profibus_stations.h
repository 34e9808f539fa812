// Which stations there are on a segment, and what each is told: several drives may be behind one of them.
#pragma once

#include <vector>

#include "transport/profibus/profibus_dp_config.h"
#include "transport/profibus/profibus_gsd_library.h"

namespace nord_driver {

/// Fills `drives`, `slaves`, `stations` and `warnings` of a configuration whose bus and watchdog are known. Throws
/// ConfigError.
void readStations(const Settings& bus, const std::vector<DriveSettings>& drives, ProfibusGsdLibrary& gsd,
                  ProfibusDpConfig& config);

}  // namespace nord_driver

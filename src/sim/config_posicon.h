// The group `posicon` of a drive in the simulator's configuration.
#pragma once

#include <string>
#include <vector>

#include "sim/config_group.h"

namespace nord_driver::sim {

/// What is not there keeps its default. Throws ConfigError.
void readPosicon(const Group& drive, PosiconSettings& settings, std::vector<std::string>& warnings);

}  // namespace nord_driver::sim

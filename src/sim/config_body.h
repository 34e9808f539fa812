// Reads which drives move the simulated robot, and its sizes.
#pragma once

#include <optional>
#include <vector>

#include "sim/sim_config.h"

namespace YAML {
class Node;
}

namespace nord_driver::sim {

/// From the group `body` of the configuration, or else from the driver's keys; nothing where neither is complete.
/// Throws ConfigError.
std::optional<BodyConfig> readBody(const YAML::Node& node, const std::vector<DriveConfig>& drives);

}  // namespace nord_driver::sim

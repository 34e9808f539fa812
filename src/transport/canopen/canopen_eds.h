// The EDS file a drive's settings name: checked against its node, which takes from it what was left open.
#pragma once

#include <cstdint>

#include "canopen/node_config.h"
#include "nord_driver/config/settings.h"

namespace nord_driver {

/// Does nothing without `eds`. Throws ConfigError when the file cannot be read, or when the node would, going by it,
/// refuse what is configured.
void applyEds(const Settings& settings, std::uint32_t bit_rate, canopen::NodeConfig& node);

}  // namespace nord_driver

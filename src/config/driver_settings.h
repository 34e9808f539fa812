// What the node and the programs read alike of the driver's configuration: which transport, and which drives.
#pragma once

#include <string>
#include <vector>

#include "config/tree_settings.h"

namespace nord_driver {

/// `transport` as pluginlib knows it: "profibus_dp" is "nord_driver/profibus_dp", which is also what stands in for an
/// absent key. Throws ConfigError when it is no text.
std::string readTransportName(const Settings& settings);

/// As users write it: what this package brings needs no prefix.
std::string shortTransportName(const std::string& name);

/// What to throw when no plugin of this `name` is `declared`; names are told as users write them.
ConfigError unknownTransport(const Settings& settings, const std::string& name,
                             const std::vector<std::string>& declared);

/// The groups below `drives`, sorted by name. Throws ConfigError when one of them is no group, and when there is no
/// `drives` but one a level deeper.
std::vector<DriveSettings> readDriveList(const TreeSettings& settings);

}  // namespace nord_driver

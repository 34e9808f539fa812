// What the node tells of its configuration when it starts, in one line of the log.
#pragma once

#include <string>
#include <vector>

#include "node/node_config.h"

namespace nord_driver::node {

/// "transport my_card at /dev/ttyUSB0, 2 drives: left (station 3), right (station 4), base differential": who sees more drives than the robot has looks for parameters left over from an earlier start.
/// `identities`: one per drive. `where`: what the transport opens, as configured; may be empty.
std::string startSentence(const NodeConfig& config, const std::vector<DriveIdentity>& identities,
                          const std::string& where);

}  // namespace nord_driver::node

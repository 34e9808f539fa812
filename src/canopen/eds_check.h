// A node's configuration against the EDS of its maker: what cannot work is said before the bus is opened, and what was
// left open is filled in.
#pragma once

#include <string>
#include <vector>

#include "canopen/eds_file.h"
#include "canopen/node_config.h"

namespace nord_driver::canopen {

/// One sentence for everything the node would refuse or be found to differ in, going by the file: identity, bit rate
/// (`bits_per_second`; 0: not looked at), error control, writes of the set-up, and every enabled PDO with its COB-ID,
/// type, times and mapping. Empty: it fits. What the file does not tell is not complained about.
std::vector<std::string> checkAgainstEds(const NodeConfig& config, const EdsFile& file,
                                         std::uint32_t bits_per_second = 0);

/// Takes from the file what the configuration leaves open: device type, vendor and product (not the revision: newer
/// firmware has a newer one), and of enabled PDOs COB-ID and mapping. A mapping with bits that make no whole bytes is
/// not taken.
NodeConfig filledFromEds(NodeConfig config, const EdsFile& file);

}  // namespace nord_driver::canopen

// A device's configuration against the EDS file of its maker: what cannot work is said before the bus is opened.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devicenet/eds_file.h"
#include "devicenet/node_config.h"

namespace nord_driver::devicenet {

/// The assembly instances whose bytes are exchanged.
struct EdsAssemblies {
  std::uint8_t input = 0;
  std::uint8_t output = 0;
  bool variable = false;  ///< parameters of the device lay them out: the file can only tell the longest
};

/// One sentence, beginning with "line N: ", for everything in which the configuration differs from the file: identity,
/// kind of connection, lengths. Empty: it fits. What the file does not tell is not complained about.
std::vector<std::string> checkAgainstEds(const NodeConfig& config, const EdsAssemblies& assemblies,
                                         const EdsFile& file);

/// Takes the identity from the file where the configuration leaves it open.
NodeConfig filledFromEds(NodeConfig config, const EdsFile& file);

}  // namespace nord_driver::devicenet

// What a configuration asks for and this build does not have.
#pragma once

#include "node/node_config.h"

namespace nord_driver::node {

/// `config` without the topics this was built without; each of them is a warning in it. `settings`: what it was read
/// from.
NodeConfig withWhatIsOffered(NodeConfig config, const TreeSettings& settings);

}  // namespace nord_driver::node

// What somebody at the machine does next when the base has stopped by itself.
#pragma once

#include <string>
#include <vector>

#include "cycle/snapshot.h"

namespace nord_driver::node {

/// "~enable", or what has to come before it; the first drive that stands in the way is named.
std::string recoveryHint(const cycle::CycleSnapshot& snapshot, const std::vector<std::string>& drive_names);

}  // namespace nord_driver::node

// The drives of a configuration, on the transport that carries them.
#pragma once

#include <vector>

#include "cycle/cycle_config.h"
#include "drive/drive.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::cycle {

/// `transport` is configured; it is told the shortest drive_timeout.
std::vector<drive::Drive> makeDrives(const CycleConfig& config, Transport& transport, bool onlooker);

}  // namespace nord_driver::cycle

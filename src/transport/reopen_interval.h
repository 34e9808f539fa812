// How a bus that could not be opened, or was lost, is come back to.
#pragma once

#include "nord_driver/core/time.h"

namespace nord_driver {

/// From one try to open a device, an interface or a connection to the next.
constexpr Duration kReopenInterval = std::chrono::milliseconds{500};

}  // namespace nord_driver

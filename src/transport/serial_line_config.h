// The settings of the serial line below `bus`: device, RS-485 by the kernel, echo.
#pragma once

#include "nord_driver/link/serial_settings.h"
#include "nord_driver/transport/settings.h"

namespace nord_driver {

/// Everything but the baud rate. Throws ConfigError.
link::SerialSettings readSerialLine(const Settings& bus);

}  // namespace nord_driver

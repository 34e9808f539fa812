// The settings of the serial line below `bus`: device, RS-485 by the kernel, echo.
#pragma once

#include "link/serial/serial_settings.h"
#include "nord_driver/config/settings.h"

namespace nord_driver {

/// Everything but the baud rate. Throws ConfigError.
link::SerialSettings readSerialLine(const Settings& bus);

}  // namespace nord_driver

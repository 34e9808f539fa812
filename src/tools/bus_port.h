// Where the bus is, said on the command line: --device for PROFIBUS, --interface for CANopen.
#pragma once

#include <string>

#include "tools/usage_error.h"

namespace nord_driver::tools {

/// In place of the configuration's bus/device or bus/interface; empty: not given.
struct BusPort {
  std::string device;
  std::string interface;
};

/// Throws UsageError when the port is one of the other transport: what would be ignored looks taken.
inline void checkPort(const BusPort& port, bool canopen) {
  const bool wrong = canopen ? !port.device.empty() : !port.interface.empty();
  if (!wrong) return;
  throw UsageError(canopen ? "--device does not fit the transport canopen, expected --interface"
                           : "--interface does not fit the transport profibus_dp, expected --device");
}

}  // namespace nord_driver::tools

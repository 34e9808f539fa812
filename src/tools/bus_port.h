// Where the bus is, said on the command line: --bus, or --device and --interface for the buses that have such a key.
#pragma once

#include <string>

#include "tools/usage_error.h"

namespace nord_driver::tools {

/// In place of the configuration's; empty: not given.
struct BusPort {
  std::string device;     ///< for a bus that is at bus/device
  std::string interface;  ///< for a bus that is at bus/interface
  std::string bus;        ///< for every bus
};

/// The value that was given for bus/<key>; empty: none was. `key` is empty where the bus has no end point. Throws
/// UsageError when what was given does not fit: what would be ignored looks taken.
inline std::string chosenPort(const BusPort& port, const std::string& transport, const std::string& key) {
  const auto refuse = [&](const std::string& option) {
    const bool has_option = key == "device" || key == "interface";
    const std::string expected = key.empty() ? "none: it opens nothing" : "--" + (has_option ? key : "bus");
    throw UsageError(option + " does not fit the transport " + transport + ", expected " + expected);
  };
  if (!port.device.empty() && key != "device") refuse("--device");
  if (!port.interface.empty() && key != "interface") refuse("--interface");
  if (!port.bus.empty() && key.empty()) refuse("--bus");
  const std::string& with_name = key == "device" ? port.device : port.interface;
  if (!port.bus.empty() && !with_name.empty()) {
    throw UsageError("--bus and --" + key + " both say where the bus is, expected one of them");
  }
  return port.bus.empty() ? with_name : port.bus;
}

}  // namespace nord_driver::tools

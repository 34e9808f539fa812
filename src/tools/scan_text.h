// Who is on a bus, as a table and for programs.
#pragma once

#include <string>

#include "transport/bus_scanner.h"

namespace nord_driver::tools {

/// Every line ends with a line feed; what is wrong with the scan itself is not in it.
std::string scanText(const ScanReport& report);
/// One object, one line.
std::string scanJson(const ScanReport& report);

}  // namespace nord_driver::tools

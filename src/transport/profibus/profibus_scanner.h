// Who is on a PROFIBUS segment: the live list with what the stations say they are.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "link/serial/byte_link.h"
#include "link/serial/serial_settings.h"
#include "transport/bus_scanner.h"

namespace nord_driver {

/// FDL status of every address and the diagnosis of each slave, which leave a slave as it is. A slave that no master
/// has parameterised, and whose module knows MS2, is asked for its type plate (I&M0) and the parameters P707, P742 and P743
/// of the inverters behind it, too: a row for each that answers.
ScanReport scanProfibus(const Settings& bus,
                        const std::function<std::unique_ptr<link::ByteLink>(const link::SerialSettings&)>& make_link,
                        const std::atomic<bool>& end_asked);

/// See BusScanner::quiet().
std::string profibusScanIsQuiet(const Settings& bus);

}  // namespace nord_driver

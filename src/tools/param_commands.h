// The commands of nord_param: what each prints, and whether it worked.
#pragma once

#include <atomic>
#include <string>

#include "nord_driver/transport/transport.h"
#include "tools/drive_parameters.h"
#include "tools/parameter_dump.h"
#include "tools/tool_config.h"

namespace nord_driver::tools {

struct WriteOptions {
  std::string value;  ///< as typed
  bool persistent = false;
  bool raw = false;
};

/// The address of NAME, --set and --index (0: not given). Throws UsageError when two of them contradict each other.
catalogue::ParameterAddress addressOf(const std::string& name, int set, int index,
                                      const catalogue::DriveCatalogue& known);

/// What can be known of a write before the bus is touched: throws UsageError when the value is none, or raw values
/// would be needed; Trouble when it is out of the catalogue's range, or the parameter is not to be written.
catalogue::ParameterAccess checkedWrite(const WriteOptions& write, const catalogue::ParameterAddress& address,
                                        const catalogue::DriveCatalogue& known);

// On a connected link; false: refused or different, and said so on stderr or stdout.
bool readParameter(DriveParameters& drive, const catalogue::ParameterAddress& address);
bool writeParameter(DriveParameters& drive, const catalogue::ParameterAccess& access);
bool dumpParameters(DriveParameters& drive, const std::atomic<bool>& end_asked);
bool compareParameters(DriveParameters& drive, const Dump& reference, const std::atomic<bool>& end_asked);

}  // namespace nord_driver::tools

// The commands of nord_param: what each prints, and whether it worked.
#pragma once

#include <string>

#include "nord_driver/transport/transport.h"
#include "tools/drive_parameters.h"

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

// On a connected link; false: refused, and said so on stderr.
bool readParameter(DriveParameters& drive, const catalogue::ParameterAddress& address, bool json);
bool writeParameter(DriveParameters& drive, const catalogue::ParameterAccess& access, bool json);

}  // namespace nord_driver::tools

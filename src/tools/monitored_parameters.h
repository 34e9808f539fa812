// drives/<name>/monitor: the parameters somebody wants to look at while the driver runs.
#pragma once

#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "catalogue/parameter_access.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::tools {

struct MonitoredParameter {
  std::string label;  ///< "P700[-01]", "P105 set 2"
  catalogue::ParameterAccess access;
};

/// More of one drive would not come around within some seconds on a slow channel.
constexpr std::size_t kMaxMonitored = 32;

/// `words`: as the key holds them, numbers or names with index and set as nord_param takes them. `known` must outlive
/// the result. A number that is not in the catalogue is read as it is. Throws ConfigError for what is no parameter's
/// number or name, an element the array has not, one that stands there twice, too many, and for any where no parameter
/// channel leads to the drive.
std::vector<MonitoredParameter> monitoredParameters(const DriveSettings& drive, const std::vector<std::string>& words,
                                                    const catalogue::DriveCatalogue& known,
                                                    const DriveIdentity& identity);

/// A sentence for each that comes without name and unit.
std::vector<std::string> notInCatalogue(const DriveSettings& drive, const std::vector<MonitoredParameter>& parameters);

}  // namespace nord_driver::tools

// The parameters of drives/<name>/monitor as messages and /diagnostics show them.
#pragma once

#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "cycle/snapshot.h"
#include "nord_driver/ParameterValue.h"
#include "tools/monitored_parameters.h"

namespace nord_driver::node {

/// Of one drive.
class DriveValues {
 public:
  DriveValues(catalogue::DriveCatalogue known, std::vector<tools::MonitoredParameter> parameters);

  bool empty() const noexcept { return parameters_.empty(); }
  /// One for each parameter, in their order.
  std::vector<ParameterValue> values(const cycle::DriveSnapshot& drive) const;

 private:
  catalogue::DriveCatalogue known_;
  std::vector<tools::MonitoredParameter> parameters_;
};

}  // namespace nord_driver::node

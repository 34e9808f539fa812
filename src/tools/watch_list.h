// The parameters that are read of some drives at each look, and what their rows are called.
#pragma once

#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "catalogue/parameter_access.h"
#include "tools/drive_parameters.h"

namespace nord_driver::tools {

class WatchList {
 public:
  /// `parameters` as users name them; `known`: of each drive. Throws UsageError when one of the drives cannot have such
  /// a parameter.
  WatchList(const std::vector<std::string>& parameters, const std::vector<const catalogue::DriveCatalogue*>& known);

  /// As a table names them: "P719 Current".
  const std::vector<std::string>& labels() const noexcept { return labels_; }
  /// In the same order, as this drive has them.
  const std::vector<catalogue::ParameterAddress>& of(std::size_t drive) const { return addresses_[drive]; }

 private:
  std::vector<std::string> labels_;
  std::vector<std::vector<catalogue::ParameterAddress>> addresses_;  // by drive
};

/// What was read, with its unit; or why it was not.
std::string answerCell(const catalogue::ParameterAddress& address, const ParameterAnswer& answer,
                       const catalogue::DriveCatalogue& known);

}  // namespace nord_driver::tools

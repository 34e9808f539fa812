// The words of a command that mean one parameter of one drive: DRIVE PARAMETER --set --index.
#pragma once

#include <string>

#include "catalogue/drive_catalogue.h"
#include "catalogue/parameter_access.h"
#include "tools/command_line.h"

namespace nord_driver::tools {

/// DRIVE, the first word of most commands.
void addDrive(Command& command, std::string* drive);

struct ParameterWords {
  std::string drive;
  std::string parameter;
  WholeNumber<1, 4> set;     ///< 0: not given
  WholeNumber<1, 99> index;  ///< 0: not given

  void addTo(Command& command);
  /// Throws UsageError when there is no such parameter, or two of the words contradict each other.
  catalogue::ParameterAddress address(const catalogue::DriveCatalogue& known) const;
};

}  // namespace nord_driver::tools

// By what the first words of a drive are drawn in Hz.
#pragma once

#include <optional>

#include "tools/drive_parameters.h"
#include "tools/scope_record.h"

namespace nord_driver::tools {

/// P105 as it is read, and `typed`, in Hz, where it cannot be. It is read in any case: a profile in rpm tells this program
/// no frequency before. Of a drive that `positions`, P543 and P546 as well.
void readScale(DriveParameters& drive, std::optional<double> typed, bool positions, ScopeRecord& record);

}  // namespace nord_driver::tools

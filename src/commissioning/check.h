// The commissioning check: which values of a drive are to be read, and what is found in them.
#pragma once

#include <vector>

#include "commissioning/drive_under_check.h"
#include "commissioning/rules.h"

namespace nord_driver::commissioning {

/// Every value a rule looks at, of a drive in this parameter set (1..4), the ones that matter most first.
std::vector<ParameterKey> valuesToRead(const AskedDrive& asked, const catalogue::DriveCatalogue& known,
                                       std::uint8_t set_in_force);

/// What is found in all drives of a configuration, drive by drive in the order of the rules.
Findings check(const Drives& drives);

}  // namespace nord_driver::commissioning

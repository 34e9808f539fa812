// Whether setpoint 1 and actual value 1 of a drive are frequencies: those of one that positions may be its position.
#pragma once

#include "catalogue/parameter_access.h"
#include "nord_driver/profile/series.h"
#include "tools/drive_parameters.h"
#include "tools/scope_record.h"

namespace nord_driver::tools {

/// P543 of actual value 1, P546 of setpoint 1: what the word carries. `set`: 1..4, or 0 for the one in force.
catalogue::ParameterAddress firstWordFunction(profile::Series series, bool actual_value, std::uint8_t set);

/// By the answer to that. False as well where it could not be read: the word may be a position then.
bool saysFrequency(const ParameterAnswer& answer, profile::Series series, bool actual_value);

/// Reads both of a drive that positions, by the set in force.
void readFirstWords(DriveParameters& drive, ScopeRecord& record);

}  // namespace nord_driver::tools

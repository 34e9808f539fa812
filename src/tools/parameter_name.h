// How people and files name one parameter value: "105", "P105", "P700[-01]", "P546[-02] set 3".
#pragma once

#include <string>
#include <vector>

#include "catalogue/parameter_access.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

/// Index and set are 0 where the name has none. Throws UsageError.
catalogue::ParameterAddress parseParameterName(const std::string& name);
std::string parameterName(const catalogue::ParameterAddress& address);

/// The same of what a user types, who may also give the parameter's name in the catalogue: "Maximum frequency",
/// "Bus actual value[-02] set 3". Throws UsageError.
catalogue::ParameterAddress findParameter(const std::string& text, const catalogue::DriveCatalogue& known);

/// Every value of every parameter that is known of a drive, by number, array index and set. What resets a device is
/// left out.
std::vector<catalogue::ParameterAddress> knownParameters(const catalogue::DriveCatalogue& known);

/// A value somebody sets, unlike what inverter (P700 to P799) and bus module (P170 to P199) tell of themselves.
bool isSetting(const catalogue::ParameterAddress& address) noexcept;

}  // namespace nord_driver::tools

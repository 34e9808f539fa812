// How people and files name one parameter value: "105", "P105", "P700[-01]", "P546[-02] set 3".
#pragma once

#include <string>
#include <vector>

#include "cycle/parameter_access.h"
#include "nord_driver/profile/series.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {

/// Index and set are 0 where the name has none. Throws UsageError.
cycle::ParameterAddress parseParameterName(const std::string& name);
std::string parameterName(const cycle::ParameterAddress& address);

/// A value as the command line gives it. Throws UsageError.
double parseValue(const std::string& text);

/// Every value of every parameter the catalogue knows of a series, by number, array index and set.
std::vector<cycle::ParameterAddress> knownParameters(profile::Series series);

/// A value somebody sets, unlike what inverter (P700 to P799) and bus module (P170 to P199) tell of themselves.
bool isSetting(const cycle::ParameterAddress& address) noexcept;

}  // namespace nord_driver::tools

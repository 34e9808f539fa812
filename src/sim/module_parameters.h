// The parameters of the bus module itself, P150 to P199: BU 2700 7.1, BU 0220 5.2. Reached by records only.
#pragma once

#include <vector>

#include "sim/inverter/parameter_definitions.h"

namespace nord_driver::sim {

std::vector<ParameterDefinition> moduleParameterDefinitions();

/// What P181 shows for this rate; 15 (no rate found) for one it does not list.
int moduleBaudRateCode(unsigned bits_per_second) noexcept;

}  // namespace nord_driver::sim

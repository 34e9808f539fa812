// Parameters of an inverter or a module in the simulator's configuration, and keys that nobody knows.
#pragma once

#include <string>
#include <vector>

#include "sim/config_group.h"
#include "sim/inverter/parameter_store.h"

namespace nord_driver::sim {

/// `key: value` of the parameter `name` ("P102"), in the unit of the manual: one value, or a list of the four sets or
/// the array elements. `expected` ends the refusal of one that `catalogue` does not have. Throws ConfigError.
void readParameter(const std::string& key, const std::string& name, const YAML::Node& values,
                   const ParameterStore& catalogue, const std::string& expected, std::vector<ParameterPreset>& presets);
/// The group `parameters` of `group`, where it is there.
void readParameters(const Group& group, const ParameterStore& catalogue, const std::string& expected,
                    std::vector<ParameterPreset>& presets);
/// One warning for each key of `node` that is not among the known ones.
void warnOfUnknown(const YAML::Node& node, const std::string& path, const std::vector<std::string>& known,
                   std::vector<std::string>& warnings);

}  // namespace nord_driver::sim

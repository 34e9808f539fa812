#include "sim/config_parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace nord_driver::sim {

namespace {

/// "-0.1", not "-0.10000000000000001".
std::string inUnit(std::int32_t raw, const ParameterDefinition& definition) {
  std::ostringstream text;
  text << static_cast<double>(raw) / definition.divisor;
  return text.str();
}

}  // namespace

void readParameter(const std::string& key, const std::string& name, const YAML::Node& values,
                   const ParameterStore& catalogue, const std::string& expected,
                   std::vector<ParameterPreset>& presets) {
  const ParameterDefinition* definition = nullptr;
  if (name.size() == 4 && name[0] == 'P' &&
      std::all_of(name.begin() + 1, name.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
    definition = catalogue.find(static_cast<unsigned>(std::stoul(name.substr(1))));
  }
  if (definition == nullptr) {
    throw ConfigError(key + ": " + name + " is no parameter of the simulated " + expected);
  }
  const unsigned sets = definition->per_set ? ParameterStore::kSets : 1;
  const unsigned places = sets * std::max<unsigned>(definition->elements, 1);
  if (values.IsSequence() && values.size() != places) {
    refuse(key, values, places == 1 ? "one number" : "one number or a list of " + std::to_string(places));
  }
  for (unsigned i = 0; i < places; ++i) {
    const YAML::Node node = values.IsSequence() ? values[i] : values;
    double value = 0.0;
    try {
      value = node.as<double>();
    } catch (const YAML::Exception&) {
      refuse(key, values, "a number in the unit of the manual");
    }
    const double raw = std::round(value * definition->divisor);
    if (!(raw >= definition->minimum && raw <= definition->maximum)) {
      refuse(key, values,
             "a number from " + inUnit(definition->minimum, *definition) + " to " +
                 inUnit(definition->maximum, *definition));
    }
    ParameterPreset preset;
    preset.number = definition->number;
    preset.set = i % sets;
    preset.element = i / sets;
    preset.raw = static_cast<std::int32_t>(raw);
    presets.push_back(preset);
  }
}

void readParameters(const Group& group, const ParameterStore& catalogue, const std::string& expected,
                    std::vector<ParameterPreset>& presets) {
  if (!group.has("parameters")) return;
  const std::string key = group.keyName("parameters");
  if (!group["parameters"].IsMap()) refuse(key, group["parameters"], "a group like {P102: 2.0, P105: 50.0}");
  for (const auto& entry : group["parameters"]) {
    const std::string parameter = entry.first.as<std::string>();
    readParameter(key + "/" + parameter, parameter, entry.second, catalogue, expected, presets);
  }
}

void warnOfUnknown(const YAML::Node& node, const std::string& path, const std::vector<std::string>& known,
                   std::vector<std::string>& warnings) {
  for (const auto& entry : node) {
    const std::string key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      warnings.push_back(path + "/" + key + " is not known to the simulator and not used");
    }
  }
}

}  // namespace nord_driver::sim

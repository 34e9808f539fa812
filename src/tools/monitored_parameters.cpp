#include "tools/monitored_parameters.h"

#include <algorithm>

#include "config/setting_checks.h"
#include "profile/parameter_shape.h"
#include "tools/parameter_name.h"

namespace nord_driver::tools {

namespace {

constexpr const char* kKey = "monitor";

MonitoredParameter monitoredParameter(const Settings& settings, const std::string& word,
                                      const catalogue::DriveCatalogue& known) {
  catalogue::ParameterAddress address;
  try {
    address = findParameter(word, known);
  } catch (const UsageError& error) {
    throw ConfigError(settings.fullName(kKey) + ": " + error.what());
  }
  MonitoredParameter parameter;
  parameter.access = catalogue::accessTo(address, known);
  const catalogue::ParameterEntry* entry = parameter.access.entry;
  if (!parameter.access.error.empty()) throw ConfigError(settings.fullName(kKey) + ": " + parameter.access.error);
  const profile::ParameterRequest& request = parameter.access.request;
  if (entry != nullptr && profile::isArray(request.shape)) {
    address.index = request.index;
    const unsigned elements = entry->elements.value_or(request.index);
    if (request.index > elements) {
      throw wrongSetting(settings, kKey, "\"" + word + "\"",
                         "an element [-01] to [-" + std::to_string(elements) + "] of this array");
    }
  }
  if (!profile::hasSets(request.shape) && address.parameter_set != 0) {
    throw wrongSetting(settings, kKey, "\"" + word + "\"", "no set: this parameter is the same in all of them");
  }
  parameter.label = parameterName(address);
  return parameter;
}

}  // namespace

std::vector<MonitoredParameter> monitoredParameters(const DriveSettings& drive, const std::vector<std::string>& words,
                                                    const catalogue::DriveCatalogue& known,
                                                    const DriveIdentity& identity) {
  const Settings& settings = *drive.settings;
  if (!words.empty() && identity.parameter_channel == "none") {
    throw wrongSetting(settings, kKey, "\"" + words.front() + "\"",
                       "none: this drive has no parameter channel to read it from");
  }
  if (words.size() > kMaxMonitored) {
    throw wrongSetting(settings, kKey, "a list of " + std::to_string(words.size()) + " parameters",
                       "at most " + std::to_string(kMaxMonitored));
  }
  std::vector<MonitoredParameter> list;
  for (const std::string& word : words) {
    MonitoredParameter parameter = monitoredParameter(settings, word, known);
    if (std::any_of(list.begin(), list.end(), [&](const auto& other) { return other.label == parameter.label; })) {
      throw wrongSetting(settings, kKey, "\"" + word + "\"",
                         "each parameter once: " + parameter.label + " stands there");
    }
    list.push_back(std::move(parameter));
  }
  return list;
}

std::vector<std::string> notInCatalogue(const DriveSettings& drive, const std::vector<MonitoredParameter>& parameters) {
  std::vector<std::string> sentences;
  for (const MonitoredParameter& parameter : parameters) {
    if (parameter.access.entry != nullptr) continue;
    sentences.push_back(drive.settings->fullName(kKey) + ": " + parameter.label +
                        " is not in the catalogue: its raw value is shown, without a name and a unit, unless a file of "
                        "parameter_files describes it");
  }
  return sentences;
}

}  // namespace nord_driver::tools

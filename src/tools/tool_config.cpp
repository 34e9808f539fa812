#include "tools/tool_config.h"

#include <algorithm>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver::tools {

namespace {

// A drive that is late is waited for: nothing turns that would have to be stopped.
constexpr Duration kDriveTimeout = std::chrono::seconds{1};

// Of the cycle only its rate counts. The base may need a URDF, which there is none of without a roscore.
YamlSettings rateOf(const YAML::Node& file) {
  YAML::Node rate{YAML::NodeType::Map};
  if (file["cycle_rate"]) rate["cycle_rate"] = file["cycle_rate"];
  return {"", rate};
}

ToolConfig read(const YAML::Node& file, const YamlSettings& settings, const std::vector<DriveSettings>& drives) {
  ToolConfig config;
  config.transport = readTransportName(settings);
  config.bus = settings.group("bus");
  config.parameter_files = settings.texts("parameter_files").value_or(std::vector<std::string>{});
  config.writable_parameters = readWritableParameters(settings);
  config.eeprom = readEepromSettings(settings);
  config.drives = drives;
  config.cycle = cycle::readCycleConfig(rateOf(file), drives);
  for (cycle::DriveSetup& setup : config.cycle.drives) {
    setup.drive.drive_timeout = std::max(setup.drive.drive_timeout, kDriveTimeout);
  }
  return config;
}

// A transport wants to know what it opens before it tells anything of its drives.
YAML::Node withAnyPort(const YAML::Node& file, const EndPoint& end_point) {
  const auto bus = YamlSettings{"", file}.group("bus");
  YAML::Node complete = YAML::Clone(file);
  if (!end_point.isNone() && !bus->has(end_point.key)) complete["bus"][end_point.key] = end_point.example;
  return complete;
}

}  // namespace

std::string transportOf(const YAML::Node& file) {
  return readTransportName(YamlSettings{"", file});
}

void choosePort(YAML::Node& file, const BusPort& port, const EndPoint& end_point) {
  const YamlSettings settings{"", file};
  std::string value = chosenPort(port, shortTransportName(readTransportName(settings)), end_point.key);
  settings.group("bus");  // refuses a value where the group belongs
  if (value.empty()) value = settings.text("bus_end_point").value_or("");
  if (!value.empty() && !end_point.isNone()) file["bus"][end_point.key] = value;
}

ToolConfig readToolConfig(const YAML::Node& file, const EndPoint& end_point) {
  const YAML::Node complete = withAnyPort(file, end_point);
  const YamlSettings settings{"", complete};
  return read(complete, settings, readDriveList(settings));
}

ToolConfig readToolConfig(const YAML::Node& file, const std::string& name) {
  const YamlSettings settings{"", file};
  const std::vector<DriveSettings> all = readDriveList(settings);
  const auto asked =
      std::find_if(all.begin(), all.end(), [&](const DriveSettings& drive) { return drive.name == name; });
  if (asked == all.end()) {
    std::string known;
    for (const DriveSettings& drive : all) known += (known.empty() ? "" : ", ") + drive.name;
    throw ConfigError("drive \"" + name + "\" is not in the configuration, expected " +
                      (known.empty() ? "one that has drives" : "one of " + known));
  }
  std::vector<DriveSettings> station{*asked};
  const auto address = asked->settings->integer("address");
  for (const DriveSettings& drive : all) {
    if (drive.name != name && drive.settings->integer("address") == address) station.push_back(drive);
  }
  return read(file, settings, station);
}

}  // namespace nord_driver::tools

#include "tools/tool_config.h"

#include <algorithm>
#include <optional>

#include "config/driver_settings.h"
#include "config/yaml_settings.h"

namespace nord_driver::tools {

namespace {

// A drive that is late is waited for: nothing turns that would have to be stopped.
constexpr Duration kDriveTimeout = std::chrono::seconds{1};

// Of the cycle its rate counts, and the time by which the setpoints of a drive are judged. The base may need a URDF,
// which there is none of without a roscore.
YamlSettings timesOf(const YAML::Node& file) {
  YAML::Node times{YAML::NodeType::Map};
  for (const char* key : {"cycle_rate", "cmd_vel_timeout"}) {
    if (file[key]) times[key] = file[key];
  }
  return {"", times};
}

ToolConfig read(const YAML::Node& file, const YamlSettings& settings, const std::vector<DriveSettings>& drives) {
  ToolConfig config;
  config.transport = readTransportName(settings);
  // Who comes for a parameter and goes would wait for the whole bus with each command.
  config.bus = settings.group("bus")->without("scan");
  config.parameter_files = settings.texts("parameter_files").value_or(std::vector<std::string>{});
  config.writable_parameters = readWritableParameters(settings);
  config.eeprom = readEepromSettings(settings);
  config.drives = drives;
  config.cycle = cycle::readCycleConfig(timesOf(file), drives, {}, false);
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

const DriveSettings& driveOf(const std::vector<DriveSettings>& all, const std::string& name) {
  const auto asked =
      std::find_if(all.begin(), all.end(), [&](const DriveSettings& drive) { return drive.name == name; });
  if (asked != all.end()) return *asked;
  std::string known;
  for (const DriveSettings& drive : all) known += (known.empty() ? "" : ", ") + drive.name;
  throw ConfigError("drive \"" + name + "\" is not in the configuration, expected " +
                    (known.empty() ? "one that has drives" : "one of " + known));
}

bool contains(const std::vector<DriveSettings>& drives, const std::string& name) {
  return std::any_of(drives.begin(), drives.end(), [&](const DriveSettings& drive) { return drive.name == name; });
}

}  // namespace

std::string transportOf(const YAML::Node& file) {
  return readTransportName(YamlSettings{"", file});
}

void choosePort(YAML::Node& file, const BusPort& port, const EndPoint& end_point) {
  const YamlSettings settings{"", file};
  std::string value = chosenPort(port, shortTransportName(readTransportName(settings)), end_point.key);
  settings.group("bus");  // refuses a value where the group belongs
  const auto in_file = settings.text("bus_end_point");
  if (value.empty()) {
    value = in_file.value_or("");
  } else if (in_file) {
    file["bus_end_point"] = value;  // the node's reader takes this before the key of the bus
  }
  if (value.empty() || end_point.isNone()) return;
  if (settings.group("bus")->text(end_point.key) == value) return;  // with its second way, as the file has them
  file["bus"][end_point.key] = value;
  if (*end_point.second_key != '\0' && file["bus"][end_point.second_key]) file["bus"][end_point.second_key] = value;
}

ToolConfig readToolConfig(const YAML::Node& file, const EndPoint& end_point) {
  const YAML::Node complete = withAnyPort(file, end_point);
  const YamlSettings settings{"", complete};
  return read(complete, settings, readDriveList(settings));
}

ToolConfig readToolConfig(const YAML::Node& file, const std::string& name) {
  return readToolConfig(file, std::vector<std::string>{name});
}

ToolConfig readToolConfig(const YAML::Node& file, const std::vector<std::string>& names) {
  const YamlSettings settings{"", file};
  // InterBus counts places among the drives it is given, and writes no image for this program.
  const bool ring = shortTransportName(readTransportName(settings)) == "interbus";
  const std::vector<DriveSettings> all = readDriveList(settings);
  std::vector<DriveSettings> stations;
  std::vector<std::optional<std::int64_t>> addresses;
  for (const std::string& name : names) {
    if (contains(stations, name)) throw ConfigError("drive \"" + name + "\" is named twice");
    stations.push_back(driveOf(all, name));
    addresses.push_back(stations.back().settings->integer("address"));
  }
  for (const DriveSettings& drive : all) {
    const bool beside =
        ring || std::find(addresses.begin(), addresses.end(), drive.settings->integer("address")) != addresses.end();
    if (beside && !contains(stations, drive.name)) stations.push_back(drive);
  }
  ToolConfig config = read(file, settings, stations);
  config.asked = names.size();
  config.reaches_others = !ring;
  return config;
}

}  // namespace nord_driver::tools

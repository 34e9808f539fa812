#include "sim/sim_config.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>

#include "sim/bus_kind.h"
#include "sim/config_body.h"
#include "sim/config_group.h"
#include "sim/config_parameters.h"
#include "sim/config_posicon.h"
#include "sim/inverter/parameter_store.h"

namespace nord_driver::sim {

namespace {

const char* const kOfAnInverter = "inverter; expected P102, P105, P513 ...";

// What a drive may be called is what ROS lets a name be.
bool isName(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

/// The driver's, those of the simulator, and those of every bus: one file serves them all.
const std::vector<std::string>& driveKeys() {
  static const std::vector<std::string> kKeys = [] {
    std::vector<std::string> keys{
        // the driver's
        "address", "series", "joint", "gear_ratio", "pole_pairs", "inverted", "max_frequency", "rated_current",
        "allow_minimum_frequency", "inverter", "max_velocity", "min_velocity", "max_acceleration", "min_acceleration",
        "max_jerk", "min_jerk", "setpoints", "signals", "torque_at_limit", "mode", "lead", "position", "monitor",
        "follows",
        // the simulator's
        "inertia", "rated_torque", "slip", "load", "viscous", "charging_time", "firmware", "parameter_delay",
        "ram_orders", "double_word_answers", "automatic_acknowledgement_delay", "parameters", "posicon"};
    for (const BusKind& kind : busKinds()) keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
    return keys;
  }();
  return kKeys;
}

// As the driver's file may have it: the series, or the type on the nameplate of one ("SK 535E-750-340-A"), an x standing
// for any of its figures.
std::string seriesName(const std::string& written) {
  std::string name;
  for (const char c : written) {
    if (c == '-') break;
    if (c != ' ') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  static const std::vector<std::pair<std::regex, std::string>> kPlates{{std::regex("sk1[89x]0e"), "sk1x0e"},
                                                                       {std::regex("sk2[0-3x][0-9x]e"), "sk2xxe"},
                                                                       {std::regex("sk54[0-9x]e"), "sk54xe"},
                                                                       {std::regex("sk5[0-3x][0-9x]e"), "sk5xxe"}};
  for (const auto& [plate, series] : kPlates) {
    if (std::regex_match(name, plate)) return series;
  }
  return name;
}

void readSeries(const Group& group, DriveConfig& drive) {
  static const std::map<std::string, Series> kSeries{{"sk300e", Series::kSk300e}, {"sk5xxe", Series::kSk5xxe},
                                                     {"sk54xe", Series::kSk54xe}, {"sk700e", Series::kSk700e},
                                                     {"sk750e", Series::kSk750e}, {"sk1x0e", Series::kSk1x0e},
                                                     {"sk2xxe", Series::kSk2xxe}};
  const auto series = kSeries.find(seriesName(group.get<std::string>("series", "sk5xxe", "a series")));
  if (series == kSeries.end()) {
    refuse(group.keyName("series"), group["series"], "sk1x0e, sk2xxe, sk300e, sk5xxe, sk54xe, sk700e or sk750e");
  }
  drive.device.series = series->second;
  drive.device.firmware = group.positive("firmware", drive.device.firmware);
}

DriveConfig readDrive(const std::string& name, const YAML::Node& node, const BusKind& bus,
                      std::vector<std::string>& warnings) {
  const std::string path = "drives/" + name;
  if (!isName(name)) refuse("drives", YAML::Node(name), "a name of letters, digits and _ that starts with a letter");
  const Group group(node, path);
  if (!group.has("address")) {
    throw ConfigError(path + "/address is missing; expected a whole number from " + std::to_string(bus.lowest_address) +
                      " to " + std::to_string(bus.highest_address));
  }

  DriveConfig drive;
  drive.name = name;
  drive.joint = group.get<std::string>("joint", "", "the name of a joint");
  drive.address =
      static_cast<std::uint8_t>(group.integer("address", bus.lowest_address, bus.lowest_address, bus.highest_address));
  readSeries(group, drive);
  drive.gear_ratio = group.positive("gear_ratio", 1.0);
  drive.inverted = group.get<bool>("inverted", false, "true or false");
  drive.motor.pole_pairs = group.integer("pole_pairs", drive.motor.pole_pairs, 1, 24);
  drive.motor.inertia = group.positive("inertia", drive.motor.inertia);
  drive.motor.rated_torque = group.positive("rated_torque", drive.motor.rated_torque);
  drive.motor.slip = group.positive("slip", drive.motor.slip);
  drive.motor.load = group.notNegative("load", drive.motor.load);
  drive.motor.viscous = group.notNegative("viscous", drive.motor.viscous);
  drive.inverter.charging_time = group.notNegative("charging_time", drive.inverter.charging_time);
  drive.inverter.automatic_acknowledgement_delay =
      group.notNegative("automatic_acknowledgement_delay", drive.inverter.automatic_acknowledgement_delay);
  drive.pkw.delay = static_cast<unsigned>(group.integer("parameter_delay", 1, 0, 1000));
  drive.pkw.ram_orders = group.get<bool>("ram_orders", true, "true or false");
  drive.pkw.double_word_answers = group.get<bool>("double_word_answers", true, "true or false");
  readPosicon(group, drive.inverter.posicon, warnings);
  bus.readDrive(group, drive);
  const ParameterStore catalogue{drive.device};
  if (group.has("max_frequency")) {
    readParameter(group.keyName("max_frequency"), "P105", group["max_frequency"], catalogue, kOfAnInverter,
                  drive.parameters);
  }
  readParameters(group, catalogue, kOfAnInverter, drive.parameters);
  warnOfUnknown(node, path, driveKeys(), warnings);
  return drive;
}

}  // namespace

SimConfig readSimConfig(const YAML::Node& configuration, const std::string& end_point) {
  YAML::Node node = configuration;
  const std::string chosen =
      !end_point.empty() ? end_point
                         : Group(node, "").get<std::string>("bus_end_point", "", "where the bus is",
                                                            [](const std::string& value) { return !value.empty(); });
  if (!chosen.empty()) {
    node.reset(YAML::Clone(configuration));  // an assignment would go through to the caller's
    node["bus"][busKindOf(node).end_point] = chosen;
  }
  const Group root(node, "");
  SimConfig config;
  const BusKind& bus = busKindOf(root);
  bus.readBus(root, config);
  if (!root.has("drives") || !node["drives"].IsMap() || node["drives"].size() == 0) {
    throw ConfigError("drives: nothing is configured; expected a group with at least one drive");
  }
  for (const auto& entry : node["drives"]) {
    config.drives.push_back(readDrive(entry.first.as<std::string>(), entry.second, bus, config.warnings));
  }
  bus.readModules(root, config);
  config.body = readBody(node, config.drives);
  return config;
}

YAML::Node mergeYaml(const YAML::Node& earlier, const YAML::Node& later) {
  if (!earlier.IsMap() || !later.IsMap()) return later.IsDefined() && !later.IsNull() ? later : earlier;
  YAML::Node merged = YAML::Clone(earlier);
  for (const auto& entry : later) {
    const std::string key = entry.first.as<std::string>();
    const YAML::Node before = earlier[key];
    merged[key] = before.IsDefined() ? mergeYaml(before, entry.second) : entry.second;
  }
  return merged;
}

}  // namespace nord_driver::sim

#include "sim/sim_config.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "sim/config_group.h"
#include "sim/inverter/parameter_store.h"

namespace nord_driver::sim {

namespace {

const char* const kOfAnInverter = "inverter; expected P102, P105, P513 ...";
const char* const kOfAModule = "module; expected P150, P151, P153, P154 or P160";

// What a drive may be called is what ROS lets a name be.
bool isName(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

/// "-0.1", not "-0.10000000000000001".
std::string inUnit(std::int32_t raw, const ParameterDefinition& definition) {
  std::ostringstream text;
  text << static_cast<double>(raw) / definition.divisor;
  return text.str();
}

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

/// The group `parameters`.
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

const std::vector<std::string>& driveKeys() {
  static const std::vector<std::string> keys{
      // the driver's
      "address", "series", "ppo_type", "joint", "gear_ratio", "pole_pairs", "inverted", "max_frequency",
      "rated_current", "allow_minimum_frequency", "module", "inverter", "io_byte", "connection", "profile",
      // the driver's on a CAN bus; those of the identity are the simulator's, too
      "array_sub_index", "boot_reset", "device_type", "error_control", "event_time", "guard_time", "heartbeat_time",
      "heartbeat_timeout", "inhibit_time", "life_time_factor", "parameter_servers", "pdo_mapping", "process_values",
      "product_code", "revision_number", "sdo_answer_id", "sdo_request_id", "sdo_timeout", "vendor_id", "watch_master",
      // the simulator's on a CAN bus
      "fixed_mapping", "sdo_servers_set", "serial_number",
      // the simulator's
      "inertia", "rated_torque", "slip", "load", "viscous", "charging_time", "firmware", "parameter_delay",
      "ram_orders", "double_word_answers", "automatic_acknowledgement_delay", "parameters"};
  return keys;
}

void readSeries(const Group& group, DriveConfig& drive) {
  static const std::map<std::string, Series> kSeries{{"sk300e", Series::kSk300e}, {"sk5xxe", Series::kSk5xxe},
                                                     {"sk54xe", Series::kSk54xe}, {"sk700e", Series::kSk700e},
                                                     {"sk750e", Series::kSk750e}, {"sk1x0e", Series::kSk1x0e},
                                                     {"sk2xxe", Series::kSk2xxe}};
  const auto series = kSeries.find(group.get<std::string>("series", "sk5xxe", "a series"));
  if (series == kSeries.end()) {
    refuse(group.keyName("series"), group["series"], "sk1x0e, sk2xxe, sk300e, sk5xxe, sk54xe, sk700e or sk750e");
  }
  drive.device.series = series->second;
  drive.device.firmware = group.positive("firmware", drive.device.firmware);
  drive.slave.swap_words_3_4 = drive.device.isOlderSeries();
}

// SK CU4 and SK TU4 have slots for four inverters, SK TU1, TU2 and TU3 sit on one; SK 1x0E and 2xxE have the former
// only (BU 2700 4.1).
void readModule(const Group& group, DriveConfig& drive) {
  const std::string fallback = drive.device.isDecentral() ? "sk_cu4" : "sk_tu3";
  const std::string module = group.get<std::string>("module", fallback, "a bus module");
  const bool slots = module == "sk_cu4" || module == "sk_tu4";
  const bool own = module == "sk_tu1" || module == "sk_tu2" || module == "sk_tu3";
  if (!slots && !own) refuse(group.keyName("module"), group["module"], "sk_cu4, sk_tu4, sk_tu1, sk_tu2 or sk_tu3");
  if (own && drive.device.isDecentral()) {
    refuse(group.keyName("module"), group["module"], "sk_cu4 or sk_tu4, the ones for this series");
  }
  if (slots && drive.device.isOlderSeries()) {
    refuse(group.keyName("module"), group["module"], "sk_tu1 or sk_tu2, the ones for this series");
  }
  if (slots) drive.place = static_cast<unsigned>(group.integer("inverter", 1, 1, 4));
}

/// The group `modules`: what a module with slots has that no drive has.
void readModules(const Group& root, SimConfig& config) {
  if (!root.has("modules")) return;
  if (!root["modules"].IsMap()) refuse("modules", root["modules"], "a group like {front: {address: 5}}");
  const ParameterStore catalogue{moduleParameterDefinitions()};
  for (const auto& entry : root["modules"]) {
    ModuleConfig module;
    module.name = entry.first.as<std::string>();
    const std::string path = "modules/" + module.name;
    const Group group(entry.second, path);
    module.settings.address = static_cast<std::uint8_t>(group.integer("address", 0, 0, 126));
    const bool used = std::any_of(config.drives.begin(), config.drives.end(), [&](const DriveConfig& drive) {
      return drive.place > 0 && drive.slave.address == module.settings.address;
    });
    if (!used) {
      throw ConfigError(path + "/address: " + std::to_string(module.settings.address) +
                        " is not valid; expected the address of a drive behind an sk_cu4 or sk_tu4");
    }
    module.settings.io_byte = group.get<bool>("io_byte", false, "true or false");
    module.settings.inputs = static_cast<std::uint8_t>(group.integer("inputs", 0, 0, 15));
    RecordSettings& records = module.settings.records;
    records.polls = static_cast<unsigned>(group.integer("record_polls", 1, 0, 10000));
    records.busy = static_cast<unsigned>(group.integer("record_busy", 0, 0, 10000));
    records.by_slot = group.get<bool>("record_by_slot", false, "true or false");
    records.plain_numbers = group.get<bool>("record_plain_numbers", false, "true or false");
    readParameters(group, catalogue, kOfAModule, module.parameters);
    warnOfUnknown(entry.second, path,
                  {"address", "io_byte", "inputs", "record_polls", "record_busy", "record_by_slot",
                   "record_plain_numbers", "parameters"},
                  config.warnings);
    config.modules.push_back(module);
  }
}

/// `io_byte` of a drive is that of its module.
void takeIoByte(const Group& group, const DriveConfig& drive, SimConfig& config) {
  if (drive.place == 0 || !group.get<bool>("io_byte", false, "true or false")) return;
  for (ModuleConfig& module : config.modules) {
    if (module.settings.address != drive.slave.address) continue;
    module.settings.io_byte = true;
    return;
  }
  ModuleConfig module;
  module.settings.address = drive.slave.address;
  module.settings.io_byte = true;
  config.modules.push_back(module);
}

DriveConfig readDrive(const std::string& name, const YAML::Node& node, bool on_can,
                      std::vector<std::string>& warnings) {
  const std::string path = "drives/" + name;
  if (!isName(name)) refuse("drives", YAML::Node(name), "a name of letters, digits and _ that starts with a letter");
  const Group group(node, path);
  if (!group.has("address"))
    throw ConfigError(path + "/address is missing; expected a whole number from 1 to " + (on_can ? "127" : "126"));

  DriveConfig drive;
  drive.name = name;
  drive.joint = group.get<std::string>("joint", "", "the name of a joint");
  drive.slave.address = static_cast<std::uint8_t>(group.integer("address", 0, 1, on_can ? 127 : 126));
  drive.slave.ppo_type = group.integer("ppo_type", 1, 1, 4);
  readSeries(group, drive);
  if (on_can) {
    readCanDrive(group, drive);
  } else {
    readModule(group, drive);
  }
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
  drive.pkw.double_word_answers =
      group.get<bool>("double_word_answers", true, "true or false") || drive.slave.ppo_type == 2;
  const ParameterStore catalogue{drive.device};
  if (group.has("max_frequency")) {
    readParameter(group.keyName("max_frequency"), "P105", group["max_frequency"], catalogue, kOfAnInverter,
                  drive.parameters);
  }
  readParameters(group, catalogue, kOfAnInverter, drive.parameters);
  warnOfUnknown(node, path, driveKeys(), warnings);
  return drive;
}

/// The drives whose name (or joint) is listed.
std::vector<std::size_t> members(const Group& group, const std::string& key, const std::vector<DriveConfig>& drives,
                                 bool by_joint) {
  std::vector<std::size_t> found;
  for (const std::string& wanted : group.texts(key)) {
    const auto match = std::find_if(drives.begin(), drives.end(), [&](const DriveConfig& drive) {
      return (by_joint ? drive.joint : drive.name) == wanted;
    });
    if (match == drives.end()) {
      refuse(group.keyName(key), YAML::Node(wanted), by_joint ? "the joint of a drive" : "the name of a drive");
    }
    found.push_back(static_cast<std::size_t>(match - drives.begin()));
  }
  if (found.empty()) refuse(group.keyName(key), group[key], "at least one name");
  return found;
}

std::optional<BodyConfig> readBody(const Group& root, const YAML::Node& node, const std::vector<DriveConfig>& drives) {
  const bool own = root.has("body");
  const Group group = own ? Group(node["body"], "body") : root;
  const char* left = own ? "left" : "left_wheel";
  const char* right = own ? "right" : "right_wheel";
  BodyConfig body;
  const char* kind = own ? "kind" : "base_type";
  const std::string name = group.get<std::string>(kind, "differential", "differential or mecanum");
  if (name == "mecanum") {
    body.kind = BodyKind::kMecanum;
  } else if (name != "differential") {
    refuse(group.keyName(kind), group[kind], "differential or mecanum");
  }
  std::vector<const char*> needed{left, right, "wheel_radius", "wheel_separation"};
  if (body.kind == BodyKind::kMecanum) needed.push_back("wheel_base");
  for (const char* key : needed) {
    if (group.has(key)) continue;
    if (!own) return std::nullopt;
    throw ConfigError(group.keyName(key) +
                      " is missing; a body has left, right, wheel_radius, wheel_separation, of the kind mecanum "
                      "wheel_base, too");
  }
  body.left = members(group, left, drives, !own);
  body.right = members(group, right, drives, !own);
  body.wheel_radius = group.positive("wheel_radius", 0.0);
  body.wheel_separation = group.positive("wheel_separation", 0.0);
  if (body.kind == BodyKind::kMecanum) {
    body.wheel_base = group.positive("wheel_base", 0.0);
    if (body.left.size() != 2) refuse(group.keyName(left), group[left], "two of them, the front one first");
    if (body.right.size() != 2) refuse(group.keyName(right), group[right], "two of them, the front one first");
  }
  return body;
}

}  // namespace

SimConfig readSimConfig(const YAML::Node& node) {
  const Group root(node, "");
  SimConfig config;
  config.can = readCanBus(root);
  if (root.has("bus") && !config.can) {
    const Group bus(node["bus"], "bus");
    config.device = bus.get<std::string>("device", config.device, "the path of the link to create",
                                         [](const std::string& path) { return !path.empty(); });
    config.baud_rate =
        static_cast<std::uint32_t>(bus.integer("baud_rate", static_cast<int>(config.baud_rate), 9600, 12000000));
  }
  if (root.has("bus_end_point")) {
    *config.endPoint().value = root.get<std::string>("bus_end_point", "", "where the bus is",
                                                     [](const std::string& value) { return !value.empty(); });
  }
  if (!root.has("drives") || !node["drives"].IsMap() || node["drives"].size() == 0) {
    throw ConfigError("drives: nothing is configured; expected a group with at least one drive");
  }
  for (const auto& entry : node["drives"]) {
    config.drives.push_back(
        readDrive(entry.first.as<std::string>(), entry.second, config.can.has_value(), config.warnings));
    const DriveConfig& added = config.drives.back();
    if (config.can) continue;
    for (std::size_t i = 0; i + 1 < config.drives.size(); ++i) {
      const DriveConfig& other = config.drives[i];
      if (other.slave.address != added.slave.address) continue;
      const std::string path = "drives/" + added.name;
      if (other.place == 0 || added.place == 0) {
        refuse(path + "/address", entry.second["address"], "an address of its own; drive " + other.name + " has it");
      }
      if (other.place == added.place) {
        throw ConfigError(path + "/inverter: " + std::to_string(added.place) +
                          " is not valid; expected another one, drive " + other.name + " has it behind this module");
      }
    }
  }
  if (config.can) checkCanNodes(config.drives);
  readModules(root, config);
  for (std::size_t i = 0; i < config.drives.size(); ++i) {
    const std::string& name = config.drives[i].name;
    takeIoByte(Group(node["drives"][name], "drives/" + name), config.drives[i], config);
  }
  config.body = readBody(root, node, config.drives);
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

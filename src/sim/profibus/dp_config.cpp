#include "sim/profibus/dp_config.h"

#include <algorithm>

#include "sim/bus_kind.h"
#include "sim/config_parameters.h"
#include "sim/module_parameters.h"
#include "sim/profibus/pty_bus.h"

namespace nord_driver::sim {

namespace {

const char* const kOfAModule = "module; expected P150, P151, P153, P154 or P160";

void readBus(const Group& root, SimConfig& config) {
  DpBusConfig settings;
  const Group bus(root.has("bus") ? root["bus"] : YAML::Node{}, "bus");
  if (bus.has("interface")) {
    throw ConfigError("bus/interface: " + bus.get<std::string>("interface", "", "the name of a CAN interface") +
                      " needs a CAN transport; expected transport: canopen, or bus/device");
  }
  settings.device = bus.get<std::string>("device", settings.device, "the path of the link to create",
                                         [](const std::string& path) { return !path.empty(); });
  settings.baud_rate =
      static_cast<std::uint32_t>(bus.integer("baud_rate", static_cast<int>(settings.baud_rate), 9600, 12000000));
  config.bus = settings;
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
void readSlots(const Group& root, SimConfig& config) {
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
      return drive.place > 0 && drive.address == module.settings.address;
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
    module.settings.class2.connections = static_cast<unsigned>(group.integer("class2_connections", 3, 0, 3));
    readParameters(group, catalogue, kOfAModule, module.parameters);
    warnOfUnknown(entry.second, path,
                  {"address", "io_byte", "inputs", "record_polls", "record_busy", "record_by_slot",
                   "record_plain_numbers", "class2_connections", "parameters"},
                  config.warnings);
    config.bus.as<DpBusConfig>().modules.push_back(module);
  }
}

/// `io_byte` of a drive is that of its module.
void takeIoByte(const Group& group, const DriveConfig& drive, SimConfig& config) {
  if (drive.place == 0 || !group.get<bool>("io_byte", false, "true or false")) return;
  std::vector<ModuleConfig>& modules = config.bus.as<DpBusConfig>().modules;
  for (ModuleConfig& module : modules) {
    if (module.settings.address != drive.address) continue;
    module.settings.io_byte = true;
    return;
  }
  ModuleConfig module;
  module.settings.address = drive.address;
  module.settings.io_byte = true;
  modules.push_back(module);
}

void readDrive(const Group& group, DriveConfig& drive) {
  DpDriveConfig settings;
  settings.ppo_type = group.integer("ppo_type", 1, 1, 4);
  if (settings.ppo_type == 2) drive.pkw.double_word_answers = true;
  readModule(group, drive);
  drive.bus = settings;
}

/// One station for each drive, or a place of its own behind a module.
void checkAddresses(const std::vector<DriveConfig>& drives) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (drives[k].address != drives[i].address) continue;
      const std::string path = "drives/" + drives[i].name;
      if (drives[k].place == 0 || drives[i].place == 0) {
        throw ConfigError(path + "/address: " + std::to_string(drives[i].address) +
                          " is not valid; expected an address of its own; drive " + drives[k].name + " has it");
      }
      if (drives[k].place == drives[i].place) {
        throw ConfigError(path + "/inverter: " + std::to_string(drives[i].place) +
                          " is not valid; expected another one, drive " + drives[k].name +
                          " has it behind this module");
      }
    }
  }
}

void readModules(const Group& root, SimConfig& config) {
  checkAddresses(config.drives);
  readSlots(root, config);
  for (const DriveConfig& drive : config.drives) {
    takeIoByte(Group(root["drives"][drive.name], "drives/" + drive.name), drive, config);
  }
}

std::unique_ptr<RunningBus> run(const SimConfig& config) {
  return std::make_unique<PtyBus>(config, config.bus.as<DpBusConfig>().device);
}

}  // namespace

BusKind profibusKind() {
  BusKind kind;
  kind.transport = "profibus_dp";
  kind.settings = &typeid(DpBusConfig);
  kind.end_point = "device";
  kind.place = "/tmp/nord_sim_bus";
  kind.highest_address = 126;
  kind.keys = {"ppo_type", "module", "io_byte", "gsd", "user_parameters"};
  kind.readBus = readBus;
  kind.readDrive = readDrive;
  kind.readModules = readModules;
  kind.run = run;
  return kind;
}

}  // namespace nord_driver::sim

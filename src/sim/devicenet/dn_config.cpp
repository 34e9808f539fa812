#include "sim/devicenet/dn_config.h"

#include <algorithm>

#include "sim/bus_kind.h"
#include "sim/config_parameters.h"
#include "sim/devicenet/dn_bus_thread.h"
#include "sim/devicenet/dn_layout.h"
#include "sim/module_parameters.h"

namespace nord_driver::sim {

namespace {

const char* const kOfAModule = "module; expected P150, P151 or P160 to P165";

// P509: BU 0020 6.2.2 has DeviceNet under 7. The list of the older series is printed with its PROFIBUS and InterBus
// values only (8-10 and 12-14); by its order the full DeviceNet control would be 20. Behind SK CU4 and TU4 it is the
// system bus (BU 0280 5.1.3).
constexpr std::int32_t kDeviceNet = 7;
constexpr std::int32_t kDeviceNetOlderSeries = 20;
constexpr std::int32_t kSystemBus = 3;
constexpr std::int32_t kSystemBusOfSk5xxe = 6;

constexpr int kHighestMac = 63;
constexpr int kVariable = 120;

void readBus(const Group& root, SimConfig& simulated) {
  const Group bus(root.has("bus") ? root["bus"] : YAML::Node{}, "bus");
  DnBusConfig config;
  config.interface = bus.get<std::string>("interface", config.interface, "can0, vcan0 or virtual:NAME",
                                          [](const std::string& name) { return !name.empty(); });
  config.bit_rate =
      static_cast<std::uint32_t>(bus.get<int>("bit_rate", 500'000, "125000, 250000 or 500000", [](const int& rate) {
        return rate == 125'000 || rate == 250'000 || rate == 500'000;
      }));
  simulated.bus = config;
}

DnModuleKind readKind(const Group& group, const Device& device) {
  const std::string fallback = device.isDecentral() ? "sk_cu4" : "sk_tu3";
  const std::string module = group.get<std::string>("module", fallback, "a bus module");
  const bool gateway = module == "sk_cu4" || module == "sk_tu4";
  const bool own = module == "sk_tu1" || module == "sk_tu2" || module == "sk_tu3";
  if (!gateway && !own) refuse(group.keyName("module"), group["module"], "sk_cu4, sk_tu4, sk_tu1, sk_tu2 or sk_tu3");
  if (own && device.isDecentral()) {
    refuse(group.keyName("module"), group["module"], "sk_cu4 or sk_tu4, the ones for this series");
  }
  if (gateway && device.isOlderSeries()) {
    refuse(group.keyName("module"), group["module"], "sk_tu1 or sk_tu2, the ones for this series");
  }
  return gateway ? DnModuleKind::kGateway : DnModuleKind::kOnInverter;
}

void readAssembly(const Group& group, DnDriveConfig& dn) {
  const int assembly = group.get<int>("assembly", 100, "20, 21, 100, 101, 102 or 120", [](const int& value) {
    return dnSelectionOfInstance(static_cast<unsigned>(value)) >= 0;
  });
  const bool gateway_only = assembly == 102 || assembly == kVariable;
  if (gateway_only && dn.kind == DnModuleKind::kOnInverter) {
    refuse(group.keyName("assembly"), group["assembly"], "20, 21, 100 or 101: this module has one inverter (P507)");
  }
  dn.assembly = static_cast<unsigned>(assembly);
  dn.assembly_given = group.has("assembly");
  dn.control_bytes = static_cast<unsigned>(group.integer("control_bytes", 4, 0, 8));
  dn.status_bytes = static_cast<unsigned>(group.integer("status_bytes", 4, 0, 8));
  dn.module_input_bytes = static_cast<unsigned>(group.integer("module_input_bytes", 0, 0, 1));
  dn.module_output_bytes = static_cast<unsigned>(group.integer("module_output_bytes", 0, 0, 1));
  const std::string profile = group.get<std::string>("profile", "nord", "nord, ac_drive or ac_drive_extended");
  if (profile != "nord" && profile != "ac_drive" && profile != "ac_drive_extended") {
    refuse(group.keyName("profile"), group["profile"], "nord, ac_drive or ac_drive_extended");
  }
  dn.profile = profile == "nord" ? 2 : profile == "ac_drive" ? 0 : 1;
}

std::optional<std::uint16_t> readWord(const Group& group, const char* key) {
  if (!group.has(key)) return std::nullopt;
  return static_cast<std::uint16_t>(group.integer(key, 0, 0, 0xFFFF));
}

DnGivenIdentity readIdentity(const Group& group) {
  return {readWord(group, "vendor_id"), readWord(group, "device_type"), readWord(group, "product_code")};
}

void readDrive(const Group& group, DriveConfig& drive) {
  DnDriveConfig dn;
  dn.identity = readIdentity(group);
  dn.kind = readKind(group, drive.device);
  if (dn.kind == DnModuleKind::kGateway) {
    drive.place = static_cast<unsigned>(group.integer("inverter", 1, 1, 4));
  } else if (group.integer("inverter", 1, 1, 4) != 1) {
    refuse(group.keyName("inverter"), group["inverter"], "1: only an sk_cu4 or sk_tu4 has more than one");
  }
  readAssembly(group, dn);
  const std::string order = group.get<std::string>("value_order", "by_series", "by_series or in_order");
  if (order != "by_series" && order != "in_order") {
    refuse(group.keyName("value_order"), group["value_order"], "by_series or in_order");
  }
  dn.values_in_order = order == "in_order";
  drive.bus = dn;
}

/// Any drive of a module says it for those that do not, as the driver has it.
void shareAssemblies(std::vector<DriveConfig>& drives) {
  for (DriveConfig& drive : drives) {
    DnDriveConfig& own = drive.bus.as<DnDriveConfig>();
    for (const DriveConfig& other : drives) {
      const DnDriveConfig& others = other.bus.as<DnDriveConfig>();
      if (!own.assembly_given && others.assembly_given && other.address == drive.address)
        own.assembly = others.assembly;
    }
  }
}

/// One module for each drive, or a place of its own behind one.
void checkPlaces(const std::vector<DriveConfig>& drives) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::string path = "drives/" + drives[i].name;
    for (std::size_t k = 0; k < i; ++k) {
      if (drives[k].address != drives[i].address) continue;
      if (drives[k].place == 0 || drives[i].place == 0) {
        throw ConfigError(path + "/address: " + std::to_string(drives[i].address) +
                          " is not valid; expected a MAC id of its own, drive " + drives[k].name + " has it");
      }
      if (drives[k].place == drives[i].place) {
        throw ConfigError(path + "/inverter: " + std::to_string(drives[i].place) +
                          " is not valid; expected another one, drive " + drives[k].name +
                          " has it behind this module");
      }
      const unsigned of_the_other = drives[k].bus.as<DnDriveConfig>().assembly;
      const unsigned own = drives[i].bus.as<DnDriveConfig>().assembly;
      if (own != of_the_other) {
        throw ConfigError(path + "/assembly: " + std::to_string(own) + " is not valid; expected " +
                          std::to_string(of_the_other) + ", the one of drive " + drives[k].name +
                          " behind the same module (P160)");
      }
    }
  }
}

DnModuleSettings readModule(const Group& group, const ParameterStore& catalogue) {
  DnModuleSettings settings;
  settings.mac = static_cast<std::uint8_t>(group.integer("address", 0, 0, kHighestMac));
  settings.name = group.get<std::string>("product_name", "SK TU4-DEV", "a text of at most 32 letters",
                                         [](const std::string& name) { return !name.empty() && name.size() <= 32; });
  settings.inputs = static_cast<std::uint8_t>(group.integer("inputs", 0, 0, 15));
  settings.packet_rate_steps = static_cast<unsigned>(group.integer("packet_rate_steps", 10, 1, 1000));
  settings.cos_instance_4_alone = group.get<bool>("cos_instance_4_alone", false, "true or false");
  settings.given = readIdentity(group);
  settings.identity.serial = group.get<std::uint32_t>("serial_number", settings.identity.serial, "a number of 32 bits");
  if (group.get<bool>("io_byte", false, "true or false")) {
    settings.parameters.push_back({161, 0, 0, 1});
    settings.parameters.push_back({161, 0, 1, 1});
  }
  readParameters(group, catalogue, kOfAModule, settings.parameters);
  return settings;
}

void readModules(const Group& root, SimConfig& config) {
  shareAssemblies(config.drives);
  checkPlaces(config.drives);
  if (!root.has("modules")) return;
  if (!root["modules"].IsMap()) refuse("modules", root["modules"], "a group like {front: {address: 5}}");
  const ParameterStore catalogue{dnModuleParameterDefinitions()};
  for (const auto& entry : root["modules"]) {
    const std::string path = "modules/" + entry.first.as<std::string>();
    const Group group(entry.second, path);
    const DnModuleSettings settings = readModule(group, catalogue);
    const bool used = std::any_of(config.drives.begin(), config.drives.end(),
                                  [&](const DriveConfig& drive) { return drive.address == settings.mac; });
    if (!used) refuse(group.keyName("address"), group["address"], "the address of a drive");
    warnOfUnknown(entry.second, path,
                  {"address", "product_name", "inputs", "packet_rate_steps", "vendor_id", "device_type", "product_code",
                   "serial_number", "io_byte", "cos_instance_4_alone", "parameters"},
                  config.warnings);
    config.bus.as<DnBusConfig>().modules.push_back(settings);
  }
}

std::unique_ptr<RunningBus> run(const SimConfig& config) {
  return std::make_unique<DnBusThread>(config);
}

}  // namespace

// "The division to the process data words PZD3 and PZD4 depends on the inverter series": BU 0020 7.3.6, BU 0070 6.1.5.
bool dnThirdBeforeSecond(const DriveConfig& drive) noexcept {
  return drive.device.isOlderSeries() && !drive.bus.as<DnDriveConfig>().values_in_order;
}

BusWiring dnWiring(const DriveConfig& drive) {
  BusWiring wiring;
  wiring.on_system_bus = drive.bus.as<DnDriveConfig>().kind == DnModuleKind::kGateway;
  // The two words behind the control word in one, the low word first (BU 0280 4.2.1.1).
  wiring.wide = {dnThirdBeforeSecond(drive) ? 2u : 1u, 0};
  if (wiring.on_system_bus) {
    wiring.source = drive.device.isDecentral() ? kSystemBus : kSystemBusOfSk5xxe;
  } else {
    wiring.source = drive.device.isOlderSeries() ? kDeviceNetOlderSeries : kDeviceNet;
  }
  return wiring;
}

// The general ones are those of the sister module for PROFIBUS.
std::vector<ParameterDefinition> dnModuleParameterDefinitions() {
  std::vector<ParameterDefinition> all = moduleParameterDefinitions();
  const auto is_of_profibus = [](const ParameterDefinition& d) {
    return d.number == 153 || d.number == 154 || d.number == 160 || d.number >= 180;
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_of_profibus), all.end());
  for (ParameterDefinition& definition : all) {
    if (definition.number == 151) definition.minimum = 0;  // no -1 (BU 0280 5.2.1)
  }
  constexpr bool kReadOnly = true;
  const std::vector<ParameterDefinition> own{
      // number, name, divisor, min, max, factory, per set, elements, read only
      {160, "Assembly selection", 1, 0, 5, 3, false, 0, false},
      {161, "Config. process data for the bus module", 1, 0, 1, 0, false, 2, false},
      {162, "Configuration of FI process data", 1, 0, 8, 0, false, 3, false},
      {163, "Configuration of FI 2 process data", 1, 0, 8, 0, false, 3, false},
      {164, "Configuration of FI 3 process data", 1, 0, 8, 0, false, 3, false},
      {165, "Configuration of FI 4 process data", 1, 0, 8, 0, false, 3, false},
      {180, "DeviceNet address", 1, 0, 63, 0, false, 0, kReadOnly},
      {181, "DeviceNet baud rate", 1, 0, 2, 0, false, 0, kReadOnly},
  };
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

BusKind devicenetKind() {
  BusKind kind;
  kind.transport = "devicenet";
  kind.settings = &typeid(DnBusConfig);
  kind.end_point = "interface";
  kind.place = "virtual:nord_sim";
  kind.lowest_address = 0;
  kind.highest_address = kHighestMac;
  kind.keys = {// the driver's
               "io", "assembly", "control_bytes", "status_bytes", "profile", "module_input_bytes",
               "module_output_bytes", "parameter_objects", "value_order", "vendor_id", "device_type", "product_code",
               "eds",
               // the simulator's
               "module"};
  kind.readBus = readBus;
  kind.readDrive = readDrive;
  kind.readModules = readModules;
  kind.run = run;
  return kind;
}

}  // namespace nord_driver::sim

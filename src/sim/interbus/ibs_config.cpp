#include "sim/interbus/ibs_config.h"

#include "sim/bus_kind.h"
#include "sim/config_parameters.h"
#include "sim/interbus/gateway_bus.h"

namespace nord_driver::sim {

namespace {

constexpr int kLastRegister = 65535;

Group groupAt(const Group& group, const std::string& key) {
  return {group.has(key) ? group[key] : YAML::Node{}, group.keyName(key)};
}

unsigned registerAt(const Group& group, const std::string& key) {
  return static_cast<unsigned>(group.integer(key, 0, 0, kLastRegister));
}

bool chooses(const Group& group, const std::string& key, const std::string& no, const std::string& yes) {
  const std::string expected = no + " or " + yes;
  const std::string word = group.get<std::string>(key, no, expected);
  if (word != no && word != yes) refuse(group.keyName(key), group[key], expected);
  return word == yes;
}

// The places of the fields are the defaults of the driver's.
IbsPcp readPcp(const Group& pcp) {
  IbsPcp settings;
  settings.invoke_address = registerAt(groupAt(pcp, "invoke"), "address");
  settings.result_address = registerAt(groupAt(pcp, "result"), "address");
  settings.first_reference = static_cast<unsigned>(pcp.integer("first_reference", 2, 2, 127));
  settings.initiate = pcp.get<bool>("initiate", true, "true or false");
  return settings;
}

void readBus(const Group& root, SimConfig& config) {
  IbsBusConfig settings;
  const Group bus = groupAt(root, "bus");
  settings.gateway = bus.get<std::string>("gateway", settings.gateway, "127.0.0.1:PORT");
  gatewayPort(settings.gateway);
  settings.unit = static_cast<unsigned>(bus.integer("unit", 1, 0, 255));
  settings.input_address = registerAt(groupAt(bus, "inputs"), "address");
  settings.output_address = registerAt(groupAt(bus, "outputs"), "address");
  settings.swapped = chooses(bus, "word_order", "as_is", "swapped");
  settings.pcp_word = bus.get<bool>("pcp_word", false, "true or false");
  if (bus.has("running")) {
    const Group running = groupAt(bus, "running");
    IbsRunning flag;
    flag.address = registerAt(running, "address");
    flag.mask = static_cast<Word>(running.integer("mask", 1, 1, 0xFFFF));
    flag.value = static_cast<Word>(running.integer("value", flag.mask, 0, 0xFFFF));
    settings.running = flag;
  }
  if (bus.has("watchdog")) settings.watchdog = registerAt(groupAt(bus, "watchdog"), "address");
  if (bus.has("pcp")) settings.pcp = readPcp(groupAt(bus, "pcp"));
  config.bus = settings;
}

std::optional<unsigned> readOffset(const Group& group, const std::string& key) {
  if (!group.has(key)) return std::nullopt;
  return static_cast<unsigned>(group.integer(key, 0, 0, 255));
}

void readDrive(const Group& group, DriveConfig& drive) {
  if (drive.device.isDecentral()) refuse(group.keyName("series"), group["series"], "one that takes SK TU1/2/3-IBS");
  IbsDriveConfig settings;
  settings.ppo_type = static_cast<unsigned>(group.integer("ppo_type", 1, 1, 2));
  settings.drivecom = chooses(group, "profile", "nord", "drivecom");
  settings.array_sub_by_table = chooses(group, "array_sub_index", "element", "table");
  settings.input_offset = readOffset(group, "input_offset");
  settings.output_offset = readOffset(group, "output_offset");
  drive.bus = settings;
}

void checkPlaces(const Group& /*root*/, SimConfig& config) {
  const std::vector<DriveConfig>& drives = config.drives;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (drives[k].address != drives[i].address) continue;
      throw ConfigError("drives/" + drives[i].name + "/address: " + std::to_string(drives[i].address) +
                        " is not valid; expected a place of its own in the ring, drive " + drives[k].name + " has it");
    }
  }
}

std::unique_ptr<RunningBus> run(const SimConfig& config) {
  return std::make_unique<GatewayBus>(config);
}

}  // namespace

std::uint16_t gatewayPort(const std::string& gateway) {
  const std::size_t colon = gateway.find(':');
  const std::string host = gateway.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : gateway.substr(colon + 1);
  const bool is_number = !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
  if ((host == "127.0.0.1" || host == "localhost") && is_number && std::stoi(port) <= kLastRegister) {
    return static_cast<std::uint16_t>(std::stoi(port));
  }
  throw ConfigError("bus/gateway: " + gateway +
                    " is not valid; expected 127.0.0.1:PORT, the simulated gateway is on this computer only");
}

BusKind interbusKind() {
  BusKind kind;
  kind.transport = "interbus";
  kind.settings = &typeid(IbsBusConfig);
  kind.end_point = "gateway";
  kind.place = "127.0.0.1:15020";
  kind.highest_address = 254;
  kind.keys = {"ppo_type", "profile", "input_offset", "output_offset", "array_sub_index", "communication_reference"};
  kind.readBus = readBus;
  kind.readDrive = readDrive;
  kind.readModules = checkPlaces;
  kind.run = run;
  return kind;
}

}  // namespace nord_driver::sim

#include "sim/canopen/can_config.h"

#include <algorithm>
#include <array>
#include <map>

#include "sim/bus_kind.h"
#include "sim/canopen/can_bus_thread.h"

namespace nord_driver::sim {

namespace {

// P509, CANopen: BU 0020 6.2.2. The list of the older series is printed with its PROFIBUS and InterBus values only
// (8-10 and 12-14); by their order the full CANopen control would be 17.
constexpr std::int32_t kCanopen = 6;
constexpr std::int32_t kCanopenOlderSeries = 17;
constexpr std::int32_t kSystemBus = 3;  // SK 1x0E and 2xxE: BU 0280

// P514: BU 0280; 800 kbit/s is not among them.
constexpr std::array<unsigned, 8> kBitRates{10'000, 20'000, 50'000, 100'000, 125'000, 250'000, 500'000, 1'000'000};

CanConnection readConnection(const Group& group, const Device& device) {
  static const std::map<std::string, CanConnection> kConnections{{"option", CanConnection::kOption},
                                                                 {"onboard", CanConnection::kOnboard},
                                                                 {"gateway", CanConnection::kGateway},
                                                                 {"system_bus", CanConnection::kSystemBus}};
  const auto found = kConnections.find(group.get<std::string>("connection", "option", "a connection"));
  if (found == kConnections.end()) {
    refuse(group.keyName("connection"), group["connection"], "option, onboard, gateway or system_bus");
  }
  const CanConnection connection = found->second;
  const bool own_port = device.series == Series::kSk5xxe || device.series == Series::kSk54xe;
  if (connection == CanConnection::kOption && device.isDecentral()) {
    throw ConfigError(group.keyName("connection") +
                      ": option is not valid; expected gateway or system_bus, the ones for this series");
  }
  if (connection == CanConnection::kOnboard && !own_port) {
    refuse(group.keyName("connection"), group["connection"], "a series with a CAN port: sk5xxe or sk54xe");
  }
  const bool on_system_bus = connection == CanConnection::kGateway || connection == CanConnection::kSystemBus;
  if (on_system_bus && device.isOlderSeries()) {
    refuse(group.keyName("connection"), group["connection"], "option, the one for this series");
  }
  return connection;
}

void readBus(const Group& root, SimConfig& simulated) {
  const Group bus(root.has("bus") ? root["bus"] : YAML::Node{}, "bus");
  CanBusConfig config;
  config.interface = bus.get<std::string>("interface", config.interface, "can0, vcan0 or virtual:NAME",
                                          [](const std::string& name) { return !name.empty(); });
  config.bit_rate = static_cast<std::uint32_t>(bus.get<int>(
      "bit_rate", 250'000, "10000, 20000, 50000, 100000, 125000, 250000, 500000 or 1000000 (P514)",
      [](const int& rate) {
        return std::find(kBitRates.begin(), kBitRates.end(), static_cast<unsigned>(rate)) != kBitRates.end();
      }));
  simulated.bus = config;
}

/// What is not given stays.
void readIdentity(const Group& group, CanDriveConfig& can) {
  can.identity.vendor = group.get<std::uint32_t>("vendor_id", can.identity.vendor, "a number of 32 bits");
  can.identity.product = group.get<std::uint32_t>("product_code", can.identity.product, "a number of 32 bits");
  can.identity.revision = group.get<std::uint32_t>("revision_number", can.identity.revision, "a number of 32 bits");
  can.identity.serial = group.get<std::uint32_t>("serial_number", can.identity.serial, "a number of 32 bits");
  if (group.has("device_type")) can.device_type = group.get<std::uint32_t>("device_type", 0, "a number of 32 bits");
}

void readDrive(const Group& group, DriveConfig& drive) {
  CanDriveConfig can;
  can.connection = readConnection(group, drive.device);
  if (can.connection == CanConnection::kGateway) {
    drive.place = static_cast<unsigned>(group.integer("inverter", 1, 1, 4));
  } else if (group.integer("inverter", 1, 1, 4) != 1) {
    refuse(group.keyName("inverter"), group["inverter"], "1: only a gateway has more than one");
  }
  const std::string profile = group.get<std::string>("profile", "nord", "nord or cia402");
  if (profile != "nord" && profile != "cia402") refuse(group.keyName("profile"), group["profile"], "nord or cia402");
  can.cia402 = profile == "cia402";
  // Not on the inverter's own port (BU 0060 p. 57); of the gateway no source prints the objects.
  if (can.cia402 && can.connection != CanConnection::kOption) {
    refuse(group.keyName("profile"), group["profile"],
           std::string("nord: the connection ") + toString(can.connection) + " is simulated without a drive profile");
  }
  can.fixed_mapping = group.get<bool>("fixed_mapping", false, "true or false");
  const std::string sub_index = group.get<std::string>("array_sub_index", "element", "element or table");
  if (sub_index != "element" && sub_index != "table") {
    refuse(group.keyName("array_sub_index"), group["array_sub_index"], "element or table");
  }
  can.array_sub_by_table = sub_index == "table";
  can.servers_set = group.get<bool>("sdo_servers_set", false, "true or false");
  can.identity.product = static_cast<std::uint32_t>(can.connection) + 1;
  can.identity.serial = drive.address;
  readIdentity(group, can);
  drive.bus = can;
}

bool behindGateway(const DriveConfig& drive) {
  return drive.bus.as<CanDriveConfig>().connection == CanConnection::kGateway;
}

/// One node for each drive, or a place of its own behind a gateway.
void checkNodes(const std::vector<DriveConfig>& drives) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (drives[k].address != drives[i].address) continue;
      const std::string path = "drives/" + drives[i].name;
      if (!behindGateway(drives[k]) || !behindGateway(drives[i])) {
        throw ConfigError(path + "/address: " + std::to_string(drives[i].address) +
                          " is not valid; expected a node id of its own, drive " + drives[k].name + " has it");
      }
      if (drives[k].place == drives[i].place) {
        throw ConfigError(path + "/inverter: " + std::to_string(drives[i].place) +
                          " is not valid; expected another one, drive " + drives[k].name +
                          " has it behind this gateway");
      }
    }
  }
}

/// Any drive behind a node says who it is for those that do not, as the driver has it; of several the first.
void shareIdentities(const Group& root, std::vector<DriveConfig>& drives) {
  for (DriveConfig& drive : drives) {
    for (auto other = drives.rbegin(); other != drives.rend(); ++other) {
      if (other->address != drive.address) continue;
      const Group group(root["drives"][other->name], "drives/" + other->name);
      readIdentity(group, drive.bus.as<CanDriveConfig>());
    }
  }
}

void readNodes(const Group& root, SimConfig& config) {
  checkNodes(config.drives);
  shareIdentities(root, config.drives);
}

std::unique_ptr<RunningBus> run(const SimConfig& config) {
  return std::make_unique<CanBusThread>(config);
}

}  // namespace

BusWiring canWiring(CanConnection connection, const Device& device) {
  BusWiring wiring;
  wiring.source = device.isOlderSeries() ? kCanopenOlderSeries : device.isDecentral() ? kSystemBus : kCanopen;
  wiring.on_system_bus = connection == CanConnection::kGateway;
  wiring.wide = {2, 0};  // 32 bits in words 2 and 3 of the PDO, the low word first (BU 0060 p. 59)
  if (connection != CanConnection::kGateway) {
    wiring.master_lost_fault = fault::kBusTimeout;
    wiring.timeout_fault = fault::kBusTimeout;
  }
  return wiring;
}

BusKind canopenKind() {
  BusKind kind;
  kind.transport = "canopen";
  kind.settings = &typeid(CanBusConfig);
  kind.end_point = "interface";
  kind.place = "virtual:nord_sim";
  kind.keys = {// the driver's; those of the identity are the simulator's, too
               "connection", "profile", "array_sub_index", "boot_reset", "device_type", "error_control", "event_time",
               "guard_time", "heartbeat_time", "heartbeat_timeout", "inhibit_time", "life_time_factor",
               "parameter_servers", "pdo_mapping", "process_values", "product_code", "revision_number", "sdo_answer_id",
               "sdo_request_id", "sdo_timeout", "vendor_id", "watch_master",
               // the simulator's
               "fixed_mapping", "sdo_servers_set", "serial_number"};
  kind.readBus = readBus;
  kind.readDrive = readDrive;
  kind.readModules = readNodes;
  kind.run = run;
  return kind;
}

}  // namespace nord_driver::sim

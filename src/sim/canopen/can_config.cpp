#include <algorithm>
#include <array>
#include <map>

#include "sim/config_group.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

namespace {

// P509, CANopen: BU 0020 6.2.2. The list of the older series is printed with its PROFIBUS and InterBus values only
// (8-10 and 12-14); by their order the full CANopen control would be 17.
constexpr std::int32_t kCanopen = 6;
constexpr std::int32_t kCanopenOlderSeries = 17;
constexpr std::int32_t kSystemBus = 3;  // SK 1x0E and 2xxE: BU 0280

// P514: BU 0280; 800 kbit/s is not among them.
constexpr std::array<unsigned, 8> kBitRates{10'000, 20'000, 50'000, 100'000, 125'000, 250'000, 500'000, 1'000'000};

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isCanopen(const Group& group) {
  return group.has("transport") &&
         endsWith(group.get<std::string>("transport", "", "the name of a transport"), "canopen");
}

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

}  // namespace

InverterSettings canInverterSettings(CanConnection connection, const Device& device) {
  InverterSettings settings;
  settings.bus_source = device.isOlderSeries() ? kCanopenOlderSeries : device.isDecentral() ? kSystemBus : kCanopen;
  settings.on_system_bus = connection == CanConnection::kGateway;
  if (connection != CanConnection::kGateway) {
    settings.master_lost_fault = fault::kBusTimeout;
    settings.timeout_fault = fault::kBusTimeout;
  }
  return settings;
}

std::optional<CanBusConfig> readCanBus(const Group& root) {
  const Group bus(root.has("bus") ? root["bus"] : YAML::Node{}, "bus");
  const bool interface = bus.has("interface");
  if (!isCanopen(root) && !isCanopen(bus)) {
    if (!interface) return std::nullopt;
    throw ConfigError("bus/interface: " + bus.get<std::string>("interface", "", "the name of a CAN interface") +
                      " needs a CAN transport; expected transport: canopen, or bus/device");
  }
  CanBusConfig config;
  config.interface = bus.get<std::string>("interface", config.interface, "can0, vcan0 or virtual:NAME",
                                          [](const std::string& name) { return !name.empty(); });
  config.bit_rate = static_cast<std::uint32_t>(bus.get<int>(
      "bit_rate", 250'000, "10000, 20000, 50000, 100000, 125000, 250000, 500000 or 1000000 (P514)",
      [](const int& rate) {
        return std::find(kBitRates.begin(), kBitRates.end(), static_cast<unsigned>(rate)) != kBitRates.end();
      }));
  return config;
}

void readCanDrive(const Group& group, DriveConfig& drive) {
  CanDriveConfig can;
  can.connection = readConnection(group, drive.device);
  if (can.connection == CanConnection::kGateway) {
    can.inverter = static_cast<unsigned>(group.integer("inverter", 1, 1, 4));
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
  can.identity.serial = drive.slave.address;
  can.identity.vendor = group.get<std::uint32_t>("vendor_id", can.identity.vendor, "a number of 32 bits");
  can.identity.product = group.get<std::uint32_t>("product_code", can.identity.product, "a number of 32 bits");
  can.identity.revision = group.get<std::uint32_t>("revision_number", can.identity.revision, "a number of 32 bits");
  can.identity.serial = group.get<std::uint32_t>("serial_number", can.identity.serial, "a number of 32 bits");
  if (group.has("device_type")) can.device_type = group.get<std::uint32_t>("device_type", 0, "a number of 32 bits");
  drive.inverter = canInverterSettings(can.connection, drive.device);
  drive.can = can;
}

void checkCanNodes(const std::vector<DriveConfig>& drives) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (drives[k].slave.address != drives[i].slave.address) continue;
      const bool gateway =
          drives[k].can->connection == CanConnection::kGateway && drives[i].can->connection == CanConnection::kGateway;
      const std::string path = "drives/" + drives[i].name;
      if (!gateway) {
        throw ConfigError(path + "/address: " + std::to_string(drives[i].slave.address) +
                          " is not valid; expected a node id of its own, drive " + drives[k].name + " has it");
      }
      if (drives[k].can->inverter == drives[i].can->inverter) {
        throw ConfigError(path + "/inverter: " + std::to_string(drives[i].can->inverter) +
                          " is not valid; expected another one, drive " + drives[k].name +
                          " has it behind this gateway");
      }
    }
  }
}

}  // namespace nord_driver::sim

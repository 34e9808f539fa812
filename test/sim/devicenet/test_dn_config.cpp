#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sim/devicenet/dn_stations.h"

namespace nord_driver::sim {
namespace {

SimConfig read(const std::string& text) {
  return readSimConfig(YAML::Load(text));
}

// The driver's own keys, the simulator's beside them.
TEST(DnConfig, ReadsTheDriversFile) {
  const SimConfig config = read(R"(
transport: nord_driver/devicenet
bus: {interface: "virtual:demo", bit_rate: 125000, mac_id: 1, vendor_id: 65535, expected_packet_rate: 0.1}
drives:
  a: {address: 0, series: sk5xxe, io: poll, assembly: 101}
  b: {address: 5, series: sk2xxe, inverter: 1, io: poll, assembly: 120, status_bytes: 8, control_bytes: 4}
  c: {address: 5, series: sk2xxe, inverter: 3, io: poll, assembly: 120, profile: ac_drive_extended}
  d: {address: 63, series: sk700e, module: sk_tu1, assembly: 21, value_order: in_order}
  e: {address: 7, series: sk5xxe, module: sk_tu4, assembly: 102}
modules:
  behind_b: {address: 5, io_byte: true, inputs: 5, cos_instance_4_alone: true, packet_rate_steps: 2, vendor_id: 77, parameters: {P151: 500}}
)");
  EXPECT_TRUE(config.warnings.empty()) << config.warnings.front();
  ASSERT_TRUE(config.bus.is<DnBusConfig>());
  EXPECT_EQ("virtual:demo", config.bus.as<DnBusConfig>().interface);
  EXPECT_EQ(125000u, config.bus.as<DnBusConfig>().bit_rate);
  ASSERT_EQ(1u, config.bus.as<DnBusConfig>().modules.size());
  EXPECT_TRUE(config.bus.as<DnBusConfig>().modules[0].cos_instance_4_alone);
  EXPECT_FALSE(DnModuleSettings{}.cos_instance_4_alone);
  RobotSim robot{config};
  DnStations stations{robot};
  ASSERT_EQ(4u, stations.modules().size());
  EXPECT_EQ(0, stations.moduleOf(0).mac());
  EXPECT_EQ(Supply::kInverter, stations.moduleOf(0).supply());
  EXPECT_EQ(8u, stations.moduleOf(0).layout().outputs());
  DnModule& gateway = stations.moduleOf(2);
  EXPECT_EQ(Supply::kOwn, gateway.supply());
  EXPECT_EQ(1u + 8u + 4u, gateway.layout().inputs());
  EXPECT_EQ(1u + 4u + 4u, gateway.layout().outputs());
  EXPECT_EQ(DnProfile::kNord, gateway.layout().areas[0].profile);
  EXPECT_EQ(DnProfile::kAcDriveExtended, gateway.layout().areas[2].profile);
  EXPECT_EQ(77, gateway.identity().vendor);
  EXPECT_EQ(500, gateway.parameters().value(151));
  EXPECT_EQ(21u, stations.moduleOf(3).layout().instance);
  EXPECT_EQ(33u, stations.moduleOf(4).layout().inputs());
  EXPECT_FALSE(config.drives[0].bus.as<DnDriveConfig>().values_in_order);
  EXPECT_TRUE(config.drives[3].bus.as<DnDriveConfig>().values_in_order);
  // P509: DeviceNet, by the order of the older series' list 20; behind a gateway the system bus.
  EXPECT_EQ(7, robot.drive(0).parameters().value(509));
  EXPECT_EQ(3, robot.drive(1).parameters().value(509));
  EXPECT_EQ(20, robot.drive(3).parameters().value(509));
  EXPECT_EQ(6, robot.drive(4).parameters().value(509));
}

// The driver refuses a module that is another one than its configuration says: such a robot is simulated as it is.
TEST(DnConfig, AModuleIsTheOneItsDrivesSay) {
  RobotSim robot{read(R"(
transport: devicenet
drives:
  a: {address: 3, series: sk5xxe, vendor_id: 283, device_type: 0, product_code: 9}
  b: {address: 4, series: sk2xxe, inverter: 1}
  c: {address: 4, series: sk2xxe, inverter: 2, vendor_id: 283, product_code: 8}
  d: {address: 5, series: sk5xxe}
modules:
  of_b: {address: 4, vendor_id: 77}
)")};
  DnStations stations{robot};
  const DnIdentity& single = stations.moduleOf(0).identity();
  EXPECT_EQ(283, single.vendor);
  EXPECT_EQ(0, single.device_type);
  EXPECT_EQ(9, single.product);
  const DnIdentity& gateway = stations.moduleOf(1).identity();
  EXPECT_EQ(77, gateway.vendor) << "what is said of the module itself counts";
  EXPECT_EQ(8, gateway.product);
  EXPECT_EQ(2, gateway.device_type);
  EXPECT_EQ(1, stations.moduleOf(3).identity().product);
}

// The driver's keys of the module's own byte, given with one of its drives, are P161 of the simulated one.
TEST(DnConfig, TheModulesOwnByte) {
  const SimConfig config = read(R"(
transport: nord_driver/devicenet
bus: {interface: "virtual:demo"}
drives:
  a: {address: 5, series: sk2xxe, inverter: 1, assembly: 120, module_input_bytes: 1, module_output_bytes: 1, eds: x.eds}
  b: {address: 5, series: sk2xxe, inverter: 2, assembly: 120, parameter_objects: index_object, product_code: 2}
)");
  EXPECT_TRUE(config.warnings.empty()) << config.warnings.front();
  RobotSim robot{config};
  DnStations stations{robot};
  EXPECT_EQ(9u, stations.moduleOf(0).layout().inputs());
  EXPECT_EQ(9u, stations.moduleOf(0).layout().outputs());
}

// What the drives of a module share is given once (doc/devicenet.md).
TEST(DnConfig, TheAssemblyIsThatOfTheModule) {
  const SimConfig config = read(
      "{bus: {transport: devicenet}, drives: {a: {address: 3, series: sk2xxe, assembly: 102}, "
      "b: {address: 3, series: sk2xxe, inverter: 2}, c: {address: 4, series: sk2xxe}}}");
  EXPECT_EQ(102u, config.drives[1].bus.as<DnDriveConfig>().assembly);
  EXPECT_EQ(100u, config.drives[2].bus.as<DnDriveConfig>().assembly);
  const SimConfig second = read(
      "{bus: {transport: devicenet}, drives: {a: {address: 3, series: sk2xxe}, "
      "b: {address: 3, series: sk2xxe, inverter: 2, assembly: 102}, c: {address: 4, series: sk2xxe}}}");
  EXPECT_EQ(102u, second.drives[0].bus.as<DnDriveConfig>().assembly);
  EXPECT_EQ(100u, second.drives[2].bus.as<DnDriveConfig>().assembly);
}

TEST(DnConfig, RefusesInWords) {
  const auto refusal = [](const std::string& drives, const std::string& more = "") -> std::string {
    try {
      read("{bus: {transport: devicenet" + more + "}, drives: {" + drives + "}}");
      return "accepted";
    } catch (const ConfigError& error) {
      return error.what();
    }
  };
  EXPECT_EQ("accepted", refusal("a: {address: 0}"));
  EXPECT_EQ("drives/a/address: 64 is not valid; expected a whole number from 0 to 63", refusal("a: {address: 64}"));
  EXPECT_EQ("drives/b/address: 3 is not valid; expected a MAC id of its own, drive a has it",
            refusal("a: {address: 3}, b: {address: 3}"));
  EXPECT_EQ("drives/b/inverter: 1 is not valid; expected another one, drive a has it behind this module",
            refusal("a: {address: 3, series: sk2xxe}, b: {address: 3, series: sk2xxe}"));
  EXPECT_EQ("drives/b/assembly: 101 is not valid; expected 102, the one of drive a behind the same module (P160)",
            refusal("a: {address: 3, series: sk2xxe, assembly: 102}, "
                    "b: {address: 3, series: sk2xxe, inverter: 2, assembly: 101}"));
  EXPECT_EQ("drives/a/assembly: 99 is not valid; expected 20, 21, 100, 101, 102 or 120",
            refusal("a: {address: 3, assembly: 99}"));
  EXPECT_EQ("drives/a/assembly: 102 is not valid; expected 20, 21, 100 or 101: this module has one inverter (P507)",
            refusal("a: {address: 3, assembly: 102}"));
  EXPECT_EQ("drives/a/inverter: 2 is not valid; expected 1: only an sk_cu4 or sk_tu4 has more than one",
            refusal("a: {address: 3, inverter: 2}"));
  EXPECT_EQ("drives/a/module: sk_tu3 is not valid; expected sk_cu4 or sk_tu4, the ones for this series",
            refusal("a: {address: 3, series: sk1x0e, module: sk_tu3}"));
  EXPECT_EQ("drives/a/module: sk_tu4 is not valid; expected sk_tu1 or sk_tu2, the ones for this series",
            refusal("a: {address: 3, series: sk750e, module: sk_tu4}"));
  EXPECT_EQ("drives/a/control_bytes: 9 is not valid; expected a whole number from 0 to 8",
            refusal("a: {address: 3, series: sk2xxe, assembly: 120, control_bytes: 9}"));
  EXPECT_EQ("drives/a/profile: cia402 is not valid; expected nord, ac_drive or ac_drive_extended",
            refusal("a: {address: 3, profile: cia402}"));
  EXPECT_EQ("bus/bit_rate: 1000000 is not valid; expected 125000, 250000 or 500000",
            refusal("a: {address: 3}", ", bit_rate: 1000000"));
  EXPECT_THROW(read("{transport: devicenet, drives: {a: {address: 3}}, modules: {m: {address: 4}}}"), ConfigError);
  EXPECT_THROW(read("{transport: devicenet, drives: {a: {address: 3, series: sk2xxe}}, "
                    "modules: {m: {address: 3, parameters: {P153: 1}}}}"),
               ConfigError);
}

TEST(DnConfig, ParametersOfTheModule) {
  const ParameterStore parameters{dnModuleParameterDefinitions()};
  EXPECT_EQ(3, parameters.value(160)) << "BU 0280 5.2.2: {3}";
  EXPECT_EQ(0, parameters.find(151)->minimum);
  EXPECT_EQ(nullptr, parameters.find(182)) << "PROFIBUS only";
}

}  // namespace
}  // namespace nord_driver::sim

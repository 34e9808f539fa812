#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sim/canopen/can_stations.h"

namespace nord_driver::sim {
namespace {

SimConfig read(const std::string& text) {
  return readSimConfig(YAML::Load(text));
}

// The driver's own keys, the simulator's beside them.
TEST(CanConfig, ReadsTheFourSituations) {
  const SimConfig config = read(R"(
bus: {transport: canopen, interface: "virtual:demo", bit_rate: 125000}
drives:
  a: {address: 32, series: sk300e}
  b: {address: 33, series: sk5xxe, connection: onboard}
  c: {address: 34, series: sk2xxe, connection: gateway, inverter: 1, array_sub_index: table}
  d: {address: 34, series: sk2xxe, connection: gateway, inverter: 3, vendor_id: 0x12345678}
  e: {address: 36, series: sk1x0e, connection: system_bus}
  f: {address: 127, series: sk5xxe, profile: cia402}
)");
  EXPECT_TRUE(config.warnings.empty()) << config.warnings.front();
  ASSERT_TRUE(config.bus.is<CanBusConfig>());
  EXPECT_EQ("virtual:demo", config.bus.as<CanBusConfig>().interface);
  EXPECT_EQ(125000u, config.bus.as<CanBusConfig>().bit_rate);
  EXPECT_EQ(CanConnection::kOption, config.drives[0].bus.as<CanDriveConfig>().connection);
  EXPECT_EQ(CanConnection::kOnboard, config.drives[1].bus.as<CanDriveConfig>().connection);
  EXPECT_EQ(CanConnection::kGateway, config.drives[2].bus.as<CanDriveConfig>().connection);
  EXPECT_TRUE(config.drives[2].bus.as<CanDriveConfig>().array_sub_by_table);
  EXPECT_EQ(3u, config.drives[3].place);
  EXPECT_EQ(0x12345678u, config.drives[3].bus.as<CanDriveConfig>().identity.vendor);
  EXPECT_EQ(CanConnection::kSystemBus, config.drives[4].bus.as<CanDriveConfig>().connection);
  EXPECT_TRUE(config.drives[5].bus.as<CanDriveConfig>().cia402);
  RobotSim robot{config};
  CanStations stations{robot};
  ASSERT_EQ(5u, stations.nodes().size());
  EXPECT_EQ(34, stations.nodeOf(3).id());
  // P509: CANopen, of the SK 1x0E and 2xxE the system bus; P515 the node id; P551 the profile.
  EXPECT_EQ(6, robot.drive(1).parameters().value(509));
  EXPECT_EQ(3, robot.drive(2).parameters().value(509));
  EXPECT_EQ(32, robot.drive(0).config().address);
  EXPECT_EQ(33, robot.drive(1).parameters().value(515));
  EXPECT_EQ(1, robot.drive(5).parameters().value(551));
}

// The driver takes what is said of a node from any drive behind it: such a robot is simulated as it is.
TEST(CanConfig, ANodeIsTheOneAnyOfItsDrivesSays) {
  RobotSim robot{read(R"(
bus: {transport: canopen, interface: "virtual:demo"}
drives:
  a: {address: 34, series: sk2xxe, connection: gateway, inverter: 1, product_code: 9}
  b: {address: 34, series: sk2xxe, connection: gateway, inverter: 2, vendor_id: 0x12345678, device_type: 7}
  c: {address: 35, series: sk2xxe, connection: gateway}
)")};
  CanStations stations{robot};
  EXPECT_EQ(0x12345678u, stations.nodeOf(0).identity().vendor);
  EXPECT_EQ(9u, stations.nodeOf(0).identity().product);
  for (int drive : {0, 1}) EXPECT_EQ(7u, robot.config().drives[drive].bus.as<CanDriveConfig>().device_type);
  EXPECT_EQ(CanIdentity{}.vendor, stations.nodeOf(2).identity().vendor) << "it is another node";
  EXPECT_EQ(35u, stations.nodeOf(2).identity().serial);
}

// The driver's file names its transport at the top.
TEST(CanConfig, TransportOfTheDriver) {
  EXPECT_TRUE(read("{transport: nord_driver/canopen, drives: {a: {address: 3}}}").bus.is<CanBusConfig>());
  EXPECT_TRUE(read("{transport: canopen, drives: {a: {address: 3}}}").bus.is<CanBusConfig>());
  EXPECT_FALSE(read("{transport: nord_driver/profibus_dp, drives: {a: {address: 3}}}").bus.is<CanBusConfig>());
}

TEST(CanConfig, RefusesInWords) {
  const auto refusal = [](const std::string& drives, const std::string& bus = "transport: canopen") -> std::string {
    try {
      read("{bus: {" + bus + "}, drives: {" + drives + "}}");
      return "accepted";
    } catch (const ConfigError& error) {
      return error.what();
    }
  };
  EXPECT_EQ("accepted", refusal("a: {address: 127}"));
  EXPECT_EQ("drives/a/address: 128 is not valid; expected a whole number from 1 to 127", refusal("a: {address: 128}"));
  EXPECT_EQ("drives/b/address: 3 is not valid; expected a node id of its own, drive a has it",
            refusal("a: {address: 3}, b: {address: 3}"));
  EXPECT_EQ("drives/b/inverter: 1 is not valid; expected another one, drive a has it behind this gateway",
            refusal("a: {address: 3, connection: gateway}, b: {address: 3, connection: gateway}"));
  EXPECT_EQ("drives/a/connection: usb is not valid; expected option, onboard, gateway or system_bus",
            refusal("a: {address: 3, connection: usb}"));
  EXPECT_EQ("drives/a/connection: option is not valid; expected gateway or system_bus, the ones for this series",
            refusal("a: {address: 3, series: sk2xxe}"));
  EXPECT_EQ("drives/a/connection: onboard is not valid; expected a series with a CAN port: sk5xxe or sk54xe",
            refusal("a: {address: 3, series: sk700e, connection: onboard}"));
  EXPECT_EQ("drives/a/connection: gateway is not valid; expected option, the one for this series",
            refusal("a: {address: 3, series: sk700e, connection: gateway}"));
  EXPECT_EQ("drives/a/inverter: 2 is not valid; expected 1: only a gateway has more than one",
            refusal("a: {address: 3, inverter: 2}"));
  EXPECT_EQ("drives/a/array_sub_index: both is not valid; expected element or table",
            refusal("a: {address: 3, array_sub_index: both}"));
  EXPECT_EQ("drives/a/profile: ds402 is not valid; expected nord or cia402",
            refusal("a: {address: 3, profile: ds402}"));
  EXPECT_THAT(refusal("a: {address: 3, connection: onboard, profile: cia402}"),
              testing::HasSubstr("profile: cia402 is not valid; expected nord"));
  EXPECT_EQ(
      "bus/bit_rate: 800000 is not valid; expected 10000, 20000, 50000, 100000, 125000, 250000, 500000 or 1000000 "
      "(P514)",
      refusal("a: {address: 3}", "transport: canopen, bit_rate: 800000"));
  EXPECT_THAT(refusal("a: {address: 3}", "interface: can0"), testing::HasSubstr("bus/interface: can0 needs a CAN"));
}

}  // namespace
}  // namespace nord_driver::sim

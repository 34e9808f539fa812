// The configuration of a simulated InterBus ring: the driver's own file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "sim/interbus/ibs_ring.h"

namespace nord_driver::sim {
namespace {

using ::testing::HasSubstr;

SimConfig read(const std::string& text) {
  return readSimConfig(YAML::Load(text));
}

TEST(IbsConfig, ReadsTheDriversKeys) {
  const SimConfig config = read(R"(
transport: nord_driver/interbus
bus:
  gateway: 127.0.0.1:1502
  unit: 7
  inputs: {function: 4, address: 10}
  outputs: {function: 16, address: 20}
  word_order: swapped
  pcp_word: true
  running: {address: 100, mask: 6, value: 4}
  watchdog: {address: 200, value: 500}
drives:
  left: {address: 2, series: sk5xxe, ppo_type: 1, profile: drivecom, max_frequency: 50.0, array_sub_index: table}
  right: {address: 254, series: sk700e, ppo_type: 2, input_offset: 8, output_offset: 16, max_frequency: 50.0}
)");
  EXPECT_TRUE(config.warnings.empty()) << config.warnings.front();
  ASSERT_TRUE(config.bus.is<IbsBusConfig>());
  const auto& bus = config.bus.as<IbsBusConfig>();
  EXPECT_EQ("127.0.0.1:1502", bus.gateway);
  EXPECT_EQ(1502, gatewayPort(bus.gateway));
  EXPECT_EQ(7u, bus.unit);
  EXPECT_EQ(10u, bus.input_address);
  EXPECT_EQ(20u, bus.output_address);
  EXPECT_TRUE(bus.swapped && bus.pcp_word);
  EXPECT_EQ(100u, bus.running->address);
  EXPECT_EQ(6, bus.running->mask);
  EXPECT_EQ(4, bus.running->value);
  EXPECT_EQ(200u, bus.watchdog.value());
  EXPECT_TRUE(config.drives[0].bus.as<IbsDriveConfig>().drivecom);
  EXPECT_EQ(2u, config.drives[1].bus.as<IbsDriveConfig>().ppo_type);
  EXPECT_EQ(8u, config.drives[1].bus.as<IbsDriveConfig>().input_offset.value());
  EXPECT_TRUE(config.drives[0].bus.as<IbsDriveConfig>().array_sub_by_table);
  EXPECT_FALSE(config.drives[1].bus.as<IbsDriveConfig>().array_sub_by_table);
  RobotSim robot{config};
  const IbsRing ring{robot};
  EXPECT_EQ(5, robot.drive(0).parameters().value(509));
  EXPECT_EQ(14, robot.drive(1).parameters().value(509));
  EXPECT_EQ(1, robot.drive(0).parameters().value(551));
  EXPECT_EQ(2, robot.drive(1).parameters().value(507));
}

TEST(IbsConfig, TheEndPointIsTheGateway) {
  const SimConfig config =
      readSimConfig(YAML::Load("{transport: interbus, drives: {a: {address: 1}}}"), "127.0.0.1:15020");
  EXPECT_EQ("127.0.0.1:15020", config.bus.as<IbsBusConfig>().gateway);
}

TEST(IbsConfig, RefusesInWords) {
  const auto refusal = [](const std::string& drives, const std::string& bus = "unit: 1") -> std::string {
    try {
      read("{transport: interbus, bus: {" + bus + "}, drives: {" + drives + "}}");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(
      "bus/gateway: 192.168.0.10:502 is not valid; expected 127.0.0.1:PORT, the simulated gateway is on this "
      "computer only",
      refusal("a: {address: 1}", "gateway: '192.168.0.10:502'"));
  EXPECT_THAT(refusal("a: {address: 1}", "gateway: '127.0.0.1:70000'"), HasSubstr("expected 127.0.0.1:PORT"));
  EXPECT_THAT(refusal("a: {address: 1}", "word_order: little"), HasSubstr("bus/word_order: little is not valid"));
  EXPECT_THAT(refusal("a: {address: 1}", "running: {mask: 0}"), HasSubstr("bus/running/mask: 0 is not valid"));
  EXPECT_THAT(refusal("a: {address: 255}"), HasSubstr("drives/a/address: 255 is not valid"));
  EXPECT_THAT(refusal("a: {address: 1, ppo_type: 3}"), HasSubstr("drives/a/ppo_type: 3 is not valid"));
  EXPECT_THAT(refusal("a: {address: 1, profile: cia402}"), HasSubstr("drives/a/profile: cia402 is not valid"));
  EXPECT_THAT(refusal("a: {address: 1, array_sub_index: both}"),
              HasSubstr("drives/a/array_sub_index: both is not valid"));
  EXPECT_THAT(refusal("a: {address: 1, series: sk2xxe}"), HasSubstr("drives/a/series: sk2xxe is not valid"));
  EXPECT_THAT(refusal("a: {address: 1}, b: {address: 1}"), HasSubstr("expected a place of its own in the ring"));
}

}  // namespace
}  // namespace nord_driver::sim

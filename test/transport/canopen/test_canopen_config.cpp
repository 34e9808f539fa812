// The configuration of a CANopen bus: what is accepted, what is refused and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/canopen/canopen_settings.h"

namespace nord_driver {
namespace {

using canopen::BootReset;
using canopen::ErrorControlMode;
using std::chrono::milliseconds;
using test::MapSettings;
using Bus = test::CanopenSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

// The defaults stop a drive sooner than cmd_vel_timeout would: guarding of 0.3 s, and an event timer that shows a
// silent inverter.
TEST(CanopenConfigTest, HasItsDefaults) {
  const CanopenConfig config = Bus{}.read();
  EXPECT_EQ("can0", config.interface);
  EXPECT_EQ(0u, config.bit_rate) << "whatever the interface runs at";
  EXPECT_EQ(milliseconds{2}, std::chrono::floor<milliseconds>(config.answer_window));
  EXPECT_FALSE(config.master.sync_cob_id.has_value());
  EXPECT_FALSE(config.master.own_id.has_value());
  ASSERT_EQ(2u, config.master.nodes.size());
  const canopen::NodeConfig& node = config.master.nodes[1];
  EXPECT_EQ(4, node.id);
  EXPECT_EQ(BootReset::kResetCommunication, node.reset);
  EXPECT_EQ(ErrorControlMode::kGuarding, node.error_control.mode);
  EXPECT_EQ(milliseconds{100}, node.error_control.guard_time);
  EXPECT_EQ(3, node.error_control.life_time_factor);
  EXPECT_EQ(milliseconds{300}, node.sdo_timeout);
  EXPECT_FALSE(node.vendor_id.has_value());
  ASSERT_EQ(1u, node.transmit_pdos.size());
  EXPECT_EQ(100, node.transmit_pdos[0].inhibit_time.value()) << "one TPDO per cycle of 10 ms";
  EXPECT_EQ(50, node.transmit_pdos[0].event_timer.value());
  EXPECT_EQ(2u, node.transmit_pdos[0].mapping.size());
  const CanopenDrive& drive = config.drives[1];
  EXPECT_EQ(1u, drive.node);
  EXPECT_EQ(CanopenConnection::kOption, drive.connection);
  EXPECT_EQ(DriveProfile::kNord, drive.drive_profile);
  EXPECT_EQ(1, drive.process_values);
  EXPECT_EQ(ArraySubIndex::kElement, drive.array_sub_index);
  EXPECT_EQ(milliseconds{125}, drive.transmit_limit) << "two and a half event times";
  EXPECT_EQ(milliseconds{125}, config.master.nodes[0].first_answer_timeout) << "as long as its TPDOs may take";
}

TEST(CanopenConfigTest, TakesWhatIsGiven) {
  Bus bus;
  bus.bus.set("interface", "virtual:yard").set("bit_rate", 500'000).set("heartbeat", 0.05).set("node_id", 126);
  bus.bus.set("sdo_timeout", 0.5).set("answer_window", 0.004);
  bus.drive().set("error_control", "heartbeat").set("heartbeat_time", 0.05).set("heartbeat_timeout", 0.12);
  bus.drive().set("watch_master", 0.2).set("boot_reset", "node").set("sdo_timeout", 1.0);
  bus.drive()
      .set("vendor_id", 0x4E)
      .set("product_code", 7)
      .set("device_type", MapSettings::Value{0})
      .set("revision_number", 2);
  bus.drive()
      .set("inhibit_time", 0.005)
      .set("event_time", MapSettings::Value{0})
      .set("array_sub_index", "table")
      .set("process_values", 3);
  const CanopenConfig config = bus.read();
  EXPECT_EQ("virtual:yard", config.interface);
  EXPECT_EQ(500'000u, config.bit_rate);
  EXPECT_EQ(126, config.master.own_id.value());
  EXPECT_EQ(milliseconds{50}, config.master.heartbeat_time);
  const canopen::NodeConfig& node = config.master.nodes[0];
  EXPECT_EQ(ErrorControlMode::kHeartbeat, node.error_control.mode);
  EXPECT_EQ(milliseconds{120}, node.error_control.heartbeat_timeout);
  EXPECT_EQ(milliseconds{200}, node.error_control.master_timeout.value());
  EXPECT_EQ(BootReset::kResetNode, node.reset);
  EXPECT_EQ(milliseconds{1000}, node.sdo_timeout);
  EXPECT_EQ(milliseconds{500}, config.master.nodes[1].sdo_timeout) << "the bus's";
  EXPECT_EQ(0x4Eu, node.vendor_id.value());
  EXPECT_EQ(7u, node.product_code.value());
  EXPECT_EQ(50, node.transmit_pdos[1].inhibit_time.value());
  EXPECT_EQ(0, node.transmit_pdos[1].event_timer.value());
  EXPECT_EQ(3, config.drives[0].process_values);
  EXPECT_EQ(Duration::zero(), config.drives[0].transmit_limit) << "it sends on change only";
  EXPECT_EQ(milliseconds{100}, config.master.nodes[0].first_answer_timeout);
  EXPECT_EQ(ArraySubIndex::kTable, config.drives[0].array_sub_index);
}

TEST(CanopenConfigTest, WithSyncEveryNodeAnswersEveryCycle) {
  Bus bus;
  bus.bus.set("sync", true);
  const CanopenConfig config = bus.read();
  EXPECT_EQ(0x80u, config.master.sync_cob_id.value());
  EXPECT_EQ(1, config.master.nodes[0].receive_pdos[0].transmission_type);
  EXPECT_EQ(milliseconds{30}, config.drives[0].transmit_limit);
}

TEST(CanopenConfigTest, SeriesDecidesTheWordOrder) {
  Bus bus{1};
  EXPECT_FALSE(bus.read().drives[0].third_before_second);
  bus.drive().set("series", "sk700e");
  EXPECT_TRUE(bus.read().drives[0].third_before_second);
}

// A node waits for the inhibit time before it sends at its event time, too (CiA 301, object 1800h).
TEST(CanopenConfigTest, TheInhibitTimeIsNotAboveTheEventTime) {
  Bus bus{1};
  bus.drive().set("event_time", 0.005);
  EXPECT_EQ(50, bus.read().master.nodes[0].transmit_pdos[0].inhibit_time.value()) << "5 ms, with a cycle of 10 ms";
  bus.drive().set("event_time", MapSettings::Value{0}).set("inhibit_time", 0.2);
  EXPECT_EQ(2000, bus.read().master.nodes[0].transmit_pdos[0].inhibit_time.value()) << "nothing is sent at intervals";
}

// Its process data is all that tells of a node without error control; a node with it is told of by that.
TEST(CanopenConfigTest, WithoutErrorControlTheEndOfItsProcessDataIsALoss) {
  Bus bus{2};
  bus.drive(0).set("error_control", "none");
  EXPECT_EQ(milliseconds{1000}, bus.read().master.nodes[0].silence);
  EXPECT_EQ(Duration{}, bus.read().master.nodes[1].silence);
  bus.drive(0).set("event_time", 0.2);
  EXPECT_EQ(milliseconds{1500}, bus.read().master.nodes[0].silence);
  bus.drive(0).set("event_time", MapSettings::Value{0});
  EXPECT_EQ(Duration{}, bus.read().master.nodes[0].silence) << "it sends on a change only";
}

// --- Gateways --------------------------------------------------------------------------------------------------------

// BU 0260: one node, up to four inverters, an SDO server each; the identifiers of 1201h and so on are ours to set.
TEST(CanopenConfigTest, InvertersBehindAGatewayShareItsNode) {
  const CanopenConfig config = Bus::gateway().read();
  ASSERT_EQ(1u, config.master.nodes.size());
  const canopen::NodeConfig& node = config.master.nodes[0];
  EXPECT_EQ(0u, config.drives[0].sdo_server);
  EXPECT_EQ(1u, config.drives[1].sdo_server);
  ASSERT_EQ(2u, node.sdo_servers.size());
  EXPECT_EQ(0x60Au, node.sdo_servers[0].request_id);
  EXPECT_EQ(0x58Au, node.sdo_servers[0].response_id);
  ASSERT_EQ(2u, node.setup.size());
  EXPECT_EQ(0x1201, node.setup[0].index);
  EXPECT_EQ(1, node.setup[0].sub_index);
  EXPECT_EQ(node.sdo_servers[1].request_id, node.setup[0].value);
  EXPECT_EQ(4, node.setup[0].size);
  EXPECT_EQ(2, node.setup[1].sub_index);
  EXPECT_EQ(node.sdo_servers[1].response_id, node.setup[1].value);
  EXPECT_EQ(3, config.drives[0].process_values);
  EXPECT_TRUE(node.receive_pdos[0].mapping.empty()) << "as delivered";
}

TEST(CanopenConfigTest, TheGatewaysServersCanBeGiven) {
  Bus bus = Bus::gateway();
  bus.drive(1).set("sdo_request_id", 0x650).set("sdo_answer_id", 0x651);
  EXPECT_EQ(0x650u, bus.read().master.nodes[0].sdo_servers[1].request_id);
  EXPECT_EQ(0x651u, bus.read().master.nodes[0].sdo_servers[1].response_id);
}

// BU 0270 p. 43: offsets of 0800h per inverter on one server, as the EtherCAT sibling does.
TEST(CanopenConfigTest, AGatewaysParametersCanBeTold) {
  Bus bus = Bus::gateway();
  for (auto& settings : bus.settings) settings->set("parameter_servers", "index_offset");
  const CanopenConfig config = bus.read();
  EXPECT_EQ(0x2800, config.drives[0].parameter_base);
  EXPECT_EQ(0x3000, config.drives[1].parameter_base);
  EXPECT_EQ(1u, config.master.nodes[0].sdo_servers.size());
  EXPECT_TRUE(config.master.nodes[0].setup.empty());
}

// Once is enough, at whichever inverter: a program for parameters has another one first than the driver.
TEST(CanopenConfigTest, AnyInverterBehindAGatewaySaysWhatIsTheNodes) {
  for (const std::size_t says : {0u, 1u}) {
    Bus bus = Bus::gateway();
    bus.drive(says).set("guard_time", 0.2).set("vendor_id", 0x4E).set("boot_reset", "node");
    bus.drive(1 - says).set("life_time_factor", 5);
    ASSERT_EQ("accepted", bus.refusal()) << says;
    const canopen::NodeConfig node = bus.read().master.nodes.at(0);
    EXPECT_EQ(milliseconds{200}, node.error_control.guard_time) << says;
    EXPECT_EQ(5, node.error_control.life_time_factor) << says;
    EXPECT_EQ(0x4Eu, node.vendor_id.value_or(0)) << says;
    EXPECT_EQ(BootReset::kResetNode, node.reset) << says;
    bus.drive(says).set("guard_time", 0.001);
    EXPECT_THAT(bus.refusal(), HasSubstr("~drives/drive" + std::to_string(says) + "/guard_time: 0.001 is not valid"));
  }
}

TEST(CanopenConfigTest, GatewayRulesAreHeld) {
  Bus twice = Bus::gateway();
  twice.drive(1).set("inverter", 1);
  EXPECT_THAT(twice.refusal(), AllOf(HasSubstr("~drives/drive1/inverter: 1 is not valid"), HasSubstr("drive0")));
  twice.drive(1).erase("inverter");
  EXPECT_THAT(twice.refusal(), HasSubstr("~drives/drive1/inverter: 1 is not valid")) << "not the place of drive0";
  Bus mixed = Bus::gateway();
  mixed.drive(1).set("connection", "option").set("series", "sk5xxe").set("inverter", 1);
  EXPECT_THAT(mixed.refusal(), AllOf(HasSubstr("~drives/drive1/address: 10"), HasSubstr("only inverters behind one")));
  Bus differs = Bus::gateway();
  differs.drive(0).set("guard_time", 0.1);
  differs.drive(1).set("guard_time", 0.2);
  EXPECT_THAT(differs.refusal(), AllOf(HasSubstr("~drives/drive1/guard_time"), HasSubstr("drive0"), HasSubstr("same")));
  Bus one_value = Bus::gateway();
  one_value.drive().set("process_values", 1);
  EXPECT_THAT(one_value.refusal(), HasSubstr("~drives/drive0/process_values: 1 is not valid, expected 3"));
  Bus no_gateway;
  no_gateway.drive().set("inverter", 2);
  EXPECT_THAT(no_gateway.refusal(), HasSubstr("~drives/drive0/inverter: 2 is not valid, expected 1: only a gateway"));
  Bus offset;
  offset.drive().set("parameter_servers", "index_offset");
  EXPECT_THAT(offset.refusal(), HasSubstr("~drives/drive0/parameter_servers: \"index_offset\" is not valid"));
}

// --- The system bus: experimental ------------------------------------------------------------------------------------

TEST(CanopenConfigTest, TheSystemBusHasFourInverterIds) {
  Bus bus{1};
  bus.drive().set("connection", "system_bus").set("series", "sk2xxe").set("address", 34);
  const CanopenConfig config = bus.read();
  EXPECT_EQ(BootReset::kNone, config.master.nodes[0].reset) << "it has masters of its own";
  EXPECT_TRUE(config.master.nodes[0].receive_pdos[0].mapping.empty());
  bus.drive().set("address", 33);
  EXPECT_THAT(bus.refusal(), HasSubstr("~drives/drive0/address: 33 is not valid, expected 32, 34, 36 or 38"));
}

// --- What is refused -------------------------------------------------------------------------------------------------

TEST(CanopenConfigTest, TheInterfaceIsDemanded) {
  Bus bus;
  bus.bus.erase("interface");
  EXPECT_EQ("~bus/interface is missing: expected a CAN interface such as can0, or virtual:NAME", bus.refusal());
}

TEST(CanopenConfigTest, NodeIdsAreOneTo127AndUnique) {
  Bus bus;
  bus.drive(1).set("address", 3);
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("~drives/drive1/address: 3 is not valid"), HasSubstr("drive0")));
  bus.drive(1).set("address", MapSettings::Value{0});
  EXPECT_EQ("~drives/drive1/address: 0 is not valid, expected a whole number from 1 to 127", bus.refusal());
  bus.drive(1).set("address", 128);
  EXPECT_THAT(bus.refusal(), HasSubstr("128 is not valid"));
  bus.drive(1).erase("address");
  EXPECT_EQ("~drives/drive1/address is missing: expected a whole number from 1 to 127", bus.refusal());
  bus.drive(1).set("address", 127);
  bus.bus.set("heartbeat", 0.1);
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("127 is not valid"), HasSubstr("bus/node_id")));
}

// BU 0060 p. 57: the CAN port of SK 5xxE has no CiA 402; SK 2xxE reaches CANopen only through SK CU4/TU4-CAO.
TEST(CanopenConfigTest, ConnectionSeriesAndProfileMustFit) {
  Bus bus{1};
  bus.drive().set("connection", "onboard").set("profile", "cia402");
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("~drives/drive0/profile: \"cia402\" is not valid, expected nord"),
                                   HasSubstr("does not support CiA 402")));
  bus.drive().set("profile", "nord").set("series", "sk700e");
  EXPECT_THAT(bus.refusal(), HasSubstr("~drives/drive0/series: \"sk700e\" is not valid, expected sk5xxe or sk54xe"));
  bus.drive().set("connection", "option").set("series", "sk2xxe");
  EXPECT_THAT(bus.refusal(), HasSubstr("sk1x0e and sk2xxe need connection: gateway"));
  bus.drive().set("connection", "gateway").set("profile", "cia402");
  EXPECT_THAT(bus.refusal(), HasSubstr("\"cia402\" is not valid, expected nord: what its CiA 402 objects are"));
  bus.drive().set("connection", "usb");
  EXPECT_EQ("~drives/drive0/connection: \"usb\" is not valid, expected one of option, onboard, gateway, system_bus",
            bus.refusal());
}

TEST(CanopenConfigTest, Cia402HasOneSpeedAndItsOwnMapping) {
  Bus bus{1};
  bus.drive().set("profile", "cia402");
  EXPECT_EQ(DriveProfile::kCia402, bus.read().drives[0].drive_profile);
  bus.drive().set("process_values", 3);
  EXPECT_THAT(bus.refusal(), HasSubstr("~drives/drive0/process_values: 3 is not valid, expected 1"));
  bus.drive().set("process_values", 1).set("pdo_mapping", "keep");
  EXPECT_THAT(bus.refusal(), HasSubstr("~drives/drive0/pdo_mapping: \"keep\" is not valid, expected write"));
}

struct WrongValue {
  const char* key;
  MapSettings::Value value;
  const char* sentence;
};

TEST(CanopenConfigTest, EveryWrongValueIsNamed) {
  const WrongValue kWrong[] = {
      {"process_values", 2, "process_values: 2 is not valid, expected 1 or 3"},
      {"error_control", std::string{"watchdog"}, "expected one of guarding, heartbeat, none"},
      {"guard_time", 0.0005, "guard_time: 0.0005 is not valid"},
      {"guard_time", 0.1005, "guard_time: 0.1005 is not valid, expected whole milliseconds"},
      {"life_time_factor", 1, "life_time_factor: 1 is not valid, expected a whole number from 2 to 255"},
      {"heartbeat_time", 66.0, "heartbeat_time: 66 is not valid"},
      {"heartbeat_timeout", 0.1, "heartbeat_timeout: 0.1 is not valid, expected more than heartbeat_time, 0.1 s"},
      {"watch_master", 0.3, "watch_master: 0.3 is not valid, expected no such key unless bus/heartbeat"},
      {"boot_reset", std::string{"all"}, "expected one of communication, node, none"},
      {"sdo_timeout", 0.0, "sdo_timeout: 0 is not valid"},
      {"vendor_id", -1, "vendor_id: -1 is not valid"},
      {"inhibit_time", 7.0, "inhibit_time: 7 is not valid"},
      {"inhibit_time", 0.2, "inhibit_time: 0.2 is not valid, expected at most event_time, 0.05 s"},
      {"event_time", -0.1, "event_time: -0.1 is not valid"},
      {"array_sub_index", std::string{"both"}, "expected one of element, table"},
      {"pdo_mapping", std::string{"yes"}, "expected one of write, keep"},
      {"inverter", 5, "inverter: 5 is not valid"},
  };
  for (const WrongValue& wrong : kWrong) {
    Bus bus{1};
    bus.drive().set(wrong.key, wrong.value);
    EXPECT_THAT(bus.refusal(), AllOf(HasSubstr(std::string("~drives/drive0/") + wrong.key), HasSubstr(wrong.sentence)));
  }
}

TEST(CanopenConfigTest, WrongValuesOfTheBusAreNamed) {
  const WrongValue kWrong[] = {
      {"bit_rate", 800'000, "800000 is not valid, expected one of 10000, 20000, 50000, 100000, 125000, 250000"},
      {"bit_rate", 0, "0 is not valid"},
      {"heartbeat", 70.0, "70 is not valid"},
      {"node_id", 0, "0 is not valid"},
      {"sdo_timeout", 0.001, "0.001 is not valid"},
      {"answer_window", 0.02, "0.02 is not valid, expected a number from 0 to 0.005 s"},
  };
  for (const WrongValue& wrong : kWrong) {
    Bus bus;
    bus.bus.set(wrong.key, wrong.value);
    EXPECT_THAT(bus.refusal(), AllOf(HasSubstr(std::string("~bus/") + wrong.key), HasSubstr(wrong.sentence)));
  }
}

// 32 drives at 100 Hz are more than 250 kbit/s carry; at 1 Mbit/s they fit.
TEST(CanopenConfigTest, TheBusMustCarryTheCycle) {
  Bus bus{32};
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("~bus/bit_rate: 250000 bit/s is too slow for 32 drives at 100 Hz"),
                                   HasSubstr("cycle_rate of at most 32 Hz")));
  bus.bus.set("bit_rate", 1'000'000);
  EXPECT_EQ("accepted", bus.refusal());
}

// No manual at hand tells how they travel: refused, and where they are said.
TEST(CanopenConfig, RefusesTheTerminalsOfTheModule) {
  for (const char* word : {"module_output_1", "module_input_4"}) {
    test::CanopenSettings settings = test::CanopenSettings::gateway();
    settings.drive(1).set("signals/lamp/source", word);
    EXPECT_THAT(
        settings.refusal(),
        ::testing::AllOf(::testing::HasSubstr("drives/drive1/signals/lamp/source: \"" + std::string(word) + "\""),
                         ::testing::HasSubstr("(1404h, 1804h), and no manual at hand tells their COB-ID")));
  }
  test::CanopenSettings settings = test::CanopenSettings::gateway();
  settings.drive().set("signals/lamp/source", "bus_in_bit_0");
  EXPECT_EQ("accepted", settings.refusal());
}

}  // namespace
}  // namespace nord_driver

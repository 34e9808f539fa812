// The configuration of a DeviceNet bus: what is accepted, what is refused and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "transport/devicenet/devicenet_settings.h"

namespace nord_driver {
namespace {

using devicenet::IoKind;
using std::chrono::milliseconds;
using test::MapSettings;
using Bus = test::DevicenetSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

// Factory settings: assembly 100/110 (P160 = 3), polled; four times 25 ms until the module gives up.
TEST(DevicenetConfigTest, HasItsDefaults) {
  const DevicenetConfig config = Bus{}.read();
  EXPECT_EQ("can0", config.interface);
  EXPECT_EQ(0, config.scanner.mac);
  EXPECT_EQ(0xFFFF, config.scanner.own.vendor_id);
  EXPECT_EQ(0x11223344u, config.scanner.own.serial_number);
  ASSERT_EQ(2u, config.scanner.nodes.size());
  const devicenet::NodeConfig& node = config.scanner.nodes[1];
  EXPECT_EQ(6, node.mac);
  EXPECT_EQ(IoKind::kPoll, node.io.kind);
  EXPECT_EQ(5u, node.io.input_bytes);
  EXPECT_EQ(5u, node.io.output_bytes);
  EXPECT_EQ(milliseconds{25}, node.io.expected_packet_rate.value());
  EXPECT_FALSE(node.vendor_id.has_value());
  const DevicenetDrive& drive = config.drives[1];
  EXPECT_EQ(1u, drive.module);
  EXPECT_EQ(DevicenetProfile::kNord, drive.drive_profile);
  EXPECT_EQ(DevicenetConnection::kGateway, drive.connection);
  EXPECT_EQ(1u, drive.control_offset) << "behind the module's own byte";
  EXPECT_EQ(1, drive.processValues());
  EXPECT_EQ(ParameterObjects::kNumbered, drive.parameter_objects);
}

TEST(DevicenetConfigTest, TakesWhatIsGiven) {
  Bus bus;
  bus.bus.set("mac_id", 62).set("vendor_id", 389).set("bit_rate", 250'000).set("expected_packet_rate", 0.05);
  bus.drive().set("io", "cos").set("assembly", 101).set("product_code", 7).set("parameter_objects", "index_object");
  bus.drive(1).set("io", "cyclic").set("assembly", 21);
  const DevicenetConfig config = bus.read();
  EXPECT_EQ(250'000u, config.bit_rate);
  EXPECT_EQ(62, config.scanner.mac);
  EXPECT_EQ(389, config.scanner.own.vendor_id);
  EXPECT_EQ(IoKind::kChangeOfState, config.scanner.nodes[0].io.kind);
  EXPECT_EQ(milliseconds{50}, config.scanner.nodes[0].io.expected_packet_rate.value());
  EXPECT_EQ(8u, config.scanner.nodes[0].io.output_bytes);
  EXPECT_EQ(7, config.scanner.nodes[0].product_code.value());
  EXPECT_EQ(3, config.drives[0].processValues());
  EXPECT_EQ(ParameterObjects::kIndexObject, config.drives[0].parameter_objects);
  EXPECT_EQ(IoKind::kCyclic, config.scanner.nodes[1].io.kind);
  EXPECT_EQ(4u, config.scanner.nodes[1].io.input_bytes);
  EXPECT_EQ(DevicenetProfile::kAcDriveExtended, config.drives[1].drive_profile);
}

TEST(DevicenetConfigTest, SerialNumberIsTheMachinesUnlessGiven) {
  Bus bus;
  bus.bus.erase("serial_number");
  const std::uint32_t serial = bus.read().scanner.own.serial_number;
  EXPECT_NE(0u, serial);
  EXPECT_EQ(serial, bus.read().scanner.own.serial_number);
}

// BU 0280 4.2.2: the bus module's byte, then four inverters with eight bytes each.
TEST(DevicenetConfigTest, InvertersBehindOneModuleShareItsMacId) {
  const DevicenetConfig config = Bus::gateway(4).read(50.0);
  ASSERT_EQ(1u, config.scanner.nodes.size());
  EXPECT_EQ(33u, config.scanner.nodes[0].io.input_bytes);
  EXPECT_EQ(1u, config.drives[0].control_offset);
  EXPECT_EQ(25u, config.drives[3].control_offset);
  EXPECT_EQ(25u, config.drives[3].status_offset);
}

// Of a fixed assembly the bytes of an inverter nobody configured stay.
TEST(DevicenetConfigTest, AnInverterAloneKeepsItsPlace) {
  Bus bus = Bus::gateway(1);
  bus.drive().set("inverter", 3);
  const DevicenetConfig config = bus.read(50.0);
  EXPECT_EQ(33u, config.scanner.nodes[0].io.output_bytes);
  EXPECT_EQ(17u, config.drives[0].control_offset);
}

// BU 0280 4.2.5, the example: P163 = {4, 8, 2}, whose first number is the status. The module's inputs, 21 bytes, are our
// outputs.
TEST(DevicenetConfigTest, VariableLengthsCloseUp) {
  Bus bus = Bus::gateway(3, 120);
  bus.drive().set("module_output_bytes", 1).set("module_input_bytes", 1);
  bus.drive(0).set("status_bytes", 8).set("control_bytes", 8);
  bus.drive(1).set("status_bytes", 4).set("control_bytes", 8);
  bus.drive(2).set("status_bytes", 4).set("control_bytes", 4).set("profile", "ac_drive");
  const DevicenetConfig config = bus.read(50.0);
  EXPECT_EQ(17u, config.scanner.nodes[0].io.input_bytes);
  EXPECT_EQ(21u, config.scanner.nodes[0].io.output_bytes);
  EXPECT_EQ(9u, config.drives[1].control_offset);
  EXPECT_EQ(9u, config.drives[1].status_offset);
  EXPECT_EQ(17u, config.drives[2].control_offset);
  EXPECT_EQ(13u, config.drives[2].status_offset);
  EXPECT_EQ(DevicenetProfile::kAcDrive, config.drives[2].drive_profile);
  EXPECT_EQ(1, config.drives[1].processValues());
}

// Of an odd length the last byte is half a value.
TEST(DevicenetConfigTest, VariableLengthsMayBeOdd) {
  Bus bus = Bus::gateway(2, 120);
  bus.drive(0).set("status_bytes", 5).set("control_bytes", 7);
  bus.drive(1).set("status_bytes", 7).set("control_bytes", 7);
  const DevicenetConfig config = bus.read(50.0);
  EXPECT_EQ(7u, config.drives[1].control_offset);
  EXPECT_EQ(5u, config.drives[1].status_offset);
  EXPECT_EQ(14u, config.scanner.nodes[0].io.output_bytes);
  EXPECT_EQ(12u, config.scanner.nodes[0].io.input_bytes);
  EXPECT_EQ(1, config.drives[0].processValues()) << "of the shorter way";
  EXPECT_EQ(2, config.drives[1].processValues());
}

// --- What cannot work ------------------------------------------------------------------------------------------------

TEST(DevicenetConfigTest, AMacIdIsThereOnce) {
  Bus bus;
  bus.drive(1).set("address", 5);
  EXPECT_EQ(
      "~drives/drive1/inverter: 1 is not valid, expected another one of 1 to 4 than drive \"drive0\" has at the "
      "same MAC id, 5; or another address",
      bus.refusal());
  bus.drive(0).set("address", MapSettings::Value{0});
  EXPECT_EQ("~drives/drive0/address: 0 is not valid, expected another MAC id than ours, ~bus/mac_id", bus.refusal());
  bus.drive(0).set("address", 64);
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("~drives/drive0/address: 64"), HasSubstr("from 0 to 63")));
}

TEST(DevicenetConfigTest, DeviceNetHasThreeBitRates) {
  Bus bus;
  bus.bus.set("bit_rate", 1'000'000);
  EXPECT_EQ("~bus/bit_rate: 1000000 is not valid, expected 125000, 250000 or 500000 bit/s, as DeviceNet has them",
            bus.refusal());
}

// 33 bytes each way are five frames: 1310 bits with the worst stuffing (facts, 5), 10.48 ms at 125 kbit/s.
TEST(DevicenetConfigTest, ABusTooSlowForItsCycleIsRefusedWithItsFigures) {
  Bus bus = Bus::gateway(4);
  bus.bus.set("bit_rate", 125'000);
  EXPECT_EQ(
      "~bus/bit_rate: 125000 bit/s is too slow for 4 drives at 100 Hz, their process data alone take up to 0.0105 s of "
      "each 0.01 s: expected a cycle_rate of at most 76 Hz, or the faster bit_rate the bus runs at",
      bus.refusal());
  EXPECT_EQ("accepted", bus.refusal(76.0));
  bus.bus.erase("bit_rate");
  EXPECT_THAT(bus.refusal(), HasSubstr("it is not configured, so the slowest is assumed"));
}

// BU 0280 4.2.1. A bit strobe carries no words: those go by a poll beside it, which may be longer.
TEST(DevicenetConfigTest, ABitStrobeBringsBackEightBytes) {
  Bus bus{1};
  bus.drive().set("io", "strobe");
  EXPECT_EQ("accepted", bus.refusal());
  EXPECT_EQ(devicenet::IoKind::kStrobe, bus.read().scanner.nodes[0].io.kind);
  bus.drive().set("assembly", 102);
  EXPECT_EQ(
      "~drives/drive0/io: \"strobe\" is not valid, expected poll, cos or cyclic: assembly 112 has 33 bytes, and a bit "
      "strobe brings back at most 8",
      bus.refusal());
  bus.drive().set("assembly", 120).set("status_bytes", 8).set("module_input_bytes", 1);
  EXPECT_THAT(bus.refusal(), HasSubstr("assembly 130 has 9 bytes, and a bit strobe brings back at most 8"));
  bus.drive().erase("module_input_bytes").set("control_bytes", 8).set("module_output_bytes", 1);
  EXPECT_EQ("accepted", bus.refusal());
}

TEST(DevicenetConfigTest, AnAssemblyTooShortForTheInverterIsNamed) {
  Bus bus = Bus::gateway(2, 100);
  EXPECT_EQ(
      "~drives/drive1/inverter: 2 is not valid, expected 1: assembly 100 has 5 bytes, which are those of one "
      "inverter; four need assembly 102 (P160 = 5) or 120 (P160 = 0)",
      bus.refusal());
}

TEST(DevicenetConfigTest, WhatTheAssemblyImpliesIsNotSetOtherwise) {
  Bus bus{1};
  bus.drive().set("assembly", 110);
  EXPECT_THAT(bus.refusal(), HasSubstr("assembly: 110 is not valid, expected 20, 21, 100, 101, 102 or 120"));
  bus.drive().set("assembly", 101).set("profile", "ac_drive");
  EXPECT_THAT(bus.refusal(), HasSubstr("assembly 101 implies it"));
  bus.drive().erase("profile").set("control_bytes", 4);
  EXPECT_THAT(bus.refusal(), HasSubstr("control_bytes: 4 is not valid, expected 8, as assembly 101 has them"));
  bus.drive().erase("control_bytes").set("module_output_bytes", 1);
  EXPECT_THAT(bus.refusal(), HasSubstr("module_output_bytes: 1 is not valid, expected 0, as assembly 101 has it"));
  bus.drive().erase("module_output_bytes").set("assembly", 120);
  for (const int bytes : {2, 3}) {
    bus.drive().set("control_bytes", bytes);
    EXPECT_THAT(bus.refusal(), HasSubstr("control_bytes: " + std::to_string(bytes) +
                                         " is not valid, expected 4 to 8, as P162 [-02] says: fewer than 4 bytes "
                                         "carry no setpoint or actual value"));
  }
  bus.drive().set("control_bytes", MapSettings::Value{0});
  EXPECT_THAT(bus.refusal(),
              HasSubstr("control_bytes: 0 is not valid, expected 4 to 8, as P162 [-02] says: 0 bytes are "
                        "those of an inverter that does not exist (BU 0280 4.2.5)"));
  bus.drive().set("profile", "ac_drive").set("control_bytes", 8);
  EXPECT_THAT(bus.refusal(), HasSubstr("expected 4: the AC drive profile has four bytes each way"));
}

TEST(DevicenetConfigTest, OneModuleHasItsSettingsOnce) {
  Bus bus = Bus::gateway(2);
  bus.drive(1).erase("assembly");
  EXPECT_EQ("accepted", bus.refusal(50.0)) << "said once is enough";
  bus.drive(0).set("io", "poll");
  bus.drive(1).set("io", "cos");
  EXPECT_THAT(bus.refusal(50.0), HasSubstr("~drives/drive1/io differs from that of drive \"drive0\""));
}

// A program for parameters has another one first than the driver.
TEST(DevicenetConfigTest, AnyInverterBehindAModuleSaysWhatIsTheModules) {
  for (const std::size_t says : {0u, 1u, 2u}) {
    Bus bus = Bus::gateway(3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (i != says) bus.drive(i).erase("assembly");
    }
    bus.drive(says).set("io", "cos").set("product_code", 7);
    ASSERT_EQ("accepted", bus.refusal(50.0)) << says;
    const DevicenetConfig config = bus.read(50.0);
    ASSERT_EQ(1u, config.modules.size());
    EXPECT_EQ(102u, config.modules[0].assembly) << says;
    EXPECT_EQ(IoKind::kChangeOfState, config.scanner.nodes[0].io.kind) << says;
    EXPECT_EQ(7, config.scanner.nodes[0].product_code.value_or(0)) << says;
    bus.drive(says).set("assembly", 99);
    EXPECT_THAT(bus.refusal(50.0), HasSubstr("~drives/drive" + std::to_string(says) + "/assembly: 99 is not valid"));
  }
  Bus bus = Bus::gateway(3);
  bus.drive(1).set("io", "cos");
  bus.drive(2).set("io", "cyclic");
  EXPECT_THAT(bus.refusal(50.0), HasSubstr("~drives/drive2/io differs from that of drive \"drive1\""));
}

TEST(DevicenetConfigTest, ASeriesSitsWhereItCan) {
  Bus bus{1};
  bus.drive().set("module", "sk_tu3");
  EXPECT_EQ(
      "~drives/drive0/module: \"sk_tu3\" is not valid, expected sk_cu4 or sk_tu4: this series is only behind "
      "SK CU4/TU4-DEV",
      bus.refusal());
  bus.drive().set("series", "sk700e");
  EXPECT_EQ("accepted", bus.refusal());
  bus.drive().set("inverter", 2).set("assembly", 102);
  EXPECT_THAT(bus.refusal(), HasSubstr("SK TU1/2/3-DEV has one inverter"));
  bus.drive().set("module", "sk_cu4");
  EXPECT_THAT(bus.refusal(), HasSubstr("expected sk_tu1, sk_tu2 or sk_tu3: this series is only behind SK TU1/2/3-DEV"));
}

TEST(DevicenetConfigTest, AMacIdIsSharedBehindOneGatewayOnly) {
  Bus bus{2};
  bus.drive(0).set("series", "sk700e");
  bus.drive(1).set("address", 5);
  EXPECT_EQ(
      "~drives/drive1/address: 5 is not valid, expected another MAC id than drive \"drive0\" has; only inverters "
      "behind one gateway share theirs",
      bus.refusal());
}

TEST(DevicenetConfigTest, AnExpectedPacketRateTooShortForTheCycleIsRefused) {
  Bus bus{1};
  bus.bus.set("expected_packet_rate", 0.004);
  EXPECT_THAT(bus.refusal(), AllOf(HasSubstr("4.0 ms"), HasSubstr("16.0 ms"), HasSubstr("10.0 ms")));
  bus.bus.set("expected_packet_rate", 0.0255);
  EXPECT_THAT(bus.refusal(), HasSubstr("whole milliseconds"));
}

}  // namespace
}  // namespace nord_driver

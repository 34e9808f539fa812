// Where words are in an assembly.
#include <gtest/gtest.h>

#include "profile/position_words.h"
#include "transport/devicenet/assembly.h"
#include "transport/devicenet/devicenet_settings.h"

namespace nord_driver {
namespace {

std::string packed(const DevicenetConfig& config, const std::vector<profile::ProcessOutput>& outputs) {
  devicenet::IoBytes bytes;
  bytes.resize(config.scanner.nodes[0].io.output_bytes);
  for (std::size_t i = 0; i < outputs.size(); ++i) packWords(config.drives[i], outputs[i], bytes);
  return toHex(ByteView{bytes});
}

// BU 0280 4.2.4: module outputs, control word, setpoint 1; low byte first. 047F is BU 0020 9.2's.
TEST(Assembly, OneHundredIsTheManuals) {
  const DevicenetConfig config = test::DevicenetSettings{1}.read();
  EXPECT_EQ("00 7F 04 00 20", packed(config, {{0x047F, {0x2000}}}));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackWords(config.drives[0], ByteView{fromHex("0F 37 0B 00 E0")}, input));
  EXPECT_EQ(0x0B37, input.status_word);
  EXPECT_EQ(-0x2000, input.actual_values[0]);
  EXPECT_EQ(0, input.actual_values[1]);
  EXPECT_FALSE(unpackWords(config.drives[0], ByteView{fromHex("0F 37 0B 00")}, input));
}

// BU 0280 4.2.1.1: control word; 32 bits, low low, low high, high low, high high byte; 16 bits. 100.000 revolutions.
TEST(Assembly, PositionsAreLittleEndian) {
  test::DevicenetSettings bus{1};
  bus.drive().set("assembly", 101);
  const DevicenetConfig config = bus.read();
  const profile::PositionWords words = profile::positionWords(config.drives[0].series, {23, 24, 1}, {10, 15, 1}, 3);
  profile::ProcessOutput output{0x047F, {0, 0, 0x2000}};
  profile::putPosition(words.setpoint, 100'000, output.setpoints);
  EXPECT_EQ("7F 04 A0 86 01 00 00 20", packed(config, {output}));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackWords(config.drives[0], ByteView{fromHex("37 0B FE FF FF FF 00 20")}, input));
  EXPECT_EQ(-2, profile::getPosition(words.actual, input.actual_values));
}

TEST(Assembly, FourInvertersStandOneBehindTheOther) {
  const DevicenetConfig config = test::DevicenetSettings::gateway(4).read(50.0);
  EXPECT_EQ("00 7E 04 01 00 02 00 03 00 7F 04 04 00 05 00 06 00 00 00 00 00 00 00 00 00 7B 04 00 00 00 00 00 C0",
            packed(config, {{0x047E, {1, 2, 3}}, {0x047F, {4, 5, 6}}, {0x0000, {}}, {0x047B, {0, 0, -16384}}}));
}

// P162 may be odd (BU 0280 4.2.5): the last byte is half a value.
TEST(Assembly, AnOddLengthEndsInAByteThatIsNotUsed) {
  test::DevicenetSettings bus = test::DevicenetSettings::gateway(2, 120);
  bus.drive(0).set("control_bytes", 5).set("status_bytes", 7);
  const DevicenetConfig config = bus.read(50.0);
  EXPECT_EQ("7F 04 01 00 00 7E 04 04 00", packed(config, {{0x047F, {1, 2, 3}}, {0x047E, {4, 5, 6}}}));
  profile::ProcessInput input;
  const auto bytes = fromHex("37 0B 01 00 02 00 FF 31 0B 04 00");
  ASSERT_TRUE(unpackWords(config.drives[0], ByteView{bytes}, input));
  EXPECT_EQ((profile::ProcessInput{0x0B37, {1, 2, 0}}), input);
  ASSERT_TRUE(unpackWords(config.drives[1], ByteView{bytes}, input));
  EXPECT_EQ((profile::ProcessInput{0x0B31, {4, 0, 0}}), input);
}

// As on every bus SK 300E, 700E and 750E have the third value before the second.
TEST(Assembly, SeriesDecidesTheOrderOfValues) {
  test::DevicenetSettings bus{1};
  bus.drive().set("series", "sk700e").set("assembly", 101);
  const DevicenetConfig config = bus.read();
  EXPECT_EQ("7F 04 01 00 03 00 02 00", packed(config, {{0x047F, {1, 2, 3}}}));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackWords(config.drives[0], ByteView{fromHex("37 0B 01 00 03 00 02 00")}, input));
  EXPECT_EQ(2, input.actual_values[1]);
  EXPECT_EQ(3, input.actual_values[2]);
}

// Of SK 700E behind its own module no manual at hand says it; BU 0280 4.2.2 has them in order, of SK 2xxE.
TEST(Assembly, ValuesAreInOrderWhereSoConfigured) {
  test::DevicenetSettings bus{1};
  bus.drive().set("series", "sk700e").set("assembly", 101).set("value_order", "in_order");
  const DevicenetConfig config = bus.read();
  EXPECT_EQ("7F 04 01 00 02 00 03 00", packed(config, {{0x047F, {1, 2, 3}}}));
  profile::ProcessInput input;
  ASSERT_TRUE(unpackWords(config.drives[0], ByteView{fromHex("37 0B 01 00 02 00 03 00")}, input));
  EXPECT_EQ(2, input.actual_values[1]);
  EXPECT_EQ(3, input.actual_values[2]);
}

// 32 bits of position take the places of setpoints 1 and 3 (BU 0020 7.3.1), which are beside each other: in bytes 2 to 5
// (BU 0280 4.2.1.1), whatever the order of single words is.
TEST(Assembly, ThirtyTwoBitsStayTogetherInEitherOrder) {
  test::DevicenetSettings bus{1};
  bus.drive().set("series", "sk700e").set("assembly", 101).set("value_order", "in_order").set("mode", "position");
  EXPECT_EQ("7F 04 01 00 03 00 02 00", packed(bus.read(), {{0x047F, {1, 2, 3}}}));
  bus.drive().set("position/bits", 16);
  EXPECT_EQ("7F 04 01 00 02 00 03 00", packed(bus.read(), {{0x047F, {1, 2, 3}}}));
}

// BU 0280 4.2.3.
TEST(Assembly, TheAcDriveProfileHasBitsAndASpeed) {
  test::DevicenetSettings bus{1};
  bus.drive().set("assembly", 21);
  const DevicenetDrive drive = bus.read().drives[0];
  devicenet::IoBytes bytes;
  bytes.resize(4);
  packAcDrive(drive, {0x61, 1500}, bytes);
  EXPECT_EQ("61 00 DC 05", toHex(ByteView{bytes}));
  profile::AcDriveInput input;
  ASSERT_TRUE(unpackAcDrive(drive, ByteView{fromHex("F4 04 DC 05")}, input));
  EXPECT_EQ(0xF4, input.status);
  EXPECT_EQ(4, input.state);
  EXPECT_EQ(1500, input.speed);
}

}  // namespace
}  // namespace nord_driver

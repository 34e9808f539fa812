// What the trace says beside each DeviceNet frame.
#include <gtest/gtest.h>

#include "core/can_trace.h"
#include "support/can_text.h"
#include "transport/devicenet/devicenet_frame_text.h"
#include "transport/devicenet/devicenet_settings.h"

namespace nord_driver {
namespace {

DevicenetConfig config() {
  test::DevicenetSettings bus{4};
  bus.drive(0).set("address", 9);
  bus.drive(1).set("assembly", 21);
  bus.drive(2).set("address", 7).set("assembly", 120).set("inverter", 1);
  bus.drive(3).set("address", 7).set("inverter", 2);
  return bus.read();
}
std::string textOf(const CanFrame& frame) {
  TraceRecord record;
  const CanPacket packet = toPacket(frame);
  const ByteView bytes{packet};
  record.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), record.bytes.begin());
  static const DevicenetFrameText kText{config()};
  return kText(record);
}
std::string textOf(const std::string& candump) {
  return textOf(nord_driver::frame(candump));
}

TEST(DevicenetFrameTextTest, ProcessDataAreToldByTheManualsNames) {
  EXPECT_EQ("poll 9 STW 047F SW1 2000", textOf("44D#007F040020"));
  EXPECT_EQ("answer 9 ZSW 0B37 IW1 2000", textOf("3C9#00370B0020"));
  EXPECT_EQ("data 9 ZSW 0B31 IW1 0000", textOf("349#00310B0000"));
  EXPECT_EQ("acknowledge or empty answer 9", textOf("3C9#"));
  EXPECT_EQ("poll 9 too short", textOf("44D#007F"));
  EXPECT_EQ("poll 6 bits 61 state 0 1500 rpm", textOf("435#6100DC05"));
  EXPECT_EQ("answer 6 bits F4 state 4 1500 rpm", textOf("3C6#F404DC05"));
  EXPECT_EQ("poll 7 inverter 1 STW 047F SW1 0001 inverter 2 STW 047E SW1 0000", textOf("43D#7F0401007E040000"));
  EXPECT_EQ("acknowledge to 9", textOf("44A#"));
}

// The facts' golden vectors (ICP DAS: master 0Ah, slave 9).
TEST(DevicenetFrameTextTest, ConnectionsAreTold) {
  EXPECT_EQ("explicit 9 allocate explicit, poll, bit strobe for MAC id 10", textOf("44E#0A4B0301070A"));
  EXPECT_EQ("explicit 9 allocated", textOf("44B#0ACB00"));
  EXPECT_EQ("explicit 9 release explicit, poll", textOf("44E#0A4C030103"));
  EXPECT_EQ("explicit 9 write class 5 instance 2 attribute 9 = 0E0Ah", textOf("44C#0A100502090A0E"));
  EXPECT_EQ("explicit 9 written 0E10h", textOf("44B#0A90100E"));
}

// BU 0280 4.3.9: FI 4, P103, sub-index 2.
TEST(DevicenetFrameTextTest, ParametersAreNamed) {
  EXPECT_EQ("explicit 9 read class 131 instance 3 attribute 3 (P103 of inverter 4)", textOf("44C#0A0E830303"));
  EXPECT_EQ("explicit 9 answer 0064h", textOf("44B#0A8E6400"));
  EXPECT_EQ("explicit 9 read class 181 instance 1 attribute 51 (P151 of the module)", textOf("44C#0A0EB50133"));
  EXPECT_EQ("explicit 9 DeviceNet error 14h, the attribute is not supported", textOf("44B#0A9414FF"));
  EXPECT_EQ("explicit 9 fragment 1, last", textOf("44B#8A8100"));
}

TEST(DevicenetFrameTextTest, TheDuplicateMacCheckIsTold) {
  EXPECT_EQ("is MAC id 0 free? vendor 65535 serial 11223344", textOf("407#00FFFF44332211"));
  EXPECT_EQ("MAC id 5 is taken, vendor 389 serial 00000001", textOf("42F#80850101000000"));
}

TEST(DevicenetFrameTextTest, EachChoiceOfAConnectionHasItsName) {
  EXPECT_EQ("explicit 9 allocate multicast poll, change of state, cyclic, no acknowledges for MAC id 10",
            textOf("44E#0A4B0301780A"));
  EXPECT_EQ("explicit 9 release nothing", textOf("44E#0A4C030100"));
  EXPECT_EQ("explicit 9 released", textOf("44B#0ACC"));
}

TEST(DevicenetFrameTextTest, WhatIsTooShortIsNotRead) {
  EXPECT_EQ("explicit 9 too short", textOf("44C#0A"));
  EXPECT_EQ("explicit 9 too short", textOf("44C#0A0E"));
  EXPECT_EQ("explicit 9 service 75 class 3 instance 1", textOf("44E#0A4B0301"));
  EXPECT_EQ("explicit 9 service 76 class 3 instance 1", textOf("44E#0A4C0301"));
  EXPECT_EQ("explicit 9 read class 3 instance 1", textOf("44E#0A0E0301"));
  EXPECT_EQ("explicit 9 answer 14h", textOf("44B#0A9414")) << "an error has two codes";
  EXPECT_EQ("explicit 9 answer", textOf("44B#0A8E"));
  EXPECT_EQ("duplicate-MAC message of a wrong length, 5", textOf("42F#8085"));
  EXPECT_EQ("no frame", DevicenetFrameText{config()}(TraceRecord{}));
}

TEST(DevicenetFrameTextTest, OtherKindsOfMessagesAreNamed) {
  EXPECT_EQ("strobe by MAC id 1", textOf("408#0000000000000000"));
  EXPECT_EQ("multicast poll 1", textOf("409#00"));
  EXPECT_EQ("strobe answer 9 ZSW 0B37 IW1 2000", textOf("389#00370B0020"));
  EXPECT_EQ("explicit 9 fragment, the only one", textOf("44B#8A3F00"));
  EXPECT_EQ("explicit 9 fragment 2, acknowledge", textOf("44B#8AC200"));
  EXPECT_EQ("explicit 9 service 5 class 1 instance 1", textOf("44C#0A050101"));
}

TEST(DevicenetFrameTextTest, WhatIsNotOursIsSaidToBeSo) {
  EXPECT_EQ("poll 20 of no device of ours", textOf("4A5#00"));
  EXPECT_EQ("group 3 message 6: of no device of ours", textOf("785#00"));
  EXPECT_EQ("no identifier of DeviceNet", textOf("7F5#00"));
  EXPECT_EQ("remote frame: DeviceNet has none", textOf("3C9#R1"));
  CanFrame extended = dataFrame(0x18DAF110, {});
  extended.extended = true;
  EXPECT_EQ("29 bit identifier: not DeviceNet", textOf(extended));
}

}  // namespace
}  // namespace nord_driver

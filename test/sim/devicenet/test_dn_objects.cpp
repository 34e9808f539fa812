// Objects of the module and its inverters by explicit messages, whole and in fragments: BU 0280 4.3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

class DnObjectsTest : public testing::Test {
 protected:
  void allocate(DnConversation& bus) {
    bus.goOnline();
    ASSERT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 01 0A"));
  }
  /// A request of more than seven bytes in fragments of six; the answers, acknowledges included.
  DnConversation::Texts inFragments(DnConversation& bus, const std::string& body) {
    const std::vector<std::uint8_t> bytes = fromHex(body);
    DnConversation::Texts all;
    for (std::size_t at = 0, count = 0; at < bytes.size(); at += 6, ++count) {
      const bool last = at + 6 >= bytes.size();
      const unsigned kind = at == 0 ? 0x00 : last ? 0x80 : 0x40;
      FixedBytes<8> data{0x8A, static_cast<std::uint8_t>(kind | count)};
      for (std::size_t i = at; i < std::min(at + 6, bytes.size()); ++i) data.push_back(bytes[i]);
      bus.bus.send(dataFrame(0x44C, data));
      for (const std::string& text : bus.takeAfter(milliseconds(20))) all.push_back(text);
    }
    return all;
  }
};

TEST_F(DnObjectsTest, IdentityAndDeviceNetObject) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("8EE803", bus.request("0E 01 01 01"));
  EXPECT_EQ("8E0200", bus.request("0E 01 01 02"));
  EXPECT_EQ("8E0102", bus.request("0E 01 01 04"));
  EXPECT_EQ("8E0500", bus.request("0E 01 01 05")) << "owned, configured";
  bus.drive().inverter().trip(30, false);
  EXPECT_EQ("8E0501", bus.request("0E 01 01 05")) << "one inverter has an error";
  EXPECT_EQ("8E09", bus.request("0E 03 01 01"));
  EXPECT_EQ("8E02", bus.request("0E 03 01 02")) << "500 kbit/s";
  EXPECT_EQ("8E010A", bus.request("0E 03 01 05"));
  EXPECT_EQ("90", bus.request("10 03 01 04 00"));
  EXPECT_EQ("9409FF", bus.request("10 03 01 04 01")) << "can only be written with 0";
  EXPECT_EQ("9414FF", bus.request("0E 01 01 0A")) << "no heartbeat interval";
  EXPECT_EQ("9408FF", bus.request("01 01 01")) << "no get all";
  EXPECT_EQ("9416FF", bus.request("0E 63 01 01"));
}

// "SK TU3-DEV" and its length are 12 bytes of an answer: two fragments, each acknowledged.
TEST_F(DnObjectsTest, AnswerInFragments) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("44B#8A008E0A534B2054", bus.ask("44C#0A 0E 01 01 07"));
  EXPECT_EQ("44B#8A8155332D444556", bus.ask("44C#8A C0 00"));
  EXPECT_EQ("", bus.ask("44C#8A C1 00"));
  EXPECT_EQ("8E09", bus.request("0E 03 01 01"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// A second, once more, a second, given up.
TEST_F(DnObjectsTest, FragmentThatNobodyAcknowledges) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("44B#8A008E0A534B2054", bus.ask("44C#0A 0E 01 01 07"));
  EXPECT_THAT(bus.takeAfter(milliseconds(1020)), ElementsAre("44B#8A008E0A534B2054"));
  EXPECT_THAT(bus.takeAfter(milliseconds(3000)), IsEmpty());
  EXPECT_LE(1u, bus.referee().count(DnRule::kFragmentUnacknowledged));
}

// Writing instance 101 takes twelve bytes: 10 04 65 03 and eight of data.
TEST_F(DnObjectsTest, RequestInFragments) {
  DnConversation bus{dnGateway(1, 101)};
  allocate(bus);
  EXPECT_THAT(inFragments(bus, "10 04 65 03 7E 04 00 20 00 00 00 00"),
              ElementsAre("44B#8AC000", "44B#8AC100", "44B#0A90"));
  bus.bus.run(milliseconds(300));
  EXPECT_EQ(InverterState::kReadyToSwitchOn, bus.drive().inverter().state());
  EXPECT_THAT(inFragments(bus, "10 04 66 03 7E 04 00 20 00 00 00 00"),
              ElementsAre("44B#8AC000", "44B#8AC100", "44B#0A940CFF"))
      << "not the active instance";
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(DnObjectsTest, FragmentsThatComeTwiceOrNotAtAll) {
  DnConversation bus{dnGateway(1, 101)};
  allocate(bus);
  EXPECT_EQ("44B#8AC000", bus.ask("44C#8A 00 10 04 65 03 7E 04"));
  EXPECT_EQ("44B#8AC000", bus.ask("44C#8A 00 10 04 65 03 7E 04")) << "acknowledged again";
  EXPECT_EQ("", bus.ask("44C#8A 82 00 00"));
  EXPECT_EQ("", bus.ask("44C#8A 81 00 20 00 00 00 00")) << "given up";
}

// FI 1, P103: class 101, attribute 3, instance 1; FI 4, P103, sub-index 2: class 131, instance 3 (BU 0280 4.3.9).
TEST_F(DnObjectsTest, ParametersByClass) {
  DnConversation bus{dnGateway(4, 102)};
  allocate(bus);
  bus.drive(3).parameters().preset(103, 2, 0, 345);
  EXPECT_EQ("8EC800", bus.request("0E 65 01 03"));
  EXPECT_EQ("8E5901", bus.request("0E 83 03 03"));
  EXPECT_EQ("90", bus.request("10 83 03 03 64 00"));
  EXPECT_EQ(100, bus.drive(3).parameters().value(103, 2));
  EXPECT_EQ(1u, bus.drive(3).parameters().eepromWrites());
  EXPECT_EQ("90", bus.request("10 69 01 3C 00 00")) << "P560 = 0: RAM only";
  bus.request("10 65 01 03 64 00");
  EXPECT_EQ(1u, bus.drive(0).parameters().eepromWrites());
  EXPECT_EQ("9409FF", bus.request("10 65 01 05 00 00")) << "P105 = 0";
  EXPECT_EQ("940EFF", bus.request("10 6B 01 00 00 00")) << "P700";
  EXPECT_EQ("9414FF", bus.request("0E 65 01 01")) << "P101";
  EXPECT_EQ("9416FF", bus.request("0E 65 05 05")) << "no fifth set";
  EXPECT_EQ("9413FF", bus.request("10 65 01 05 00"));
  EXPECT_EQ("9415FF", bus.request("10 65 01 05 00 00 00"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

// P151 is class 181, attribute 51; P162[-03] instance 3.
TEST_F(DnObjectsTest, ParametersOfTheModule) {
  DnConversation bus{dnGateway()};
  allocate(bus);
  EXPECT_EQ("90", bus.request("10 B5 01 33 F4 01"));
  EXPECT_EQ(500, bus.module().parameters().value(151));
  EXPECT_EQ("8E0300", bus.request("0E B5 01 3C")) << "P160";
  EXPECT_EQ("90", bus.request("10 B5 03 3E 02 00"));
  EXPECT_EQ(2, bus.module().parameters().value(162, 0, 2));
  EXPECT_EQ("8E0900", bus.request("0E B5 01 50")) << "P180";
  EXPECT_EQ("8E0200", bus.request("0E B5 01 51")) << "P181";
  EXPECT_EQ("940EFF", bus.request("10 B5 01 46 00 00")) << "P170";
  DnConversation own;
  allocate(own);
  EXPECT_EQ("9416FF", own.request("0E B5 01 33")) << "a technology unit has no parameters of its own";
}

// Number and index first, then the value in 16 or 32 bits; number 0 is always answered well (BU 0280 4.3.10).
TEST_F(DnObjectsTest, IndexObject) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("90", bus.request("10 C7 04 03 01 00")) << "parameter 0 of an inverter that is not there";
  EXPECT_EQ("90", bus.request("10 C7 01 01 69 00"));
  EXPECT_EQ("90", bus.request("10 C7 01 02 02"));
  bus.drive().parameters().preset(105, 2, 0, 700);
  EXPECT_EQ("8EBC02", bus.request("0E C7 01 03"));
  EXPECT_EQ("9415FF", bus.request("0E C7 01 04")) << "32 bits of a 16 bit parameter";
  EXPECT_EQ("90", bus.request("10 C7 01 01 65 02")) << "P613";
  bus.drive().parameters().preset(613, 0, 2, -2);
  EXPECT_EQ("8EFEFFFFFF", bus.request("0E C7 01 04"));
}

TEST_F(DnObjectsTest, InverterThatIsNotThere) {
  DnConversation bus{dnGateway()};
  allocate(bus);
  EXPECT_EQ("9402FF", bus.request("0E 6F 01 05")) << "FI 2 never was";
  bus.drive().setInverterPower(false);
  EXPECT_EQ("9402FF", bus.request("0E 65 01 05"));
  EXPECT_EQ("9402FF", bus.request("0E 29 01 06"));
  EXPECT_EQ(0x0302, bus.module().parameters().value(173)) << "owned; FI 1 lost or switched off";
  bus.drive().setInverterPower(true);
  bus.drive().setInverterLink(false);
  EXPECT_EQ("9402FF", bus.request("0E 65 01 05"));
}

TEST_F(DnObjectsTest, WhatAnExperimenterDoes) {
  DnConversation bus;
  allocate(bus);
  ParameterSwitches switches;
  switches.refuse = PkwRefusal{2, 105};
  bus.drive().setParameterSwitches(switches);
  EXPECT_EQ("9409FF", bus.request("0E 65 01 05"));
  EXPECT_EQ("8EC800", bus.request("0E 65 01 03"));
  switches = {};
  switches.silent = true;
  bus.drive().setParameterSwitches(switches);
  EXPECT_EQ("", bus.request("0E 65 01 03"));
  EXPECT_EQ("8E09", bus.request("0E 03 01 01")) << "the module itself lives";
  switches = {};
  switches.delay = 50;
  bus.drive().setParameterSwitches(switches);
  bus.bus.run(milliseconds(600));
  EXPECT_EQ("", bus.request("0E 65 01 03"));
  EXPECT_THAT(bus.takeAfter(milliseconds(50)), ElementsAre("44B#0A8EC800"));
}

TEST_F(DnObjectsTest, MotorSupervisorAndDrive) {
  DnConversation bus;
  allocate(bus);
  bus.bus.run(milliseconds(500));
  EXPECT_EQ("8E07", bus.request("0E 28 01 03")) << "asynchronous";
  EXPECT_EQ("8E0400", bus.request("0E 28 01 0C")) << "two pole pairs";
  EXPECT_EQ("90", bus.request("10 28 01 06 2A 00"));
  EXPECT_EQ("8E2A00", bus.request("0E 28 01 06"));
  EXPECT_EQ("8ED007", bus.request("0E 2A 01 12")) << "P102 = 2.00 s";
  EXPECT_EQ("8EDC05", bus.request("0E 2A 01 15")) << "1500 rpm at P105";
  EXPECT_EQ("8E02", bus.request("0E 29 01 06")) << "not ready: switch-on disabled";
  for (const char* order : {"10 29 01 05 01", "10 2A 01 04 01", "10 2A 01 08 EE 02"}) {
    EXPECT_EQ("90", bus.request(order)) << order;
  }
  EXPECT_EQ("8E03", bus.request("0E 29 01 06")) << "ready";
  EXPECT_EQ("90", bus.request("10 29 01 03 01"));
  bus.bus.run(milliseconds(3000));
  EXPECT_NEAR(25.0, bus.drive().inverter().frequency(), 0.1);
  EXPECT_EQ("8E04", bus.request("0E 29 01 06")) << "enabled";
  EXPECT_EQ("8E01", bus.request("0E 2A 01 03")) << "at reference";
  bus.drive().inverter().trip(102, false);
  bus.bus.run(milliseconds(5000));
  EXPECT_EQ("8E07", bus.request("0E 29 01 06"));
  EXPECT_EQ("8E6600", bus.request("0E 29 01 0D"));
  EXPECT_EQ("940EFF", bus.request("10 29 01 06 01"));
}

TEST_F(DnObjectsTest, AcknowledgeHandler) {
  DnConversation bus;
  allocate(bus);
  EXPECT_EQ("8E1000", bus.request("0E 2B 01 01"));
  EXPECT_EQ("90", bus.request("10 2B 01 01 14 00"));
  EXPECT_EQ("8E1400", bus.request("0E 2B 01 01"));
  EXPECT_EQ("9409FF", bus.request("10 2B 01 01 00 00"));
  EXPECT_EQ("8E0400", bus.request("0E 2B 01 03"));
}

}  // namespace
}  // namespace nord_driver::sim

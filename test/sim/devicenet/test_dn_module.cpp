// Start, allocation, connections: the golden vectors of ICP DAS (scanner 0Ah, slave 9), and what follows from the
// rules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

// Two requests a second apart, a second more; nothing is answered before.
TEST(DnModule, DuplicateMacCheck) {
  SimConfig config = oneDnDrive();
  DnModuleSettings settings;
  settings.mac = 9;
  settings.identity.vendor = 0x1234;
  settings.identity.serial = 0x89ABCDEF;
  config.bus.as<DnBusConfig>().modules.push_back(settings);
  DnConversation bus{config};
  EXPECT_THAT(bus.takeAfter(milliseconds(500)), ElementsAre("44F#003412EFCDAB89"));
  EXPECT_EQ("", bus.ask("44E#0A 4B 03 01 01 0A"));
  EXPECT_THAT(bus.takeAfter(seconds(1)), ElementsAre("44F#003412EFCDAB89"));
  EXPECT_EQ("", bus.ask("44E#0A 4B 03 01 01 0A"));
  EXPECT_THAT(bus.takeAfter(seconds(1)), IsEmpty());
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 01 0A"));
  EXPECT_EQ("44F#803412EFCDAB89", bus.ask("44F#00 FF FF 01 00 00 00")) << "on-line it answers those of others";
}

TEST(DnModule, SecondNodeWithItsMacId) {
  DnConversation bus{dnGateway()};
  bus.bus.run(milliseconds(500));
  bus.bus.inject(nord_driver::frame("44F#00 FF FF 01 00 00 00"));
  bus.bus.run(seconds(3));
  EXPECT_EQ(DnModule::Phase::kCommunicationFault, bus.module().phase());
  EXPECT_EQ(5211, bus.module().parameters().value(170)) << "address already allocated, BU 0280 6.2.2";
  EXPECT_EQ(8, bus.module().parameters().value(173) & 8);
  EXPECT_EQ("", bus.ask("44E#0A 4B 03 01 01 0A"));
}

// 44E `0A 4B 03 01 07 0A` -> 44B `0A CB 00`; 44C `0A 10 05 02 09 0A 0E` -> 44B `0A 90 10 0E`.
TEST(DnModule, GoldenAllocationAndRoundedPacketRate) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 07 0A"));
  EXPECT_EQ("44B#0A90100E", bus.ask("44C#0A 10 05 02 09 0A 0E"));
  EXPECT_EQ(3600, bus.module().connections()[DnConnectionKind::kPoll].packet_rate);
  EXPECT_EQ("8E100E", bus.request("0E 05 02 09"));
  EXPECT_EQ("8E070A", bus.request("0E 03 01 05")) << "allocation: choice, then whose";
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 07"));
  EXPECT_EQ("", bus.ask("44C#0A 0E 03 01 05"));
  EXPECT_EQ(dn::kNoMac, bus.module().connections().owner());
}

TEST(DnModule, AllocationsThatCannotBe) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0A940902", bus.ask("44E#0A 4B 03 01 00 0A")) << "nothing chosen";
  EXPECT_EQ("44B#0A940902", bus.ask("44E#0A 4B 03 01 31 0A")) << "change of state and cyclic";
  EXPECT_EQ("44B#0A940902", bus.ask("44E#0A 4B 03 01 41 0A")) << "suppresses nothing";
  EXPECT_EQ("44B#0A940C02", bus.ask("44E#0A 4B 03 01 02 0A")) << "group 2 only: explicit first";
  EXPECT_EQ("44B#0A9416FF", bus.ask("44E#0A 4B 04 01 01 0A"));
  EXPECT_EQ("44B#0A940803", bus.ask("44E#0A 0E 03 01 05"));
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 03 0A"));
  EXPECT_EQ("44B#0A940B02", bus.ask("44E#0A 4B 03 01 03 0A")) << "already";
  EXPECT_EQ("44B#0B940C01", bus.ask("44E#0B 4B 03 01 01 0B")) << "conflict: another scanner has it";
  EXPECT_EQ("44B#0B940C01", bus.ask("44E#0B 4C 03 01 03"));
  EXPECT_EQ(10, bus.module().connections().owner());
}

// It dies after four times 2500 ms without a message, and with it what does not run.
TEST(DnModule, ExplicitConnectionDiesOfIdleness) {
  DnConversation bus;
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 03 0A");
  EXPECT_EQ("8EC409", bus.request("0E 05 01 09"));
  bus.bus.run(milliseconds(9900));
  EXPECT_EQ("8E09", bus.request("0E 03 01 01"));
  bus.bus.run(milliseconds(10100));
  EXPECT_EQ("", bus.ask("44C#0A 0E 03 01 01"));
  EXPECT_EQ(dn::kNoMac, bus.module().connections().owner());
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 03 0A"));
}

// While I/O runs the explicit connection goes alone.
TEST(DnModule, IoLivesOnWithoutTheExplicitConnection) {
  DnConversation bus;
  bus.connect();
  bus.poll("44D#00 7E 04 00 00", milliseconds(11000));
  EXPECT_EQ(2, bus.module().connections().choice());
  EXPECT_TRUE(bus.module().inDataExchange());
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 01 0A"));
}

TEST(DnModule, ConnectionObject) {
  DnConversation bus;
  bus.goOnline();
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 03 0A"));
  EXPECT_EQ("8E03", bus.request("0E 05 01 01")) << "explicit: established";
  EXPECT_EQ("8E01", bus.request("0E 05 02 01")) << "poll: configuring";
  EXPECT_EQ("8E0500", bus.request("0E 05 02 07"));
  EXPECT_EQ("8E0500", bus.request("0E 05 02 08"));
  EXPECT_EQ("8EC903", bus.request("0E 05 02 04")) << "3C9h";
  EXPECT_EQ("8E4D04", bus.request("0E 05 02 05")) << "44Dh";
  EXPECT_EQ("8E2004246E3003", bus.request("0E 05 02 0E")) << "assembly 110, attribute 3";
  EXPECT_EQ("940EFF", bus.request("10 05 02 07 08 00")) << "only the packet rate is settable";
  EXPECT_EQ("9413FF", bus.request("10 05 02 09 64"));
  EXPECT_EQ("9416FF", bus.request("0E 05 03 01")) << "no strobe was allocated";
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00")) << "no packet rate yet";
  EXPECT_EQ("906400", bus.request("10 05 02 09 64 00"));
  EXPECT_EQ("8E03", bus.request("0E 05 02 01"));
}

// Master and module start anew: what was allocated is gone with the supply.
TEST(DnModule, SupplyOfTheModule) {
  DnConversation bus{dnGateway()};
  bus.connect();
  EXPECT_NE("", bus.ask("44D#00 7E 04 00 00"));
  bus.module().setPowered(false);
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00"));
  EXPECT_EQ(109, bus.drive().inverter().faultNumber()) << "E10.9 by P120";
  bus.module().setPowered(true);
  EXPECT_THAT(bus.takeAfter(milliseconds(2500)), testing::SizeIs(2)) << "its duplicate-MAC requests";
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00"));
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 03 0A"));
}

TEST(DnModule, MuteAndLate) {
  DnConversation bus;
  bus.connect();
  bus.drive().setMute(true);
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00"));
  bus.drive().setMute(false);
  bus.drive().setAnswerDelay(milliseconds(30));
  EXPECT_EQ("", bus.ask("44D#00 7E 04 00 00"));
  EXPECT_THAT(bus.takeAfter(milliseconds(20)), testing::SizeIs(1));
}

}  // namespace
}  // namespace nord_driver::sim

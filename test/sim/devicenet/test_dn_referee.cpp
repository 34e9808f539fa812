#include <gtest/gtest.h>

#include "sim/devicenet/dn_conversation.h"

namespace nord_driver::sim {
namespace {

using std::chrono::milliseconds;

class DnRefereeTest : public testing::Test {
 protected:
  /// How often `rule` was broken, when nothing else was.
  std::uint64_t only(DnRule rule) {
    bus.bus.run(milliseconds(20));
    const std::uint64_t count = bus.referee().total() == bus.referee().count(rule) ? bus.referee().count(rule) : 0;
    said = bus.referee().report();
    bus.referee().forget();
    return count;
  }
  /// Two of them, `pause` after each other, to a module that is off meanwhile.
  std::uint64_t brokenByRequestsToNobody(Duration pause) {
    bus.connect();
    bus.module().setPowered(false);
    bus.send("44C#0A 0E 65 01 05");
    bus.bus.run(pause);
    bus.send("44C#0A 0E 65 01 05");
    bus.module().setPowered(true);
    return only(DnRule::kExplicitWhilePending);
  }

  DnConversation bus;
  std::string said;
};

TEST_F(DnRefereeTest, StartsWithTheDuplicateMacCheck) {
  bus.send("44E#0A 4B 03 01 01 0A");
  EXPECT_EQ(1u, only(DnRule::kBeforeDuplicateCheck)) << said;
  bus.send("457#00 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(1000));
  bus.send("44E#0A 4B 03 01 01 0A");
  EXPECT_EQ(1u, only(DnRule::kBeforeDuplicateCheck)) << "one request";
  bus.send("457#00 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(500));
  bus.send("44E#0A 4B 03 01 01 0A");
  EXPECT_EQ(1u, only(DnRule::kBeforeDuplicateCheck)) << "half a second";
  bus.bus.run(milliseconds(500));
  bus.send("44E#0A 4B 03 01 01 0A");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(DnRefereeTest, RequestsTooSoonAfterEachOther) {
  bus.send("457#00 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(500));
  bus.send("457#00 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(1100));
  EXPECT_TRUE(bus.referee().content()) << "it may have begun anew";
  bus.send("44E#0A 4B 03 01 01 0A");
  EXPECT_EQ(1u, only(DnRule::kBeforeDuplicateCheck)) << said;
}

// Whatever it has asked before, it is on-line after two requests a second apart, and a second more.
TEST_F(DnRefereeTest, RequestsThatBeginAnew) {
  for (const int pause : {1000, 160, 1000, 1000}) {
    bus.send("457#00 FF FF 01 00 00 00");
    bus.bus.run(milliseconds(pause));
  }
  bus.send("457#00 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(1001));
  bus.send("44E#0A 4B 03 01 01 0A");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(DnRefereeTest, LengthOfTheDuplicateMacMessage) {
  bus.send("457#00 FF FF 01 00");
  EXPECT_EQ(1u, only(DnRule::kDuplicateMacLength)) << said;
}

TEST_F(DnRefereeTest, SomebodyElseAsksForItsMacId) {
  bus.goOnline();
  bus.bus.inject(nord_driver::frame("457#00 34 12 02 00 00 00"));
  bus.bus.run(milliseconds(50));
  bus.send("457#80 FF FF 01 00 00 00");
  bus.bus.run(milliseconds(1000));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.bus.inject(nord_driver::frame("457#00 34 12 02 00 00 00"));
  bus.bus.run(milliseconds(600));
  EXPECT_EQ(1u, only(DnRule::kDuplicateMacUnanswered)) << said;
}

TEST_F(DnRefereeTest, Identifiers) {
  bus.goOnline();
  CanFrame frame = nord_driver::frame("44E#0A 4B 03 01 01 0A");
  frame.extended = true;
  bus.bus.send(frame);
  EXPECT_EQ(1u, only(DnRule::kExtendedFrame)) << said;
  bus.bus.send(remoteFrame(0x44E, 4));
  EXPECT_EQ(1u, only(DnRule::kRemoteFrame)) << said;
  for (const char* text : {"3C9#00", "44B#0A 90", "44F#00 FF FF 01 00 00 00"}) bus.send(text);
  EXPECT_EQ(3u, only(DnRule::kIdOfANode)) << said;
  for (const char* text : {"7F0#", "70A#00", "454#0A 0E 01 01 01"}) bus.send(text);
  EXPECT_EQ(3u, only(DnRule::kUnknownId)) << said;
  bus.send("42E#0A 4B 03 01 01 0A");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << "asking for a slave that is not there: " << bus.referee().report();
}

TEST_F(DnRefereeTest, Allocation) {
  bus.goOnline();
  for (const char* choice : {"00", "09", "81", "31", "41"}) bus.send(std::string("44E#0A 4B 03 01 ") + choice + " 0A");
  EXPECT_EQ(5u, only(DnRule::kChoice)) << said;
  bus.send("44E#0A 4B 03 01 02 0A");
  EXPECT_EQ(1u, only(DnRule::kAllocateWithoutExplicit)) << said;
  bus.send("44E#0B 4B 03 01 01 0A");
  EXPECT_EQ(1u, only(DnRule::kHeaderMac)) << said;
  bus.send("44E#0A 4C 03 01 01");
  EXPECT_EQ(0u, only(DnRule::kReleaseChoice)) << "what it was given";
  bus.send("44E#0A 4B 03 01 01 0B");
  EXPECT_EQ(1u, only(DnRule::kSecondMaster)) << said;
  bus.send("44E#0A 0E 03 01 01");
  EXPECT_EQ(1u, only(DnRule::kUnconnectedService)) << said;
  bus.send("44E#0A 4B 03 01 01");
  EXPECT_EQ(1u, only(DnRule::kExplicitLength)) << said;
}

// A scanner that was killed left its connections behind: it may ask whose they are, on either port.
TEST_F(DnRefereeTest, ConnectionsOfBefore) {
  bus.connect();
  bus.goOnline();
  EXPECT_EQ("44B#0A940B02", bus.ask("44E#0A 4B 03 01 01 0A"));
  EXPECT_EQ("44B#0A940803", bus.ask("44E#0A 0E 03 01 05"));
  EXPECT_EQ("44B#0A8E030A", bus.ask("44C#0A 0E 03 01 05"));
  EXPECT_EQ("44B#0ACC", bus.ask("44E#0A 4C 03 01 03"));
  EXPECT_EQ("44B#0ACB00", bus.ask("44E#0A 4B 03 01 01 0A"));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(DnRefereeTest, ReleaseOfWhatIsNotAllocated) {
  bus.connect();
  bus.send("44E#0A 4C 03 01 07");
  EXPECT_EQ(1u, only(DnRule::kReleaseChoice)) << said;
}

TEST_F(DnRefereeTest, ASecondScanner) {
  bus.goOnline();
  bus.send("45F#00 FF FF 02 00 00 00");
  EXPECT_EQ(1u, only(DnRule::kSecondMaster)) << said;
}

TEST_F(DnRefereeTest, ExplicitMessages) {
  bus.goOnline();
  bus.send("44C#0A 0E 01 01 01");
  EXPECT_EQ(1u, only(DnRule::kExplicitBeforeAllocation)) << said;
  bus.ask("44E#0A 4B 03 01 01 0A");
  bus.send("44C#0B 0E 01 01 01");
  EXPECT_EQ(1u, only(DnRule::kHeaderMac)) << said;
  bus.bus.run(milliseconds(600));
  bus.send("44C#0A 0E 65 01 05");
  bus.send("44C#0A 0E 65 01 03");
  EXPECT_EQ(1u, only(DnRule::kExplicitWhilePending)) << said;
  bus.send("44C#0A 0E");
  EXPECT_EQ(1u, only(DnRule::kExplicitLength)) << said;
  bus.bus.run(milliseconds(600));
  bus.drive().setMute(true);
  for (const char* text : {"44C#8A 00 10 04 65 03 7E 04", "44C#8A 41 00 20 00 00 00 00"}) bus.send(text);
  EXPECT_EQ(1u, only(DnRule::kFragmentOrder)) << "not acknowledged yet: " << said;
}

// An interface repeats what nobody acknowledges: two requests that were given to it in time leave together.
TEST_F(DnRefereeTest, RequestsThatLeaveTogether) {
  EXPECT_EQ(0u, brokenByRequestsToNobody(milliseconds{200})) << said;
}

TEST_F(DnRefereeTest, RequestsThatWereGivenTooSoonAfterEachOther) {
  EXPECT_EQ(1u, brokenByRequestsToNobody(milliseconds{50})) << said;
}

// Its refusal names its MAC id, and comes while a request of ours is under way.
TEST(DnReferee, WhatAnotherScannerIsAnsweredIsNoAnswerToOurs) {
  DnReferee referee;
  referee.nodeExists(9);
  Instant now{};
  for (int i = 0; i < 2; ++i) {
    referee.masterFrame(frame("457#00 FF FF 01 00 00 00"));
    referee.advance(now += milliseconds(1010));
  }
  const auto ask = [&referee](const char* request, const char* answer) {
    referee.masterFrame(frame(request));
    referee.delivered(frame(answer));
  };
  ask("44E#0A 4B 03 01 03 0A", "44B#0A CB 00");
  ask("44C#0A 0E 05 02 07", "44B#0A 8E 05 00");
  ask("44C#0A 0E 05 02 08", "44B#0A 8E 05 00");
  ask("44C#0A 10 05 02 09 64 00", "44B#11 94 0C 01");
  referee.delivered(frame("44B#0A 90 64 00"));
  referee.masterFrame(frame("44D#00 7E 04 00 00"));
  EXPECT_TRUE(referee.content()) << referee.report();
}

TEST_F(DnRefereeTest, ProcessData) {
  bus.goOnline();
  bus.send("44D#00 7E 04 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoBeforeAllocation)) << said;
  bus.ask("44E#0A 4B 03 01 03 0A");
  bus.send("44D#00 7E 04 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoBeforePacketRate)) << said;
  bus.request("10 05 02 09 64 00");
  bus.send("44D#00 7E 04 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoSizesUnread)) << said;
  bus.request("0E 05 02 08");
  bus.send("44D#00 7E 04 00");
  EXPECT_EQ(1u, only(DnRule::kIoSize)) << said;
  bus.send("44D#00 7E 04 00 00");
  bus.bus.run(milliseconds(410));
  bus.send("44D#00 7E 04 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoAfterTimeout)) << said;
}

TEST_F(DnRefereeTest, PacketRateOfZero) {
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 03 0A");
  bus.request("10 05 02 09 00 00");
  EXPECT_EQ(1u, only(DnRule::kNoPacketRate)) << said;
}

TEST_F(DnRefereeTest, ZeroControlWord) {
  bus.connect();
  bus.send("44D#00 00 00 00 00");
  EXPECT_EQ(0u, only(DnRule::kZeroControlWord)) << "it may look before it commands";
  bus.send("44D#00 7E 04 00 00");
  bus.send("44D#00 00 00 00 00");
  EXPECT_EQ(1u, only(DnRule::kZeroControlWord)) << said;
}

// A module that starts anew tells it by its duplicate-MAC request; what was on its way is no mistake.
TEST_F(DnRefereeTest, PollsAfterTheModuleStartedAnew) {
  bus.connect();
  bus.send("44D#00 7E 04 00 00");
  bus.bus.run(milliseconds(10));
  bus.drive().setPlugged(false);
  bus.bus.run(milliseconds(10));
  bus.drive().setPlugged(true);
  for (int i = 0; i < 20; ++i) {
    bus.send("44D#00 7E 04 00 00");
    bus.bus.run(milliseconds(4));
  }
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.bus.run(milliseconds(50));
  for (unsigned i = 0; i < DnReferee::kTolerance; ++i) bus.send("44D#00 7E 04 00 00");
  bus.bus.run(milliseconds(10));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.send("44D#00 7E 04 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoBeforeAllocation)) << said;
}

// Nobody is there to acknowledge: the frame that is repeated meanwhile goes out when the module is back.
TEST_F(DnRefereeTest, FrameThatWaitedForAnAcknowledge) {
  bus.connect();
  bus.poll("44D#00 7E 04 00 00", milliseconds(100));
  bus.drive().setPlugged(false);
  bus.send("44D#00 7E 04 00 00");
  bus.bus.run(milliseconds(2000));
  bus.drive().setPlugged(true);
  bus.bus.run(milliseconds(2500));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
}

TEST_F(DnRefereeTest, Fragments) {
  DnConversation four{dnGateway(4, 102)};
  four.connect();
  four.send("44D#00 00 7E 04 00 00 00 00");
  four.send("44D#42 00 00 00 7E 04 00 00");
  four.bus.run(milliseconds(20));
  EXPECT_EQ(1u, four.referee().count(DnRule::kIoFragments)) << four.referee().report();
}

TEST_F(DnRefereeTest, ChangeOfStateAndStrobe) {
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 11 0A");
  bus.request("10 05 04 09 E8 03");
  bus.bus.run(milliseconds(150));
  EXPECT_EQ(1u, only(DnRule::kChangeUnacknowledged)) << said;
  bus.send("450#00 00");
  EXPECT_EQ(0u, only(DnRule::kStrobeLength)) << "and nobody has allocated it";
  bus.send("44E#0A 4C 03 01 10");
  bus.send("44A#");
  EXPECT_EQ(1u, only(DnRule::kAcknowledgeUnasked)) << said;
}

// The outputs of a module that is polled beside the strobe are the poll's: with its bit at 1 they would not be forwarded.
TEST_F(DnRefereeTest, StrobeBesideAPoll) {
  bus.goOnline();
  bus.ask("44E#0A 4B 03 01 07 0A");
  bus.send("450#00 00 00 00 00 00 00 00");
  EXPECT_EQ(1u, only(DnRule::kIoBeforePacketRate)) << said;
  for (const char* instance : {"02", "03"}) {
    bus.request(std::string{"0E 05 "} + instance + " 07");
    bus.request(std::string{"0E 05 "} + instance + " 08");
    bus.request(std::string{"10 05 "} + instance + " 09 64 00");
  }
  bus.send("450#00 00 00 00 00 00 00 00");
  bus.send("44D#00 7E 04 00 00");
  bus.bus.run(milliseconds(20));
  EXPECT_TRUE(bus.referee().content()) << bus.referee().report();
  bus.send("450#00 02 00 00 00 00 00 00");  // bit 9, its MAC id
  EXPECT_EQ(1u, only(DnRule::kStrobeBit)) << said;
}

TEST_F(DnRefereeTest, Report) {
  EXPECT_EQ("no rule broken", bus.referee().report());
  for (std::size_t i = 0; i < static_cast<std::size_t>(DnRule::kCount); ++i) {
    EXPECT_STRNE("?", toString(static_cast<DnRule>(i))) << i;
  }
  bus.goOnline();
  bus.bus.send(remoteFrame(0x44E, 4));
  bus.bus.run(milliseconds(5));
  EXPECT_EQ("1 x a remote frame: DeviceNet has none", bus.referee().report());
}

}  // namespace
}  // namespace nord_driver::sim

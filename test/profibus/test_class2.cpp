#include <gtest/gtest.h>

#include "profibus/class2_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

// The whole way of felser.ch, telegram by telegram: resource manager, initiate, write, read, idle, abort.
TEST(Class2, OpensReadsStaysAndEnds) {
  Class2Wire wire;
  wire.isQuiet();
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.connects();
  EXPECT_EQ(0xF0, wire.master.peer(0).max_length);
  EXPECT_EQ(0x0100, wire.master.peer(0).features);
  wire.asks(kClass2Write7C, "E5");
  wire.asks(kServerPoll5C, "E5");
  EXPECT_FALSE(wire.master.pollRecord());
  wire.asks(kServerPoll7C, kClass2Written);
  const RecordResult written = wire.result();
  EXPECT_EQ(RecordOutcome::kDone, written.outcome);
  EXPECT_EQ(101, written.index);
  wire.isQuiet();

  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kClass2Read5C, "E5");
  wire.asks(kServerPoll7C, "10 01 08 09 12 16");  // NR says "not yet" as well
  wire.asks(kServerPoll5C, kClass2ReadDone);
  const RecordResult read = wire.result();
  EXPECT_EQ(RecordOutcome::kDone, read.outcome);
  EXPECT_EQ("15 E4 00 00 00 00 00 01", toHex(read.data));
  wire.isQuiet();

  // A third of the Send_Timeout of 1 s after the last PDU a sign of life goes out.
  wire.now = *wire.master.nextDeadline();
  wire.asks(kIdle7C, "E5");
  wire.asks(kServerPoll5C, kIdleBack);
  wire.isQuiet();
  EXPECT_TRUE(wire.master.isConnected(0));

  wire.master.close();
  wire.asks("68 08 08 68 88 81 7C 30 32 58 01 20 60 16", "E5");
  wire.isQuiet();
  EXPECT_FALSE(wire.master.isConnected(0));
  EXPECT_EQ("", wire.trouble());
}

TEST(Class2, RefusesABusThatCannotBe) {
  BusParameters bus;
  bus.max_retries = 16;
  EXPECT_THROW(Class2Master(bus, std::vector<StationAddress>{}, Class2Times{}), std::invalid_argument);
}

// The next sign of life counts from the PDU sent last, record or idle, whatever polls came between.
TEST(Class2, SignsOfLifeAreDueInThirdsOfTheSendTimeout) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  wire.sends(kClass2Read7C);
  wire.receives("E5");
  const Instant sent = wire.now;
  wire.asks(kServerPoll5C, kClass2ReadDone);
  EXPECT_EQ(sent + Duration{1s} / 3, wire.master.nextDeadline());
}

// The short form of the answer, as another maker prints it (Balluff BTL7-T500 p. 68).
TEST(Class2, TakesTheShortFormOfAnAcceptance) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kInitiate6C, "E5");
  wire.asks(kManagerPoll5C, kGrant);
  wire.asks(kServerPoll7C, "68 0F 0F 68 81 88 08 32 30 57 F0 01 00 00 00 03 03 00 00 C1 16");
  EXPECT_TRUE(wire.master.isConnected(0));
  EXPECT_EQ(0x0303, wire.master.peer(0).profile_ident);
}

// A slave that wants a longer Send_Timeout would end the connection with ABT_STO: it gets what it wants.
TEST(Class2, TakesTheSendTimeoutTheSlaveNeeds) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kInitiate6C, "E5");
  wire.asks(kManagerPoll5C, "68 09 09 68 81 88 08 32 31 56 30 00 C8 C2 16");
  wire.asks("68 08 08 68 88 81 7C 30 32 58 01 16 56 16", "E5");
  wire.asks("68 19 19 68 88 81 5C 31 32 57 00 00 00 00 C8 01 00 00 00 00 00 00 02 00 02 00 00 00 00 EC 16", "E5");
  wire.asks(kManagerPoll7C, "68 09 09 68 81 88 08 32 31 56 30 00 C8 C2 16");
  wire.asks(kServerPoll5C, kAccepted);
  wire.asks(kClass2Read7C, kClass2ReadDone);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

TEST(Class2, RefusalsInWords) {
  Class2Wire none;
  ASSERT_TRUE(none.master.submitRecord(0, readAnswer()));
  none.asks(kInitiate6C, kNotActivated);
  EXPECT_EQ(RecordOutcome::kNotActivated, none.result().outcome);
  EXPECT_EQ(
      "it answers RS, not activated, at access point 49: it has no acyclic connection of class 2 (MS2), or all are "
      "taken",
      none.trouble());
  none.isQuiet();

  Class2Wire refused;
  ASSERT_TRUE(refused.master.submitRecord(0, readAnswer()));
  refused.asks(kInitiate6C, "E5");
  refused.asks(kManagerPoll5C, kGrant);
  refused.asks(kServerPoll7C, "68 09 09 68 81 88 08 32 30 D7 80 A9 00 73 16");
  EXPECT_EQ(RecordOutcome::kNotActivated, refused.result().outcome);
  EXPECT_EQ("it refused a connection of class 2 (MS2): DP-V1 error A9, feature not supported", refused.trouble());

  Class2Wire record;
  ASSERT_TRUE(record.master.submitRecord(0, readAnswer()));
  record.connects();
  record.asks(kClass2Read7C, "68 09 09 68 81 88 08 32 30 DE 80 B2 00 83 16");
  const RecordResult result = record.result();
  EXPECT_EQ(RecordOutcome::kRefused, result.outcome);
  EXPECT_STREQ("invalid slot", meaningOf(result.error));
  EXPECT_TRUE(record.master.isConnected(0)) << "a record that is refused ends no connection";
}

// RR: no resource for the moment. What was asked goes out once more, on the way there as on the connection.
TEST(Class2, NoResourceForTheMoment) {
  constexpr const char* kNoResource = "10 01 08 02 0B 16";
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kInitiate6C, kNoResource);
  EXPECT_FALSE(wire.master.pollRecord());
  wire.asks(kInitiate5C, kNoResource);
  wire.asks(kInitiate7C, "E5");
  wire.asks(kManagerPoll5C, kNoResource);
  wire.asks(kManagerPoll7C, kGrant);
  wire.asks(kServerPoll5C, kAccepted);
  wire.asks(kClass2Read7C, kNoResource);
  EXPECT_TRUE(wire.master.isConnected(0));
  wire.asks(kClass2Read5C, "E5");
  wire.asks(kServerPoll7C, kNoResource);
  wire.asks(kServerPoll5C, kClass2ReadDone);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
  EXPECT_EQ("", wire.trouble());
}

// A read that is answered "busy" is asked again, as on MS1.
TEST(Class2, BusyReadIsAskedAgain) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  wire.asks(kClass2Read7C, "68 09 09 68 81 88 08 32 30 DE 80 B5 00 86 16");
  wire.asks(kClass2Read5C, kClass2ReadDone);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

TEST(Class2, AbortOfTheSlaveInWords) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  wire.asks(kClass2Read7C, "E5");
  wire.asks(kServerPoll5C, "68 08 08 68 81 88 08 32 30 58 01 13 DF 16");
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  EXPECT_EQ("it ended the connection of class 2 (MS2): abort 13h, ABT_TO: time-out of the connection", wire.trouble());
  EXPECT_FALSE(wire.master.isConnected(0));
  // The next record opens another.
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kInitiate7C, "E5");
  EXPECT_EQ("", wire.trouble());
}

TEST(Class2, EveryReasonOfAnAbortHasWords) {
  EXPECT_STREQ("abort 11h, ABT_SE: sequence error, the service is not allowed in this state",
               describe(Class2Abort{1, 0x11}).c_str());
  EXPECT_STREQ("abort 16h, ABT_STO: the Send_Timeout asked for is too short", describe(Class2Abort{1, 0x16}).c_str());
  EXPECT_STREQ("abort 1Fh, ABT_RES: resource error", describe(Class2Abort{1, 0x1F}).c_str());
  EXPECT_STREQ("abort 19h, of no known reason", describe(Class2Abort{1, 0x19}).c_str());
  EXPECT_STREQ("abort 03h, data link layer: RS, access point not active", describe(Class2Abort{1, 0x03}).c_str());
  EXPECT_STREQ("abort 25h, by the device itself, reason 5", describe(Class2Abort{2, 0x25}).c_str());
}

// The slave had given the connection up in a pause: the record it did not take goes over another one, once.
TEST(Class2, OpensAgainWhatTheSlaveGaveUp) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  wire.asks(kClass2Read7C, kClass2ReadDone);
  wire.result();
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.asks(kClass2Write5C, kNotActivated);
  EXPECT_FALSE(wire.master.pollRecord());
  wire.asks(kInitiate7C, "E5");
  wire.asks(kManagerPoll5C, kGrant);
  wire.asks(kServerPoll7C, kAccepted);
  wire.asks(kClass2Write5C, kNotActivated);
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  EXPECT_EQ("it has ended the connection of class 2 (MS2): RS, not activated, at access point 48", wire.trouble());
}

// A response that does not come ends the connection: what came late would answer the next request.
TEST(Class2, ResponseTimeOut) {
  Class2Times times;
  times.response_timeout = 100ms;
  Class2Wire wire{quietBus(), times};
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  wire.asks(kClass2Read7C, "E5");
  wire.asks(kServerPoll5C, "E5");
  wire.advance(100ms);
  wire.asks(kServerPoll7C, "E5");  // it waited to be sent
  wire.asks("68 08 08 68 88 81 5C 30 32 58 01 13 33 16", "E5");
  EXPECT_EQ(RecordOutcome::kTimedOut, wire.result().outcome);
  EXPECT_EQ("its connection of class 2 (MS2) brought no response in 0.1 s, and was ended", wire.trouble());
  wire.isQuiet();
}

TEST(Class2, NoConnectionInTime) {
  Class2Times times;
  times.response_timeout = 100ms;
  Class2Wire wire{quietBus(), times};
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.asks(kInitiate6C, "E5");
  wire.advance(100ms);
  wire.asks(kManagerPoll5C, "E5");  // it waited to be sent
  wire.isQuiet();
  EXPECT_EQ(RecordOutcome::kTimedOut, wire.result().outcome);
  EXPECT_EQ("it opened no connection of class 2 (MS2) in 0.1 s", wire.trouble());
}

// Nobody there: one retry, then the record ends; the next one begins with FCV = 0 again.
TEST(Class2, SilentStation) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.sends(kInitiate6C);
  wire.staysSilent();
  wire.sends(kInitiate6C);
  wire.staysSilent();
  EXPECT_EQ(RecordOutcome::kNoAnswer, wire.result().outcome);
  EXPECT_EQ("it does not answer", wire.trouble());
  wire.isQuiet();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.sends(kInitiate6C);
}

TEST(Class2, OneRecordAtATime) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_FALSE(wire.master.submitRecord(0, readAnswer()));
  RecordRequest bad = readAnswer();
  bad.length = 0;
  Class2Wire other;
  EXPECT_FALSE(other.master.submitRecord(0, bad));
  other.isQuiet();
}

BusParameters listening() {
  BusParameters bus = quietBus();
  bus.listen_first = 200ms;
  return bus;
}

// The ring of another master is not joined: heard before the first telegram, nothing is ever sent.
TEST(Class2, RefusesBesideAnotherMaster) {
  Class2Wire wire{listening()};
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_TRUE(wire.master.wantsBus(wire.now));
  EXPECT_TRUE(wire.master.pollTransmit(wire.now).empty());
  wire.arrives("DC 02 05");
  EXPECT_FALSE(wire.master.refusedBy()) << "once it may be noise";
  wire.advance(20ms);
  wire.arrives("DC 02 05");
  EXPECT_EQ(5, wire.master.refusedBy().value_or(255));
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  EXPECT_EQ(
      "master 5 is on this segment, and its token ring is not joined: a connection of class 2 (MS2) needs to be the "
      "only master here; end the other one, or unplug it",
      wire.trouble());
  wire.advance(1s);
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  wire.isQuiet();
  EXPECT_EQ(0u, wire.master.counters().telegrams_sent);
}

// One that comes later ends a connection without another telegram, also one that waits to be sent.
TEST(Class2, GivesWayToAMasterThatComesLater) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.connects();
  ASSERT_TRUE(wire.master.wantsBus(wire.now));
  wire.arrives("10 08 02 49 53 16");  // master 2 asks for the FDL status of station 8
  EXPECT_EQ(2, wire.master.refusedBy().value_or(255));
  wire.advance(1s);
  wire.isQuiet();
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  wire.master.restart(wire.now);
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.sends(kInitiate6C);
}

// What an adapter hands back is not another master's; of a request that was sent again behind a late answer, too.
TEST(Class2, DoesNotGiveWayToItsOwnTelegramsHandedBack) {
  Class2Wire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.sends(kInitiate6C);
  wire.arrives(kInitiate6C);
  wire.staysSilent();
  wire.sends(kInitiate6C);
  wire.receives(std::string{"E5 "} + kInitiate6C + " E5");
  EXPECT_FALSE(wire.master.refusedBy());
  wire.asks(kManagerPoll5C, kGrant);
  wire.asks(kServerPoll7C, kAccepted);
  EXPECT_TRUE(wire.master.isConnected(0));
  wire.arrives(kServerPoll7C);
  EXPECT_EQ(1, wire.master.refusedBy().value_or(255)) << "it was answered: somebody else has sent this";
}

TEST(Class2, ListensBeforeItTalks) {
  Class2Wire wire{listening()};
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_EQ(Instant{1h} + 200ms, wire.master.nextDeadline());
  wire.sends(kInitiate6C);
}

}  // namespace
}  // namespace nord_driver::profibus

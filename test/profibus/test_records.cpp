#include <gtest/gtest.h>

#include "profibus/record_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr const char* kWriteRequest = "68 11 11 68 88 81 5C 33 33 5F 00 65 08 15 E4 00 00 00 00 00 00 90 16";
constexpr const char* kWriteResponse = "68 09 09 68 81 88 08 33 33 5F 00 65 08 43 16";
constexpr const char* kReadBusy = "68 09 09 68 81 88 08 33 33 DE 80 B5 00 8A 16";
constexpr const char* kWriteBusy = "68 09 09 68 81 88 08 33 33 DF 80 B5 00 8B 16";

// NORD's way to a parameter: write the order, poll until it is taken, read the answer, poll until it is there
// (BU 0220 8.3.4.4). Every telegram shares the slave's frame count with its data exchange.
TEST(Records, WriteThenRead) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.cycleWith(kWriteRequest, "E5");
  EXPECT_FALSE(wire.master.pollRecord());
  wire.cycleWithDiagnosis(true, kPoll7C, kWriteResponse);
  const RecordResult written = wire.result();
  EXPECT_EQ(RecordOutcome::kDone, written.outcome);
  EXPECT_TRUE(written.write);
  EXPECT_EQ(0u, written.slave);
  EXPECT_EQ(101, written.index);
  EXPECT_FALSE(wire.master.pollRecord());

  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWithDiagnosis(false, kReadRequest, "E5");
  wire.cycleWith(kPoll5C, "E5");
  wire.cycleWith(kPoll5C, "10 01 08 09 12 16");  // NR says "not yet" as well as SC does
  wire.cycleWith(kPoll5C, kReadResponse);
  const RecordResult read = wire.result();
  EXPECT_EQ(RecordOutcome::kDone, read.outcome);
  EXPECT_EQ("15 E4 00 00 00 00 00 01", toHex(read.data));
  wire.plainCycle();
  wire.tellsNothing();
}

// Whatever it ended by, a result names what was asked for.
TEST(Records, NameTheirSlotAndIndex) {
  RecordWire wire;
  RecordRequest request = readAnswer();
  request.slot = 3;
  ASSERT_TRUE(wire.master.submitRecord(0, request));
  const RecordResult result = wire.result();
  EXPECT_EQ(RecordOutcome::kOffline, result.outcome) << "it is not in data exchange";
  EXPECT_EQ(3, result.slot);
  EXPECT_EQ(request.index, result.index);
  EXPECT_FALSE(result.write);
}

// A slave that is quick enough may answer the request itself with the response, at either priority.
TEST(Records, ResponseAtOnce) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "68 11 11 68 81 88 0A 33 33 5E 00 65 08 15 E4 00 00 00 00 00 01 3E 16");
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

// C2: its means are in use, which passes, too.
TEST(Records, AReadWhoseMeansAreInUseIsAskedAgain) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  wire.cycleWith(kPoll5C, "68 09 09 68 81 88 08 33 33 DE 80 C2 00 97 16");
  wire.cycleWith(kReadRequest, kReadResponse);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

// "DE 80 B5" to a read is "busy": the read is sent again. To a write it is a refusal, in words.
TEST(Records, BusyReadIsAskedAgain) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  wire.cycleWith(kPoll5C, kReadBusy);
  wire.cycleWith(kReadRequest, kReadBusy);
  wire.cycleWith(kReadRequest, kReadResponse);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);

  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.cycleWith(kWriteRequest, kWriteBusy);
  EXPECT_EQ(RecordOutcome::kRefused, wire.result().outcome);
}

TEST(Records, BusyToTheEndTimesOut) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  const Instant begin = wire.now;
  for (int i = 0; i < 20 && wire.now < begin + 1s; ++i) {
    wire.cycleWith(kReadRequest, kReadBusy);
    wire.advance(60ms);
  }
  EXPECT_FALSE(wire.master.pollRecord());
  wire.plainCycle();
  const RecordResult result = wire.result();
  EXPECT_EQ(RecordOutcome::kTimedOut, result.outcome);
  EXPECT_TRUE(result.error.isBusy()) << "to the end";
}

TEST(Records, RefusalCarriesItsCodesInWords) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "68 09 09 68 81 88 08 33 33 DE 80 B0 07 8C 16");
  const RecordResult result = wire.result();
  EXPECT_EQ(RecordOutcome::kRefused, result.outcome);
  EXPECT_EQ(0x80, result.error.decode);
  EXPECT_EQ(0xB0, result.error.code1);
  EXPECT_EQ(0x07, result.error.code2);
  EXPECT_STREQ("invalid index", meaningOf(result.error));
}

// One record per slave at a time, one result per record, and nothing longer than the wire can carry.
TEST(Records, OneAtATime) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_FALSE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, kReadResponse);
  EXPECT_FALSE(wire.master.submitRecord(0, readAnswer())) << "its result has not been fetched";
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
  EXPECT_FALSE(wire.master.pollRecord());

  RecordRequest bad = readAnswer();
  bad.length = 241;
  EXPECT_FALSE(wire.master.submitRecord(0, bad));
  bad.length = 0;
  EXPECT_FALSE(wire.master.submitRecord(0, bad));
  bad = readAnswer();
  bad.slot = 255;
  EXPECT_FALSE(wire.master.submitRecord(0, bad));
  bad = writeOrder();
  bad.data.clear();
  EXPECT_FALSE(wire.master.submitRecord(0, bad));
  wire.plainCycle();
}

// No response in C1_Response_Timeout ends the record, not the exchange. The next request waits until the late response
// has come or can come no more: it must not be taken for the next one's.
TEST(Records, TimeOutAndLateResponse) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  wire.cycleWith(kPoll5C, "E5");
  wire.advance(500ms);
  wire.cycleWith(kPoll5C, "E5");
  const RecordResult result = wire.result();
  EXPECT_EQ(RecordOutcome::kTimedOut, result.outcome);
  EXPECT_FALSE(result.error.isBusy());

  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kPoll5C, kReadResponse);  // late
  EXPECT_FALSE(wire.master.pollRecord());
  wire.cycleWith(kReadRequest, "E5");
  wire.cycleWith(kPoll5C, "68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E4 00 00 00 00 00 02 3D 16");
  EXPECT_EQ("15 E4 00 00 00 00 00 02", toHex(wire.result().data));
  wire.plainCycle();
}

TEST(Records, TheWaitForALateResponseEnds) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  wire.advance(500ms);
  wire.cycleWith(kPoll5C, "E5");
  EXPECT_EQ(RecordOutcome::kTimedOut, wire.result().outcome);
  wire.advance(500ms);
  wire.plainCycle();
}

// The response to something else is none: slot, index, length and function are those of the request.
TEST(Records, IgnoresResponsesToOtherRequests) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  for (const char* other : {
           kWriteResponse,                                                             // function
           "68 11 11 68 81 88 08 33 33 5E 00 64 08 15 E4 00 00 00 00 00 01 3B 16",     // index
           "68 11 11 68 81 88 08 33 33 5E 01 65 08 15 E4 00 00 00 00 00 01 3D 16",     // slot
           "68 11 11 68 81 88 08 33 33 5E 00 65 07 15 E4 00 00 00 00 00 01 3B 16",     // length
           "68 12 12 68 81 88 08 33 33 5E 00 65 09 15 E4 00 00 00 00 00 01 00 3D 16",  // longer than asked for
           "68 06 06 68 81 88 08 33 33 48 BF 16",                                      // idle
           "68 08 08 68 81 88 08 33 33 DE 80 B0 85 16",                                // a negative one cut short
       }) {
    wire.cycleWith(kPoll5C, other);
    EXPECT_FALSE(wire.master.pollRecord()) << other;
  }
  wire.cycleWith(kPoll5C, kReadResponse);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
  EXPECT_EQ(0u, wire.master.counters().unexpected);
}

// An access point that stays silent ends the record. The exchange goes on, with the frame count from the beginning,
// since the slave may or may not have taken the request.
TEST(Records, SilentAccessPointLeavesTheExchangeAlone) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.sends(kReadRequest);
  wire.staysSilent();
  wire.sends(kReadRequest);
  wire.staysSilent();
  wire.cycleEnds();
  EXPECT_EQ(RecordOutcome::kNoAnswer, wire.result().outcome);
  wire.cycle(kExchange6D, kInputs);
  wire.cycle(kExchange5D, kInputs);
  EXPECT_TRUE(wire.status().exchanged_this_cycle);
  EXPECT_EQ(0u, wire.status().counters.losses);
  wire.tellsNothing();
}

// The slave took the request, and what it said was lost. Its response waits until a telegram fetches it, and must not be
// taken for that to the next request.
TEST(Records, AResponseThatWaitsSinceNobodyAnsweredIsDropped) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kInputs);
  wire.sends(kReadRequest);
  wire.staysSilent();
  wire.sends(kReadRequest);
  wire.staysSilent();
  wire.cycleEnds();
  EXPECT_EQ(RecordOutcome::kNoAnswer, wire.result().outcome);

  wire.cycle(kExchange6D, kInputs);  // no polls for nobody: each costs a slot time when the access point is silent
  wire.advance(2s);
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.startCycle();
  wire.sends(kExchange5D);
  wire.receives(kInputs);
  wire.sends(kPoll7C);
  wire.receives(kReadResponse);
  wire.cycleEnds();
  EXPECT_FALSE(wire.master.pollRecord());
  wire.startCycle();
  wire.sends(kExchange5D);
  wire.receives(kInputs);
  wire.sends(kReadRequest7C);
  wire.receives("68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E4 00 00 00 00 00 02 3D 16");
  wire.cycleEnds();
  EXPECT_EQ("15 E4 00 00 00 00 00 02", toHex(wire.result().data));
}

TEST(Records, InactiveAccessPoint) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, kNotActivated);
  EXPECT_EQ(RecordOutcome::kNotActivated, wire.result().outcome);
  wire.plainCycle();
}

// RS behind the acknowledgement of a write: whether it was carried out is not known, which "not activated" would deny.
TEST(Records, AnAccessPointThatEndsBehindATakenWrite) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.cycleWith(kWriteRequest, "E5");
  wire.cycleWith(kPoll5C, kNotActivated);
  EXPECT_EQ(RecordOutcome::kTimedOut, wire.result().outcome);
  ASSERT_TRUE(wire.master.submitRecord(0, writeOrder()));
  wire.cycleWith(kWriteRequest, kNotActivated);
  EXPECT_EQ(RecordOutcome::kNotActivated, wire.result().outcome) << "not taken";
}

// RR: no resource for the moment. The request is sent again.
TEST(Records, NoResourceIsTriedAgain) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "10 01 08 02 0B 16");
  wire.cycleWith(kReadRequest, kReadResponse);
  EXPECT_EQ(RecordOutcome::kDone, wire.result().outcome);
}

// The acyclic channel lives on the cyclic one.
TEST(Records, OfflineEndsThem) {
  RecordWire wire;
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.cycleWith(kReadRequest, "E5");
  wire.startCycle();
  wire.sends(kExchange7D);
  wire.receives(kNotActivated);
  wire.cycleEnds();
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
  wire.cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");  // and no poll
}

TEST(Records, RestartOfTheLinkEndsThem) {
  RecordWire wire;
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  wire.restart();
  EXPECT_EQ(RecordOutcome::kOffline, wire.result().outcome);
}

TEST(Records, NotWithoutDpv1) {
  SlaveConfig plain = modularModule(8);
  plain.dpv1 = false;
  RecordWire wire{plain};
  wire.startsUpModular();
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  EXPECT_EQ(RecordOutcome::kNotSupported, wire.result().outcome);
  wire.plainCycle();
}

// However many slaves have a record under way, a cycle carries one acyclic telegram.
TEST(Records, OneAcyclicTelegramPerCycle) {
  SlaveConfig second = modularModule(9);
  Wire wire{quietBus(), {modularModule(8), second}};
  const auto answer = [](ByteView request) -> std::string {
    const bool nine = (request[request[0] == 0x68 ? 4 : 1] & 0x7F) == 9;
    if (request[0] == 0x10) return nine ? kHere9 : kHere8;
    if ((request[4] & 0x80) == 0) return nine ? kInputs9 : kInputs;
    if (request[7] == 0x3C) {
      return nine ? "68 0B 0B 68 81 89 08 3E 3C 00 0C 00 01 0B A8 4C 16" : kReady0ba8;
    }
    return "E5";
  };
  std::string acyclic;
  const auto cycle = [&] {
    acyclic.clear();
    wire.startCycle();
    for (int telegrams = 0; !wire.master.cycleDone(); ++telegrams) {
      ASSERT_LT(telegrams, 100) << "the cycle does not end";
      wire.now = std::max(wire.now, *wire.master.nextDeadline());
      const ByteView sent = wire.master.pollTransmit(wire.now);
      ASSERT_FALSE(sent.empty());
      if (sent.size() > 7 && sent[7] == 0x33) acyclic += toHex(sent.sub(4, 1)) + " ";
      wire.receives(answer(sent));
    }
  };
  for (int i = 0; i < 8; ++i) cycle();
  ASSERT_EQ(SlavePhase::kDataExchange, wire.status(1).phase);
  ASSERT_TRUE(wire.master.submitRecord(0, readAnswer()));
  ASSERT_TRUE(wire.master.submitRecord(1, readAnswer()));
  std::string order;
  for (int i = 0; i < 4; ++i) {
    cycle();
    order += acyclic + "| ";
  }
  EXPECT_EQ("88 | 89 | 88 | 89 | ", order);
}

// DPV1_Enable is the first bit of the user parameters: without it the slave would not open its access point.
TEST(Records, ConfigurationIsChecked) {
  SlaveConfig slave = modularModule(8);
  slave.user_parameters = {0x00, 0x00, 0x00};
  EXPECT_THROW(validate(slave, quietBus()), std::invalid_argument);
  slave.user_parameters = {0x80, 0x00};
  EXPECT_THROW(validate(slave, quietBus()), std::invalid_argument);
  slave.user_parameters = {0x80, 0x00, 0x00};
  EXPECT_NO_THROW(validate(slave, quietBus()));
}

}  // namespace
}  // namespace nord_driver::profibus

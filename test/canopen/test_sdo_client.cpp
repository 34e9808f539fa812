#include "canopen/sdo_conversation.h"

namespace nord_driver::canopen {
namespace {

using namespace std::chrono_literals;

class SdoExpedited : public SdoConversation {};

// BU 0060 p. 61: P102 (2066h) of parameter set 1 becomes 1.03 s.
TEST_F(SdoExpedited, WritesP102AsTheManualDoes) {
  ASSERT_TRUE(client.start(sdoWrite(7, 0x2066, 1, 103, 2), now));
  exchange("2B 66 20 01 67 00 00 00", "60 66 20 01 00 00 00 00");
  const SdoAnswer answer = taken();
  EXPECT_TRUE(answer.ok());
  EXPECT_EQ(7u, answer.id);
  EXPECT_TRUE(answer.data.empty());
  EXPECT_EQ(1u, client.counters().done);
}

// BU 0060 p. 61: a 32 bit value is written with 23h; CiA 301: one byte with 2Fh.
TEST_F(SdoExpedited, WritesOneAndFourBytes) {
  ASSERT_TRUE(client.start(sdoWrite(1, 0x1800, 1, 0xC0000181, 4), now));
  exchange("23 00 18 01 81 01 00 C0", "60 00 18 01 00 00 00 00");
  EXPECT_TRUE(taken().ok());
  ASSERT_TRUE(client.start(sdoWrite(1, 0x1A00, 0, 0, 1), now));
  exchange("2F 00 1A 00 00 00 00 00", "60 00 1A 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

// BU 0060 p. 62: 4Bh answers with 16 bits, 43h with 32; the index goes low byte first (the manual's read example has it
// the wrong way round). CiA 301: 4Fh one byte, 47h three.
TEST_F(SdoExpedited, ReadsOneToFourBytes) {
  read(0x2066, 1);
  exchange("40 66 20 01 00 00 00 00", "4B 66 20 01 67 00 00 00");
  SdoAnswer answer = taken();
  EXPECT_EQ("67 00", toHex(answer.data));
  EXPECT_EQ(103u, answer.number());
  EXPECT_TRUE(answer.size_told);
  read(0x1018, 1);
  exchange("40 18 10 01 00 00 00 00", "43 18 10 01 89 01 00 80");
  EXPECT_EQ(0x80000189u, taken().number());
  read(0x1001, 0);
  exchange("40 01 10 00 00 00 00 00", "4F 01 10 00 81 55 55 55");
  EXPECT_EQ(0x81u, taken().number());
  read(0x2000, 0);
  exchange("40 00 20 00 00 00 00 00", "47 00 20 00 01 02 03 04");
  EXPECT_EQ(0x030201u, taken().number());
}

// 42h: the server does not tell how many of the four bytes are meant.
TEST_F(SdoExpedited, SaysWhenTheSizeWasNotTold) {
  read(0x2066, 1);
  exchange("40 66 20 01 00 00 00 00", "42 66 20 01 67 00 00 00");
  const SdoAnswer answer = taken();
  EXPECT_FALSE(answer.size_told);
  EXPECT_EQ("67 00 00 00", toHex(answer.data));
}

TEST_F(SdoExpedited, GivesTheServersAbortCode) {
  ASSERT_TRUE(client.start(sdoWrite(7, 0x2066, 9, 103, 2), now));
  exchange("2B 66 20 09 67 00 00 00", "80 66 20 09 11 00 09 06");
  expectAborted(SdoEnd::kAbortedByServer, 0x06090011);
  EXPECT_EQ("", sent());
  EXPECT_EQ(1u, client.counters().aborted_by_server);
}

class SdoTimeOut : public SdoConversation {};

// The server is told that nobody waits any longer, and the channel is free for the next request.
TEST_F(SdoTimeOut, AbortsAndIsFreeAgain) {
  read(0x2066, 1);
  EXPECT_EQ(now + kTimeout, client.nextDeadline());
  EXPECT_EQ("40 66 20 01 00 00 00 00", sent());
  pass(kTimeout - 1ns);
  EXPECT_FALSE(client.takeAnswer());
  pass(1ns);
  EXPECT_EQ("80 66 20 01 00 00 04 05", sent());
  expectAborted(SdoEnd::kTimedOut, 0x05040000);
  EXPECT_FALSE(client.nextDeadline());
  EXPECT_EQ(1u, client.counters().timed_out);
  read(0x2067, 1);
  exchange("40 67 20 01 00 00 00 00", "4B 67 20 01 05 00 00 00");
  EXPECT_EQ(5u, taken().number());
}

// A server that never saw the request need not hear of its end.
TEST_F(SdoTimeOut, SaysNothingToAServerThatWasNotAsked) {
  read(0x2066, 1);
  pass(kTimeout);
  expectAborted(SdoEnd::kTimedOut, 0x05040000);
  EXPECT_EQ("", sent());
}

// The abort of the request before leaves first: the server works off its requests in order.
TEST_F(SdoTimeOut, TheAbortComesBeforeTheNextRequest) {
  read(0x2066, 1);
  sent();
  pass(kTimeout);
  taken();
  read(0x2067, 1);
  EXPECT_EQ("80 66 20 01 00 00 04 05", sent());
  EXPECT_EQ("40 67 20 01 00 00 00 00", sent());
}

// Silence between the frames of a long transfer counts, not the whole of it.
TEST_F(SdoTimeOut, BeginsAnewWithEveryAnswer) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 0A 00 00 00");
  pass(kTimeout - 1ms);
  exchange("60 00 00 00 00 00 00 00", "00 49 6E 76 65 72 74 65");
  pass(kTimeout - 1ms);
  exchange("70 00 00 00 00 00 00 00", "19 72 20 31 00 00 00 00");
  EXPECT_EQ("Inverter 1", takenText());
}

class SdoStrangers : public SdoConversation {};

// A late answer names another object, or answers another command: it is counted and the right one still taken.
TEST_F(SdoStrangers, LateAnswersAreNotOurs) {
  read(0x2066, 1);
  sent();
  answer("4B 67 20 01 11 11 00 00");  // another index
  answer("4B 66 21 01 11 11 00 00");
  answer("4B 66 20 02 11 11 00 00");  // another sub-index
  answer("60 66 20 01 00 00 00 00");  // the confirmation of a write
  answer("00 11 11 11 11 11 11 11");  // a segment
  answer("80 67 20 01 00 00 02 06");  // an abort of something else
  answer("E0 66 20 01 00 00 00 00");  // no command of a server
  EXPECT_EQ(7u, client.counters().stale);
  EXPECT_FALSE(client.takeAnswer());
  answer("4B 66 20 01 67 00 00 00");
  EXPECT_EQ(103u, taken().number());
}

// Nobody waits: before the request was given out, after its answer, and with no request at all.
TEST_F(SdoStrangers, AnswersNobodyWaitsFor) {
  answer("4B 66 20 01 67 00 00 00");
  read(0x2066, 1);
  answer("4B 66 20 01 67 00 00 00");
  answer("80 66 20 01 00 00 02 06");
  EXPECT_FALSE(client.takeAnswer());
  exchange("40 66 20 01 00 00 00 00", "4B 66 20 01 68 00 00 00");
  answer("4B 66 20 01 67 00 00 00");
  EXPECT_EQ(104u, taken().number());
  EXPECT_EQ(4u, client.counters().stale);
}

// CiA 301 7.2.4.3: every SDO frame has eight bytes.
TEST_F(SdoStrangers, ShortFramesAreMalformed) {
  read(0x2066, 1);
  sent();
  for (const char* bytes : {"", "4B", "4B 66 20 01", "4B 66 20 01 67 00 00", "80 66 20 01"}) answer(bytes);
  EXPECT_EQ(5u, client.counters().malformed);
  EXPECT_FALSE(client.takeAnswer());
  EXPECT_EQ(0u, client.counters().stale);
}

TEST_F(SdoStrangers, OtherIdentifiersAreIgnored) {
  read(0x2066, 1);
  sent();
  CanFrame frame = dataFrame(0x5B3, fromHex("4B 66 20 01 67 00 00 00"));
  client.handle(frame, now);
  frame.id = 0x5B2;
  frame.extended = true;
  client.handle(frame, now);
  client.handle(remoteFrame(0x5B2, 8), now);
  EXPECT_FALSE(client.takeAnswer());
  EXPECT_EQ(0u, client.counters().stale + client.counters().malformed);
}

// Known limit: nothing tells the late answer to a read from the answer to its repetition.
TEST_F(SdoStrangers, TheSameReadAgainTakesTheLateAnswer) {
  read(0x2066, 1);
  sent();
  pass(kTimeout);
  taken();
  read(0x2066, 1);
  sent();
  sent();
  answer("4B 66 20 01 67 00 00 00");
  EXPECT_EQ(103u, taken().number());
}

// A gateway has a server for each inverter: own identifiers, told apart by nothing else.
TEST(SdoChannels, EachHasItsIdentifiers) {
  const Instant now{};
  SdoClient first{{0x640, 0x5C0}, 100ms}, second{{0x641, 0x5C1}, 100ms};
  ASSERT_TRUE(first.start(sdoRead(1, 0x2066, 1), now));
  ASSERT_TRUE(second.start(sdoRead(2, 0x2066, 1), now));
  CanFrame frame;
  ASSERT_TRUE(first.pollTransmit(frame));
  EXPECT_EQ(0x640u, frame.id);
  ASSERT_TRUE(second.pollTransmit(frame));
  EXPECT_EQ(0x641u, frame.id);
  for (SdoClient* client : {&first, &second}) {
    client->handle(dataFrame(0x5C1, fromHex("4B 66 20 01 67 00 00 00")), now);
  }
  EXPECT_FALSE(first.takeAnswer());
  EXPECT_EQ(103u, second.takeAnswer()->number());
  EXPECT_EQ(0x632u, defaultSdoChannel(0x32).request_id);
  EXPECT_EQ(0x5B2u, defaultSdoChannel(0x32).response_id);
}

class SdoUse : public SdoConversation {};

TEST_F(SdoUse, OneRequestAtATimeAndItsAnswerHasToBeTaken) {
  EXPECT_FALSE(client.busy());
  read(0x2066, 1);
  EXPECT_TRUE(client.busy());
  EXPECT_FALSE(client.start(sdoRead(8, 0x2067, 1), now));
  exchange("40 66 20 01 00 00 00 00", "4B 66 20 01 67 00 00 00");
  EXPECT_TRUE(client.busy());
  EXPECT_FALSE(client.start(sdoRead(8, 0x2067, 1), now));
  EXPECT_EQ(7u, taken().id);
  EXPECT_FALSE(client.takeAnswer());
}

TEST_F(SdoUse, RefusesWritesOfNothingAndOfTooMuch) {
  SdoRequest request = sdoRead(7, 0x2066, 1);
  request.write = true;
  EXPECT_FALSE(client.start(request, now));
  EXPECT_FALSE(client.start(request, std::vector<std::uint8_t>(kSdoCapacity + 1), now));
  EXPECT_TRUE(client.start(request, std::vector<std::uint8_t>(kSdoCapacity), now));
}

// Cancelled: no answer, the server is told, and the channel is free.
TEST_F(SdoUse, Cancels) {
  read(0x2066, 1);
  sent();
  client.cancel();
  EXPECT_EQ("80 66 20 01 00 00 00 08", sent());
  EXPECT_FALSE(client.busy());
  answer("4B 66 20 01 67 00 00 00");
  EXPECT_EQ(1u, client.counters().stale);
  read(0x2066, 1);
  client.cancel();
  EXPECT_EQ("", sent()) << "the server never heard of it";
  read(0x2066, 1);
  exchange("40 66 20 01 00 00 00 00", "4B 66 20 01 67 00 00 00");
  client.cancel();
  EXPECT_EQ("", sent()) << "it was over";
  EXPECT_FALSE(client.takeAnswer());
}

// BU 0060 p. 62 and BU 0260 p. 56: every code they list has a text; a code nobody knows is shown as a number.
TEST(SdoAbort, CodesOfTheManualsHaveATextAndOthersTheirNumber) {
  for (const std::uint32_t code :
       {0x05030000u, 0x05040000u, 0x05040001u, 0x05040005u, 0x06010000u, 0x06010001u, 0x06010002u, 0x06020000u,
        0x06040041u, 0x06040042u, 0x06040043u, 0x06040047u, 0x06060000u, 0x06070010u, 0x06070012u, 0x06070013u,
        0x06090011u, 0x06090030u, 0x06090031u, 0x06090032u, 0x08000020u, 0x08000021u}) {
    EXPECT_NE(nullptr, abortMeaning(code)) << std::hex << code;
  }
  EXPECT_EQ("0609 0011h (the sub-index does not exist)", abortText(0x06090011));
  EXPECT_EQ("0601 0002h (the object is read-only)", abortText(0x06010002));
  EXPECT_EQ("0504 0000h (no answer in time)", abortText(0x05040000));
  EXPECT_EQ("DEAD BEEFh", abortText(0xDEADBEEF));
  EXPECT_EQ(nullptr, abortMeaning(0));
}

}  // namespace
}  // namespace nord_driver::canopen

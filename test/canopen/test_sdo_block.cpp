#include "canopen/sdo_conversation.h"
#include "canopen/sdo_crc.h"

namespace nord_driver::canopen {
namespace {

constexpr char kName[] = "NORD SK 500E CANopen";  // CRC 3B44h

class SdoBlockUpload : public SdoConversation {
 protected:
  /// Up to the start of the server's first block.
  void begin(const char* initiated = "C6 08 10 00 14 00 00 00") {
    read(0x1008, 0, true);
    exchange("A4 08 10 00 20 1C 00 00", initiated);
    EXPECT_EQ("A3 00 00 00 00 00 00 00", sent());
    EXPECT_EQ("", sent());
  }
};

// CiA 301 7.2.4.3.16.
TEST(SdoCrc, GivesTheStandardsValue) {
  const std::string digits = "123456789";
  EXPECT_EQ(0x31C3, sdoCrc(std::vector<std::uint8_t>{digits.begin(), digits.end()}));
  EXPECT_EQ(0, sdoCrc({}));
}

TEST_F(SdoBlockUpload, TakesSegmentsAndChecksTheSum) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 43");
  answer("02 20 35 30 30 45 20 43");
  EXPECT_EQ(1u, client.counters().stale);
  EXPECT_EQ("", sent());
  answer("83 41 4E 6F 70 65 6E 00");
  exchange("A2 03 20 00 00 00 00 00", "C5 44 3B 00 00 00 00 00");
  EXPECT_EQ("A1 00 00 00 00 00 00 00", sent());
  EXPECT_EQ(kName, takenText());
  EXPECT_EQ("", sent());
}

// The acknowledgement names the last segment in order; the server goes on behind it, counting from 1.
TEST_F(SdoBlockUpload, AsksAgainForALostSegment) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  answer("83 41 4E 6F 70 65 6E 00");
  EXPECT_EQ("A2 01 20 00 00 00 00 00", sent());
  answer("01 20 35 30 30 45 20 43");
  answer("82 41 4E 6F 70 65 6E 00");
  exchange("A2 02 20 00 00 00 00 00", "C5 44 3B 00 00 00 00 00");
  EXPECT_EQ(kName, takenText());
}

// When the end of a block is lost, the server waits for an acknowledgement: silence brings it.
TEST_F(SdoBlockUpload, AsksAgainForALostEnd) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 43");
  pass(kTimeout / 2 - Duration{1});
  EXPECT_EQ("", sent());
  pass(Duration{1});
  EXPECT_EQ("A2 02 20 00 00 00 00 00", sent());
  answer("81 41 4E 6F 70 65 6E 00");
  exchange("A2 01 20 00 00 00 00 00", "C5 44 3B 00 00 00 00 00");
  EXPECT_EQ(kName, takenText());
}

// Before the first segment the server may only be slow: the whole time-out, and no acknowledgement of nothing.
TEST_F(SdoBlockUpload, WaitsForTheFirstSegment) {
  begin();
  pass(kTimeout / 2);
  EXPECT_EQ("", sent());
  EXPECT_FALSE(client.takeAnswer());
  pass(kTimeout / 2);
  EXPECT_EQ("80 08 10 00 00 00 04 05", sent());
  expectAborted(SdoEnd::kTimedOut, 0x05040000);
}

TEST_F(SdoBlockUpload, GivesUpWhenAskingAgainBringsNothing) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  pass(kTimeout / 2);
  EXPECT_EQ("A2 01 20 00 00 00 00 00", sent());
  pass(kTimeout / 2);
  EXPECT_EQ("80 08 10 00 00 00 04 05", sent());
  expectAborted(SdoEnd::kTimedOut, 0x05040000);
}

// The first segment is lost again and again: an end after three blocks for nothing. (The same end of a block twice in a
// row would be a repetition on the bus.)
TEST_F(SdoBlockUpload, GivesUpWhenBlocksBringNothingNew) {
  begin();
  for (const char* end : {"83 41 4E 6F 70 65 6E 00", "84 41 4E 6F 70 65 6E 00", "83 41 4E 6F 70 65 6E 00"}) {
    answer(end);
    EXPECT_EQ("A2 00 20 00 00 00 00 00", sent());
    answer(end);
    EXPECT_EQ("", sent());
  }
  answer("84 41 4E 6F 70 65 6E 00");
  EXPECT_EQ("80 08 10 00 03 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040003);
}

// A block ends with its last sequence number too: 32 segments, the acknowledgement, and the rest.
TEST_F(SdoBlockUpload, TakesSeveralBlocks) {
  std::string whole;
  begin("C4 08 10 00 00 00 00 00");
  for (unsigned i = 1; i <= 34; ++i) {
    const std::uint8_t number = static_cast<std::uint8_t>(i <= 32 ? i : i - 32);
    const std::uint8_t letter = static_cast<std::uint8_t>('0' + i);
    whole += std::string(7, static_cast<char>(letter));
    SdoBytes segment;
    segment.fill(letter);
    segment[0] = static_cast<std::uint8_t>(i == 34 ? 0x80 | number : number);
    client.handle(dataFrame(0x5B2, segment), now);
    if (i == 32) {
      EXPECT_EQ("A2 20 20 00 00 00 00 00", sent());
      client.handle(dataFrame(0x5B2, segment), now);  // the last one again, behind its acknowledgement
      EXPECT_EQ("", sent());
    }
  }
  EXPECT_EQ("A2 02 20 00 00 00 00 00", sent());
  const std::uint16_t crc = sdoCrc(std::vector<std::uint8_t>{whole.begin(), whole.end()});
  SdoBytes end{};
  end[0] = 0xC1;
  end[1] = static_cast<std::uint8_t>(crc);
  end[2] = static_cast<std::uint8_t>(crc >> 8);
  client.handle(dataFrame(0x5B2, end), now);
  EXPECT_EQ(whole, takenText());
  EXPECT_EQ(1u, client.counters().stale);
}

// Twice the same part of a block is lost: what looks like a repetition on the bus is cleared up by silence.
TEST_F(SdoBlockUpload, TheSameSegmentsAreLostTwice) {
  begin();
  answer("83 41 4E 6F 70 65 6E 00");
  EXPECT_EQ("A2 00 20 00 00 00 00 00", sent());
  answer("83 41 4E 6F 70 65 6E 00");
  EXPECT_EQ("", sent());
  pass(kTimeout / 2);
  EXPECT_EQ("A2 00 20 00 00 00 00 00", sent());
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 43");
  answer("83 41 4E 6F 70 65 6E 00");
  exchange("A2 03 20 00 00 00 00 00", "C5 44 3B 00 00 00 00 00");
  EXPECT_EQ(kName, takenText());
}

TEST_F(SdoBlockUpload, AWrongCheckSumAborts) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 42");
  answer("83 41 4E 6F 70 65 6E 00");
  exchange("A2 03 20 00 00 00 00 00", "C5 44 3B 00 00 00 00 00");
  EXPECT_EQ("80 08 10 00 04 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040004);
}

// C2h: a server without check sum. The size still binds.
TEST_F(SdoBlockUpload, WithoutCheckSumTheSizeBinds) {
  begin("C2 08 10 00 14 00 00 00");
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 43");
  answer("83 41 4E 6F 70 65 6E 00");
  exchange("A2 03 20 00 00 00 00 00", "C5 00 00 00 00 00 00 00");
  EXPECT_EQ(kName, takenText());
  EXPECT_EQ("A1 00 00 00 00 00 00 00", sent());
  begin("C2 08 10 00 15 00 00 00");
  answer("01 4E 4F 52 44 20 53 4B");
  answer("02 20 35 30 30 45 20 43");
  answer("83 41 4E 6F 70 65 6E 00");
  exchange("A2 03 20 00 00 00 00 00", "C5 00 00 00 00 00 00 00");
  EXPECT_EQ("80 08 10 00 10 00 07 06", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x06070010);
}

// CiA 301 7.2.4.3.13: a server may answer in plain; expedited or in segments.
TEST_F(SdoBlockUpload, TakesAPlainAnswer) {
  read(0x2066, 1, true);
  exchange("A4 66 20 01 20 1C 00 00", "4B 66 20 01 67 00 00 00");
  EXPECT_EQ(103u, taken().number());
  read(0x1008, 0, true);
  exchange("A4 08 10 00 20 1C 00 00", "41 08 10 00 04 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "07 4E 4F 52 44 00 00 00");
  EXPECT_EQ("NORD", takenText());
}

// A server without block transfers refuses the command with 0504 0001h, and is asked in plain.
TEST_F(SdoBlockUpload, AsksInPlainWhenRefused) {
  read(0x2066, 1, true);
  exchange("A4 66 20 01 20 1C 00 00", "80 66 20 01 01 00 04 05");
  answer("80 66 20 01 01 00 04 05");  // repeated on the bus
  exchange("40 66 20 01 00 00 00 00", "80 66 20 01 01 00 04 05");
  expectAborted(SdoEnd::kAbortedByServer, 0x05040001);
}

TEST_F(SdoBlockUpload, TheServerMayAbortBetweenSegments) {
  begin();
  answer("01 4E 4F 52 44 20 53 4B");
  answer("80 08 10 00 00 00 06 06");
  expectAborted(SdoEnd::kAbortedByServer, 0x06060000);
}

// An end that takes away more than there is, and sequence numbers beyond the block.
TEST_F(SdoBlockUpload, FramesAgainstTheRules) {
  begin("C4 08 10 00 00 00 00 00");
  answer("21 01 01 01 01 01 01 01");  // 33 of a block of 32
  answer("00 01 01 01 01 01 01 01");
  EXPECT_EQ(2u, client.counters().stale);
  answer("81 01 02 03 04 05 06 07");
  EXPECT_EQ("A2 01 20 00 00 00 00 00", sent());
  answer("C0 08 10 00 00 00 00 00");  // no end
  EXPECT_EQ(3u, client.counters().stale);
  answer("C1 00 00 00 00 00 00 00");
  EXPECT_EQ("80 08 10 00 04 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040004);
}

class SdoBlockDownload : public SdoConversation {
 protected:
  void begin(const char* initiated = "A4 FF 2F 00 02 00 00 00") {
    write(0x2FFF, 0, kName, true);
    exchange("C6 FF 2F 00 14 00 00 00", initiated);
  }
};

// CiA 301 7.2.4.3.9 to .11: the server chose blocks of two segments, then of 127.
TEST_F(SdoBlockDownload, SendsBlocksAndTheCheckSum) {
  begin();
  EXPECT_EQ("01 4E 4F 52 44 20 53 4B", sent());
  exchange("02 20 35 30 30 45 20 43", "A2 02 7F 00 00 00 00 00");
  exchange("81 41 4E 6F 70 65 6E 00", "A2 01 7F 00 00 00 00 00");
  exchange("C5 44 3B 00 00 00 00 00", "A1 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

TEST_F(SdoBlockDownload, SendsALostSegmentAgain) {
  begin("A4 FF 2F 00 7F 00 00 00");
  EXPECT_EQ("01 4E 4F 52 44 20 53 4B", sent());
  EXPECT_EQ("02 20 35 30 30 45 20 43", sent());
  exchange("83 41 4E 6F 70 65 6E 00", "A2 01 7F 00 00 00 00 00");
  EXPECT_EQ("01 20 35 30 30 45 20 43", sent());
  exchange("82 41 4E 6F 70 65 6E 00", "A2 02 7F 00 00 00 00 00");
  exchange("C5 44 3B 00 00 00 00 00", "A1 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

// A server without check sum gets zeros.
TEST_F(SdoBlockDownload, WithoutCheckSum) {
  write(0x2FFF, 0, "1234567", true);
  exchange("C6 FF 2F 00 07 00 00 00", "A0 FF 2F 00 7F 00 00 00");
  exchange("81 31 32 33 34 35 36 37", "A2 01 7F 00 00 00 00 00");
  exchange("C1 00 00 00 00 00 00 00", "A1 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

TEST_F(SdoBlockDownload, AnswersAgainstTheRules) {
  begin("A4 FF 2F 00 00 00 00 00");
  EXPECT_EQ("80 FF 2F 00 02 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040002);
  begin("A4 FF 2F 00 80 00 00 00");
  EXPECT_EQ("80 FF 2F 00 02 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040002);
  begin();
  sent();
  exchange("02 20 35 30 30 45 20 43", "A2 03 7F 00 00 00 00 00");  // more than was sent
  EXPECT_EQ("80 FF 2F 00 03 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040003);
  begin();
  sent();
  exchange("02 20 35 30 30 45 20 43", "A2 02 00 00 00 00 00 00");
  EXPECT_EQ("80 FF 2F 00 02 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040002);
}

// The answer to a plain download is none to this one: it is waited on for.
TEST_F(SdoBlockDownload, APlainAnswerIsStale) {
  write(0x2FFF, 0, kName, true);
  exchange("C6 FF 2F 00 14 00 00 00", "60 FF 2F 00 00 00 00 00");
  EXPECT_EQ(1u, client.counters().stale);
  EXPECT_EQ("", sent());
  answer("A4 FF 2F 00 02 00 00 00");
  EXPECT_EQ("01 4E 4F 52 44 20 53 4B", sent());
}

TEST_F(SdoBlockDownload, GivesUpWhenTheServerTakesNothing) {
  begin();
  for (int block = 0; block < 4; ++block) {
    EXPECT_EQ("01 4E 4F 52 44 20 53 4B", sent());
    EXPECT_EQ("02 20 35 30 30 45 20 43", sent());
    answer("A2 00 02 00 00 00 00 00");
  }
  EXPECT_EQ("80 FF 2F 00 03 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040003);
}

// An acknowledgement that comes while the block is being sent belongs to the block before.
TEST_F(SdoBlockDownload, AnEarlyAcknowledgementIsStale) {
  begin();
  EXPECT_EQ("01 4E 4F 52 44 20 53 4B", sent());
  answer("A2 01 02 00 00 00 00 00");
  EXPECT_EQ(1u, client.counters().stale);
  EXPECT_EQ("02 20 35 30 30 45 20 43", sent());
}

// A slow bus takes its time for a block: the server's time begins when the last segment has left.
TEST_F(SdoBlockDownload, TheTimeOutWaitsForTheSegmentsToLeave) {
  begin();
  sent();
  pass(kTimeout);
  EXPECT_EQ("02 20 35 30 30 45 20 43", sent());
  pass(kTimeout);
  EXPECT_FALSE(client.takeAnswer());
  pass(kTimeout);
  EXPECT_EQ("80 FF 2F 00 00 00 04 05", sent());
  expectAborted(SdoEnd::kTimedOut, 0x05040000);
}

TEST_F(SdoBlockDownload, SendsInPlainWhenRefused) {
  write(0x2FFF, 0, "NORD", true);
  exchange("C6 FF 2F 00 04 00 00 00", "80 FF 2F 00 01 00 04 05");
  exchange("23 FF 2F 00 4E 4F 52 44", "60 FF 2F 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

}  // namespace
}  // namespace nord_driver::canopen

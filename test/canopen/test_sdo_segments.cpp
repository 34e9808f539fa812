#include "canopen/sdo_conversation.h"

namespace nord_driver::canopen {
namespace {

class SdoSegments : public SdoConversation {};

// CiA 301 7.2.4.3.6 and .7: 41h tells 20 bytes; segments with alternating toggle bit, the last with n = 1 and c = 1.
TEST_F(SdoSegments, Uploads) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 14 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "00 4E 4F 52 44 20 53 4B");
  exchange("70 00 00 00 00 00 00 00", "10 20 35 30 30 45 20 43");
  exchange("60 00 00 00 00 00 00 00", "03 41 4E 6F 70 65 6E 00");
  EXPECT_EQ("NORD SK 500E CANopen", takenText());
  EXPECT_EQ("", sent());
}

// 40h: the server does not tell the size. An empty object is one segment without data.
TEST_F(SdoSegments, UploadsWithoutASize) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "40 08 10 00 00 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "07 4E 4F 52 44 00 00 00");
  EXPECT_EQ("NORD", takenText());
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 00 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "0F 00 00 00 00 00 00 00");
  EXPECT_EQ("", takenText());
}

// CiA 301 7.2.4.3.3 and .4: 21h with the size, then segments.
TEST_F(SdoSegments, Downloads) {
  write(0x2FFF, 0, "Inverter 1");
  exchange("21 FF 2F 00 0A 00 00 00", "60 FF 2F 00 00 00 00 00");
  exchange("00 49 6E 76 65 72 74 65", "20 00 00 00 00 00 00 00");
  exchange("19 72 20 31 00 00 00 00", "30 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

// A full last segment says so with c = 1 and n = 0.
TEST_F(SdoSegments, DownloadsAFullLastSegment) {
  write(0x2FFF, 0, "1234567");
  exchange("21 FF 2F 00 07 00 00 00", "60 FF 2F 00 00 00 00 00");
  exchange("01 31 32 33 34 35 36 37", "20 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

// CiA 301 7.2.4.3.4: a wrong toggle bit aborts with 0503 0000h.
TEST_F(SdoSegments, AWrongToggleBitAborts) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 14 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "10 4E 4F 52 44 20 53 4B");
  EXPECT_EQ("80 08 10 00 00 00 03 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05030000);
  write(0x2FFF, 0, "Inverter 1");
  exchange("21 FF 2F 00 0A 00 00 00", "60 FF 2F 00 00 00 00 00");
  exchange("00 49 6E 76 65 72 74 65", "30 00 00 00 00 00 00 00");
  EXPECT_EQ("80 FF 2F 00 00 00 03 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05030000);
  EXPECT_EQ(2u, client.counters().aborted_by_us);
}

// A frame that came twice (a repetition on the bus) has the toggle bit of before and the same content: it is no error.
TEST_F(SdoSegments, ARepeatedFrameIsNoError) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 0A 00 00 00");
  answer("41 08 10 00 0A 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "00 49 6E 76 65 72 74 65");
  answer("00 49 6E 76 65 72 74 65");
  EXPECT_EQ("70 00 00 00 00 00 00 00", sent());
  answer("00 49 6E 76 65 72 74 65");
  answer("19 72 20 31 00 00 00 00");
  EXPECT_EQ("Inverter 1", takenText());
  EXPECT_EQ(3u, client.counters().stale);
  write(0x2FFF, 0, "Inverter 1");
  exchange("21 FF 2F 00 0A 00 00 00", "60 FF 2F 00 00 00 00 00");
  exchange("00 49 6E 76 65 72 74 65", "20 00 00 00 00 00 00 00");
  answer("20 00 00 00 00 00 00 00");
  EXPECT_EQ("19 72 20 31 00 00 00 00", sent());
  answer("20 00 00 00 00 00 00 00");
  EXPECT_FALSE(client.takeAnswer());
  answer("30 00 00 00 00 00 00 00");
  EXPECT_TRUE(taken().ok());
}

// The size that was told binds.
TEST_F(SdoSegments, MoreOrLessThanToldAborts) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 05 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "01 49 6E 76 65 72 74 65");
  EXPECT_EQ("80 08 10 00 12 00 07 06", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x06070012);
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 08 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "01 49 6E 76 65 72 74 65");
  EXPECT_EQ("80 08 10 00 13 00 07 06", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x06070013);
}

// What does not fit the client's memory is refused: at once when the size is told, else when it is full.
TEST_F(SdoSegments, TooLargeForUs) {
  read(0x1021, 0);
  exchange("40 21 10 00 00 00 00 00", "41 21 10 00 FF 03 00 00");
  EXPECT_EQ("80 21 10 00 05 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040005);
  read(0x1021, 0);
  exchange("40 21 10 00 00 00 00 00", "41 21 10 00 FF FF FF FF");
  EXPECT_EQ("80 21 10 00 05 00 04 05", sent());
  expectAborted(SdoEnd::kAbortedByUs, 0x05040005);
  read(0x1021, 0);
  exchange("40 21 10 00 00 00 00 00", "40 21 10 00 00 00 00 00");
  int segments = 0;
  for (; client.nextDeadline() && segments < 200; ++segments) {
    sent();
    answer(segments % 2 == 0 ? "00 01 02 03 04 05 06 07" : "10 01 02 03 04 05 06 07");
  }
  EXPECT_EQ(147, segments);  // 146 * 7 = 1022 bytes fit, the next do not
  expectAborted(SdoEnd::kAbortedByUs, 0x05040005);
}

// Empty segments that are not the last would go on for ever.
TEST_F(SdoSegments, AnEmptySegmentInTheMiddleAborts) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "40 08 10 00 00 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "0E 00 00 00 00 00 00 00");
  expectAborted(SdoEnd::kAbortedByUs, 0x06070013);
}

TEST_F(SdoSegments, TheServerMayAbortInTheMiddle) {
  read(0x1008, 0);
  exchange("40 08 10 00 00 00 00 00", "41 08 10 00 14 00 00 00");
  exchange("60 00 00 00 00 00 00 00", "80 08 10 00 00 00 06 06");
  expectAborted(SdoEnd::kAbortedByServer, 0x06060000);
}

}  // namespace
}  // namespace nord_driver::canopen

#include <gtest/gtest.h>

#include "profibus/record.h"

namespace nord_driver::profibus {
namespace {

RecordRequest request(bool write, std::uint8_t slot, std::uint8_t index, const char* hex, std::uint8_t length = 0) {
  RecordRequest made;
  made.write = write;
  made.slot = slot;
  made.index = index;
  made.length = length;
  for (const std::uint8_t byte : fromHex(hex)) made.data.push_back(byte);
  return made;
}

std::string encoded(const RecordRequest& made) {
  RecordPdu pdu;
  return encodeRecord(made, pdu) ? toHex(pdu) : "refused";
}

// As another maker's manual prints them (Buerkert 8644).
TEST(Record, Requests) {
  EXPECT_EQ("5E 03 30 28", encoded(request(false, 3, 0x30, "", 0x28)));
  EXPECT_EQ("5F 00 04 01 02", encoded(request(true, 0, 4, "02")));
  EXPECT_EQ("5F 03 30 04 81 00 01 07", encoded(request(true, 3, 0x30, "81 00 01 07")));
}

TEST(Record, ReadResponse) {
  RecordResult result;
  const auto pdu = fromHex("5E 03 30 04 81 00 01 07");
  EXPECT_EQ(RecordAnswer::kPositive, parseRecordAnswer(pdu, request(false, 3, 0x30, "", 0x28), result));
  EXPECT_EQ("81 00 01 07", toHex(result.data));
  for (std::size_t cut = 0; cut < pdu.size(); ++cut) {
    EXPECT_EQ(RecordAnswer::kOther,
              parseRecordAnswer(ByteView{pdu}.sub(0, cut), request(false, 3, 0x30, "", 0x28), result));
  }
}

TEST(Record, WriteResponse) {
  RecordResult result;
  EXPECT_EQ(RecordAnswer::kPositive, parseRecordAnswer(fromHex("5F 00 04 01"), request(true, 0, 4, "02"), result));
  EXPECT_EQ(RecordAnswer::kOther, parseRecordAnswer(fromHex("5F 00 04 02"), request(true, 0, 4, "02"), result));
  EXPECT_EQ(RecordAnswer::kOther, parseRecordAnswer(fromHex("5F 00 04 01 02"), request(true, 0, 4, "02"), result));
}

TEST(Record, ErrorsInWords) {
  EXPECT_STREQ("access denied", meaningOf({0x80, 0xB6, 0x01}));
  EXPECT_STREQ("access error", meaningOf({0x80, 0xBF, 0x01}));
  EXPECT_STREQ("an error of another protocol than DP-V1", meaningOf({0xFE, 0xB6, 0x01}));
}

}  // namespace
}  // namespace nord_driver::profibus

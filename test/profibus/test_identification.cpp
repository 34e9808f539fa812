#include <gtest/gtest.h>

#include "profibus/identification.h"
#include "profibus/record_wire.h"

namespace nord_driver::profibus {
namespace {

RecordResult answered(const char* hex = "") {
  RecordResult result;
  for (const std::uint8_t byte : fromHex(hex)) result.data.push_back(byte);
  return result;
}

// 08 00 FDE8, then ten bytes of the device, 393, "SK CU4-PBR", "123456", hardware 2, V1.3.0, revision 0, PROFIdrive,
// no type, I&M 1.1, I&M0 only.
constexpr const char* kTypePlate =
    "08 00 FD E8  20 20 20 20 20 20 20 20 20 20  01 89"
    "53 4B 20 43 55 34 2D 50 42 52 20 20 20 20 20 20 20 20 20 20"
    "31 32 33 34 35 36 20 20 20 20 20 20 20 20 20 20"
    "00 02  56 01 03 00  00 00  3A 00  00 00  01 01  00 01";

std::string encoded(const std::optional<RecordRequest>& request) {
  RecordPdu pdu;
  return request && encodeRecord(*request, pdu) ? toHex(pdu) : "none";
}

// The call is written to index 255, its answer read from there (PROFIBUS profile guideline, part 1).
TEST(Identification, TypePlateOfAModule) {
  IdentificationReader reader{0};
  EXPECT_EQ("5F 00 FF 04 08 00 FD E8", encoded(reader.pollRecord()));
  EXPECT_EQ("none", encoded(reader.pollRecord())) << "one at a time";
  reader.handleRecord(answered());
  EXPECT_FALSE(reader.done());
  EXPECT_EQ("5E 00 FF 44", encoded(reader.pollRecord()));
  reader.handleRecord(answered(kTypePlate));
  ASSERT_TRUE(reader.done());
  const auto plate = reader.typePlate();
  ASSERT_TRUE(plate);
  EXPECT_EQ(kNordManufacturer, plate->manufacturer) << "BU 0220 8.3.4.8";
  EXPECT_EQ(0x3A00, plate->profile);
  EXPECT_EQ(1, plate->version[0]);
  EXPECT_EQ(0x0001, plate->supported);
  EXPECT_STREQ("NORD (manufacturer 393), order number SK CU4-PBR, serial number 123456, hardware 2, software V1.3.0",
               describe(*plate).c_str());
}

// On MS1 beside data exchange, telegram by telegram.
TEST(Identification, TypePlateOverClass1) {
  RecordWire wire;
  wire.startsUpModular();
  IdentificationReader reader{0};
  ASSERT_TRUE(wire.master.submitRecord(0, *reader.pollRecord()));
  wire.cycleWith("68 0D 0D 68 88 81 5C 33 33 5F 00 FF 04 08 00 FD E8 1A 16",
                 "68 09 09 68 81 88 08 33 33 5F 00 FF 04 D9 16");
  reader.handleRecord(wire.result());
  ASSERT_TRUE(wire.master.submitRecord(0, *reader.pollRecord()));
  wire.cycleWith(
      "68 09 09 68 88 81 5C 33 33 5E 00 FF 44 6C 16",
      "68 4D 4D 68 81 88 08 33 33 5E 00 FF 44 08 00 FD E8 20 20 20 20 20 20 20 20 20 20 01 89 53 4B 20 43 55 "
      "34 2D 50 42 52 20 20 20 20 20 20 20 20 20 20 31 32 33 34 35 36 20 20 20 20 20 20 20 20 20 20 00 02 56 "
      "01 03 00 00 00 3A 00 00 00 01 01 00 01 B8 16");
  reader.handleRecord(wire.result());
  ASSERT_TRUE(reader.typePlate());
  EXPECT_STREQ("123456", reader.typePlate()->serial_number.c_str());
}

// Somebody else's device, and one that prints nothing.
TEST(Identification, OtherTypePlates) {
  TypePlate plate;
  plate.manufacturer = 26;
  plate.software_kind = 'V';
  EXPECT_STREQ("manufacturer 26, order number not told, serial number not told, hardware 0, software V0.0.0",
               describe(plate).c_str());
}

TEST(Identification, TextsOfTheUser) {
  IdentificationReader reader{1, 2};
  EXPECT_EQ("5F 02 FF 04 08 00 FD E9", encoded(reader.pollRecord()));
  reader.handleRecord(answered());
  reader.pollRecord();
  std::string record = "08 00 FD E9 00 00 00 00 00 00 00 00 00 00 ";
  record += "4C 45 46 54 20 01";
  for (int i = 6; i < 54; ++i) record += " 20";
  reader.handleRecord(answered(record.c_str()));
  EXPECT_STREQ("LEFT", reader.text().c_str());
  EXPECT_FALSE(reader.typePlate());
}

// What comes from the wire goes into logs and onto terminals: no control character, no escape sequence, and "%n" is two
// characters.
TEST(Identification, ATextHoldsOnlyWhatPrints) {
  IdentificationReader reader{1};
  reader.pollRecord();
  reader.handleRecord(answered());
  reader.pollRecord();
  std::string record = "08 00 FD E9 00 00 00 00 00 00 00 00 00 00 ";
  record += "41 1B 5B 32 4A 0A 25 6E 25 73 00 7F 80 FF 42";
  for (int i = 15; i < 54; ++i) record += " 00";
  reader.handleRecord(answered(record.c_str()));
  EXPECT_STREQ("A [2J %n%s    B", reader.text().c_str());
}

// "I&M to a certain extent": most modules have not all of them.
TEST(Identification, RefusalInWords) {
  IdentificationReader reader{2};
  reader.pollRecord();
  RecordResult refused;
  refused.outcome = RecordOutcome::kRefused;
  refused.error = {0x80, 0xB0, 0x00};
  reader.handleRecord(refused);
  EXPECT_TRUE(reader.done());
  EXPECT_STREQ("it has no I&M2 record: DP-V1 error B0, invalid index", reader.trouble().c_str());
  EXPECT_FALSE(reader.typePlate());
}

TEST(Identification, AnotherRecordIsNotTaken) {
  for (const char* wrong : {"08 00 FD E9", "08 00 FD E8", ""}) {
    IdentificationReader reader{0};
    reader.pollRecord();
    reader.handleRecord(answered());
    reader.pollRecord();
    reader.handleRecord(answered(wrong));
    EXPECT_TRUE(reader.done());
    EXPECT_FALSE(reader.typePlate()) << wrong;
    EXPECT_FALSE(reader.trouble().empty()) << wrong;
  }
}

TEST(Identification, FailureOfTheChannel) {
  IdentificationReader reader{0};
  reader.pollRecord();
  RecordResult lost;
  lost.outcome = RecordOutcome::kNoAnswer;
  reader.handleRecord(lost);
  EXPECT_TRUE(reader.done());
  EXPECT_EQ(RecordOutcome::kNoAnswer, reader.outcome());
  EXPECT_TRUE(reader.trouble().empty());
}

}  // namespace
}  // namespace nord_driver::profibus

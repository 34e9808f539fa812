#include <gtest/gtest.h>

#include <stdexcept>

#include "nord_driver/core/bytes.h"

namespace nord_driver {
namespace {

TEST(Bytes, PrintsTelegramsAsTheManualsDo) {
  EXPECT_EQ("04 7E 20 00", toHex(ByteView{fromHex("047e 2000")}));
  EXPECT_EQ("", toHex(ByteView{}));
  EXPECT_EQ("0B31", toHexWord(0x0B31));
}

TEST(Bytes, RefusesTextThatIsNoHex) {
  EXPECT_THROW(fromHex("04 7"), std::invalid_argument);
  EXPECT_THROW(fromHex("0 47"), std::invalid_argument);
  EXPECT_THROW(fromHex("04 7G"), std::invalid_argument);
}

TEST(Bytes, ReaderKnowsBothByteOrders) {
  const auto bytes = fromHex("04 7E 04 7E 12 34 56 78 12 34 56 78 99");
  ByteReader reader{ByteView{bytes}};
  EXPECT_EQ(0x047E, reader.u16be());
  EXPECT_EQ(0x7E04, reader.u16le());
  EXPECT_EQ(0x12345678u, reader.u32be());
  EXPECT_EQ(0x78563412u, reader.u32le());
  EXPECT_EQ(1u, reader.remaining());
  EXPECT_EQ(0x99, reader.u8());
  EXPECT_TRUE(reader.ok());
}

TEST(Bytes, ReadingPastTheEndIsRemembered) {
  const auto bytes = fromHex("04");
  ByteReader reader{ByteView{bytes}};
  EXPECT_EQ(0x0400, reader.u16be());
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(0, reader.u8());
}

TEST(Bytes, WriterIsTheReadersInverse) {
  FixedBytes<14> bytes;
  ByteWriter writer{bytes};
  writer.u8(0xA5);
  writer.u16be(0x047E);
  writer.u16le(0x047E);
  writer.u32be(0x01020304);
  writer.u32le(0x01020304);
  EXPECT_TRUE(writer.ok());
  EXPECT_EQ("A5 04 7E 7E 04 01 02 03 04 04 03 02 01", toHex(bytes));
  writer.append(ByteView{fromHex("11 22")});
  EXPECT_FALSE(writer.ok());
  EXPECT_EQ(14u, bytes.size());
}

TEST(Bytes, SubViewsAreCutAtTheEnd) {
  const auto bytes = fromHex("01 02 03");
  const ByteView view{bytes};
  EXPECT_EQ("02 03", toHex(view.sub(1, 9)));
  EXPECT_EQ("02", toHex(view.sub(1, 1)));
  EXPECT_TRUE(view.sub(7).empty());
}

TEST(Words, MinusHundredPercentIsMinus16384) {
  EXPECT_EQ(-16384, toSigned(0xC000));  // BU 0220 and BU 0280 print -16385 and -16383
  EXPECT_EQ(0xC000, toWord(-16384));
  EXPECT_EQ(0xFFFF, toWord(-1));
}

}  // namespace
}  // namespace nord_driver

#include <gtest/gtest.h>

#include "sim/profibus/telegram.h"

namespace nord_driver::sim {
namespace {

ParseKind kindOf(const std::string& hex) {
  Telegram telegram;
  const std::vector<std::uint8_t> bytes = fromHex(hex);
  return parseTelegram(bytes, telegram).kind;
}

// Telegrams captured on real segments are read: FDL status, diagnosis request, Set_Prm, token, short acknowledgement.
TEST(Telegram, ReadsCapturedOnes) {
  for (const char* hex : {"10 02 63 49 AE 16", "10 63 02 00 65 16", "68 05 05 68 82 E3 6D 3C 3E 4C 16",
                          "68 0B 0B 68 E3 82 08 3E 3C 02 05 00 FF 0C DA D3 16",
                          "68 13 13 68 88 82 5D 3D 3E B8 1E 01 00 0A 35 01 00 00 00 82 00 00 00 7B 16", "DC 01 01",
                          "E5", "A2 08 01 7D 04 7E 00 00 00 00 00 00 08 16"}) {
    EXPECT_EQ(ParseKind::kTelegram, kindOf(hex)) << hex;
  }
}

TEST(Telegram, SplitsServiceAccessPoints) {
  Telegram telegram;
  const auto bytes = fromHex("68 06 06 68 88 82 7D 3E 3E 21 24 16");
  const ParseResult result = parseTelegram(bytes, telegram);
  ASSERT_EQ(ParseKind::kTelegram, result.kind);
  EXPECT_EQ(12u, result.length);
  EXPECT_EQ(8, telegram.destination);
  EXPECT_EQ(2, telegram.source);
  EXPECT_EQ(62, telegram.destination_sap.value());
  EXPECT_EQ(62, telegram.source_sap.value());
  EXPECT_EQ((FixedBytes<246>{0x21}), telegram.data);
  EXPECT_TRUE(telegram.fcb() && telegram.fcv() && telegram.isRequest());
}

// Every shorter beginning asks for more; one flipped bit anywhere never passes as the same telegram.
TEST(Telegram, IsStrict) {
  const auto bytes = fromHex("68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 00 25 16");
  Telegram telegram;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_EQ(ParseKind::kNeedMore, parseTelegram(ByteView{bytes.data(), n}, telegram).kind) << n;
  }
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    auto flipped = bytes;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(ParseKind::kTelegram, parseTelegram(flipped, telegram).kind) << bit;
  }
  // LE 4 with ten bytes, and LE 3: examples of another project that are wrong.
  EXPECT_EQ(ParseKind::kMalformed, kindOf("68 04 04 68 02 14 08 00 00 00 00 00 00 00 1e 16"));
  EXPECT_EQ(ParseKind::kMalformed, kindOf("68 03 03 68 94 82 6D 3B 3E fc 16"));
  // An address that announces a SAP which is not there.
  EXPECT_EQ(ParseKind::kMalformed, kindOf("10 88 01 49 D2 16"));
}

}  // namespace
}  // namespace nord_driver::sim

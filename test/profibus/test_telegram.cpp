#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "profibus/telegram.h"
#include "profibus/vectors.h"

namespace nord_driver::profibus {
namespace {

Telegram parsed(const std::vector<std::uint8_t>& bytes) {
  const ParseResult result = parse(bytes);
  EXPECT_EQ(Parse::kOk, result.kind) << toHex(bytes);
  EXPECT_EQ(bytes.size(), result.eaten);
  return result.telegram;
}

// Every captured and hand-written telegram is read, and writing what was read gives the same bytes.
TEST(Telegram, ReadsAndWritesEveryKnownTelegram) {
  for (const char* text : validTelegrams()) {
    const auto bytes = fromHex(text);
    Frame frame;
    ASSERT_TRUE(encode(parsed(bytes), frame)) << text;
    EXPECT_EQ(text, toHex(frame));
  }
}

TEST(Telegram, NeedsMoreAtEveryTruncatedLength) {
  for (const char* text : validTelegrams()) {
    const auto bytes = fromHex(text);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      EXPECT_EQ(Parse::kNeedMore, parse(ByteView{bytes}.sub(0, n)).kind) << text << " cut to " << n;
    }
  }
}

TEST(Telegram, EatsOnlyItsOwnBytes) {
  for (const char* text : validTelegrams()) {
    auto bytes = fromHex(text);
    const std::size_t length = bytes.size();
    bytes.insert(bytes.end(), {0x68, 0xE5, 0x10});
    const ParseResult result = parse(bytes);
    EXPECT_EQ(Parse::kOk, result.kind) << text;
    EXPECT_EQ(length, result.eaten);
  }
}

TEST(Telegram, RefusesEveryInvalidTelegram) {
  for (const char* text : invalidTelegrams()) EXPECT_EQ(Parse::kMalformed, parse(fromHex(text)).kind) << text;
}

// A flipped bit is never taken for the telegram it was, nor, where there is an FCS, for another one of its length.
TEST(Telegram, NeverAcceptsAFlippedBit) {
  for (const char* text : validTelegrams()) {
    const auto bytes = fromHex(text);
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      auto flipped = bytes;
      flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ 1u << bit % 8);
      const ParseResult result = parse(flipped);
      if (result.kind != Parse::kOk) continue;
      Frame again;
      ASSERT_TRUE(encode(result.telegram, again));
      EXPECT_NE(text, toHex(again)) << "bit " << bit;
      // The token has no FCS: another one comes of it. Nothing else does.
      EXPECT_EQ(TelegramKind::kSd4, result.telegram.kind) << text << " bit " << bit;
    }
  }
}

TEST(Telegram, TellsWhatIsWrong) {
  EXPECT_EQ(Defect::kLength, parse(fromHex("68 05 06")).defect);
  EXPECT_EQ(Defect::kStartDelimiter, parse(fromHex("68 05 05 10")).defect);
  EXPECT_EQ(Defect::kChecksum, parse(fromHex("10 02 63 49 AF 16")).defect);
  EXPECT_EQ(Defect::kEndDelimiter, parse(fromHex("10 02 63 49 AE 15")).defect);
  EXPECT_EQ(Defect::kAddress, parse(fromHex("10 82 01 49 CC 16")).defect);
  EXPECT_EQ(Defect::kStartDelimiter, parse(fromHex("E7")).defect);
}

// The fields of a Slave_Diag answer: access points apart from the data, addresses without their bit 7.
TEST(Telegram, SeparatesAccessPointsFromData) {
  const auto bytes = fromHex("68 0B 0B 68 82 88 08 3E 3C 02 05 00 FF 0A 35 D1 16");
  const Telegram telegram = parsed(bytes);
  EXPECT_EQ(TelegramKind::kSd2, telegram.kind);
  EXPECT_EQ(2, telegram.da);
  EXPECT_EQ(8, telegram.sa);
  EXPECT_EQ(0x08, telegram.fc);
  EXPECT_EQ(62, telegram.dsap);
  EXPECT_EQ(60, telegram.ssap);
  EXPECT_EQ("02 05 00 FF 0A 35", toHex(telegram.data));
}

TEST(Telegram, CarriesUpTo246Octets) {
  const std::vector<std::uint8_t> data(246, 0xA5);
  Telegram telegram;
  telegram.kind = TelegramKind::kSd2;
  telegram.da = 3;
  telegram.data = data;
  Frame frame;
  ASSERT_TRUE(encode(telegram, frame));
  EXPECT_EQ(kMaxTelegramLength, frame.size());
  EXPECT_EQ(249, frame[1]);
  EXPECT_EQ(Parse::kOk, parse(frame).kind);
}

TEST(Telegram, DoesNotWriteWhatItsKindCannotCarry) {
  const std::vector<std::uint8_t> data(247, 0);
  Frame frame;
  const auto refuses = [&](TelegramKind kind, std::size_t length, bool sap, std::uint8_t da, std::uint8_t sa) {
    Telegram telegram;
    telegram.kind = kind;
    telegram.da = da;
    telegram.sa = sa;
    if (sap) telegram.dsap = 60;
    telegram.data = ByteView{data}.sub(0, length);
    return !encode(telegram, frame) && frame.empty();
  };
  EXPECT_TRUE(refuses(TelegramKind::kSd1, 1, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd1, 0, true, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd2, 0, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd2, 247, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd2, 246, true, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd3, 7, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd3, 8, true, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd4, 1, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd4, 0, false, 127, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSc, 1, false, 3, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd1, 0, false, 128, 1));
  EXPECT_TRUE(refuses(TelegramKind::kSd1, 0, false, 3, 127));
}

// Whatever comes in, what is accepted writes back to the very bytes it was read from: several bytes of a good telegram
// are replaced, its checksum put right again half of the time.
RC_GTEST_PROP(TelegramProperty, AcceptsOnlyWhatItWouldWrite, ()) {
  auto bytes = fromHex(*rc::gen::elementOf(validTelegrams()));
  const auto changes = *rc::gen::inRange(1, 4);
  for (int i = 0; i < changes; ++i) {
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<std::uint8_t>();
  }
  const std::size_t head = bytes[0] == 0x68 ? 4 : 1;
  if (bytes.size() > head + 2 && *rc::gen::arbitrary<bool>()) {
    unsigned sum = 0;
    for (std::size_t i = head; i < bytes.size() - 2; ++i) sum += bytes[i];
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(sum & 0xFFu);
  }
  const ParseResult result = parse(bytes);
  RC_CLASSIFY(result.kind == Parse::kOk, "accepted");
  if (result.kind != Parse::kOk) return;
  Frame frame;
  RC_ASSERT(encode(result.telegram, frame));
  RC_ASSERT(ByteView{frame} == ByteView{bytes}.sub(0, result.eaten));
}

// Any telegram with data survives the way to bytes and back.
RC_GTEST_PROP(TelegramProperty, RoundTrip, ()) {
  const auto length = *rc::gen::inRange<std::size_t>(1, 244);
  const auto data = *rc::gen::container<std::vector<std::uint8_t>>(length, rc::gen::arbitrary<std::uint8_t>());
  Telegram sent;
  sent.kind = TelegramKind::kSd2;
  sent.da = *rc::gen::inRange<std::uint8_t>(0, 128);
  sent.sa = *rc::gen::inRange<std::uint8_t>(0, 127);
  sent.fc = *rc::gen::arbitrary<std::uint8_t>();
  if (*rc::gen::arbitrary<bool>()) sent.dsap = *rc::gen::arbitrary<std::uint8_t>();
  if (*rc::gen::arbitrary<bool>()) sent.ssap = *rc::gen::arbitrary<std::uint8_t>();
  sent.data = data;
  Frame frame;
  RC_ASSERT(encode(sent, frame));
  const ParseResult result = parse(frame);
  RC_ASSERT(result.kind == Parse::kOk);
  RC_ASSERT(result.eaten == frame.size());
  RC_ASSERT(result.telegram.da == sent.da && result.telegram.sa == sent.sa && result.telegram.fc == sent.fc);
  RC_ASSERT(result.telegram.dsap == sent.dsap && result.telegram.ssap == sent.ssap);
  RC_ASSERT(result.telegram.data == sent.data);
}

}  // namespace
}  // namespace nord_driver::profibus

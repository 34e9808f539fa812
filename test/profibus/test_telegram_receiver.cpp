#include <gtest/gtest.h>

#include <random>

#include "profibus/telegram_receiver.h"
#include "profibus/vectors.h"

namespace nord_driver::profibus {
namespace {

std::vector<std::string> receive(TelegramReceiver& receiver, ByteView bytes, std::size_t chunk) {
  std::vector<std::string> telegrams;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    receiver.receive(bytes.sub(at, chunk), [&](const Telegram& telegram) {
      Frame frame;
      EXPECT_TRUE(encode(telegram, frame));
      telegrams.push_back(toHex(frame));
    });
  }
  return telegrams;
}

void expectBalance(const TelegramReceiver& receiver) {
  const ReceiverCounters& counters = receiver.counters();
  EXPECT_EQ(counters.bytes_received, counters.bytes_in_telegrams + counters.bytes_discarded + receiver.buffered());
}

// The size of the chunks means nothing: an adapter may cut a telegram anywhere and glue several together.
TEST(TelegramReceiver, FindsAllTelegramsInChunksOfAnySize) {
  std::vector<std::uint8_t> stream;
  std::vector<std::string> expected;
  for (const char* text : validTelegrams()) {
    const auto bytes = fromHex(text);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    expected.emplace_back(text);
  }
  for (const std::size_t chunk : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{7}, std::size_t{64},
                                  std::size_t{255}, std::size_t{256}, std::size_t{257}, stream.size()}) {
    TelegramReceiver receiver;
    EXPECT_EQ(expected, receive(receiver, stream, chunk)) << "chunks of " << chunk;
    EXPECT_EQ(stream.size(), receiver.counters().bytes_in_telegrams);
    EXPECT_EQ(expected.size(), receiver.counters().telegrams);
    EXPECT_EQ(0u, receiver.counters().bytes_discarded);
  }
}

// Noise in front of, between and behind telegrams is counted and costs none of them.
TEST(TelegramReceiver, FindsTelegramsBetweenNoise) {
  const auto stream = fromHex(
      "E7 A7 DA 00 FF"
      "10 02 08 00 0A 16"
      "E7 A7 DA"
      "68 0B 0B 68 82 88 08 3E 3C 00 0C 00 02 0A 35 D9 16"
      "68 05 06"
      "10 02 08 03 0D 16"
      "00 00");
  for (std::size_t chunk = 1; chunk <= stream.size(); ++chunk) {
    TelegramReceiver receiver;
    const std::vector<std::string> expected{"10 02 08 00 0A 16", "68 0B 0B 68 82 88 08 3E 3C 00 0C 00 02 0A 35 D9 16",
                                            "10 02 08 03 0D 16"};
    EXPECT_EQ(expected, receive(receiver, stream, chunk));
    EXPECT_EQ(13u, receiver.counters().bytes_discarded);
    EXPECT_EQ(29u, receiver.counters().bytes_in_telegrams);
    expectBalance(receiver);
  }
}

// A false header swallows what follows only until its own end; then the search goes on behind its first byte.
TEST(TelegramReceiver, FindsATelegramInsideAFalseOne) {
  TelegramReceiver receiver;
  const auto telegrams = receive(receiver, fromHex("68 05 05 68  10 02 08 00 0A 16  10 02 08 03 0D 16"), 5);
  EXPECT_EQ((std::vector<std::string>{"10 02 08 00 0A 16", "10 02 08 03 0D 16"}), telegrams);
  EXPECT_EQ(1u, receiver.counters().checksum_errors);
  EXPECT_EQ(4u, receiver.counters().bytes_discarded);
}

TEST(TelegramReceiver, CountsChecksumErrorsApart) {
  TelegramReceiver receiver;
  EXPECT_TRUE(receive(receiver, fromHex("10 02 08 00 0B 16"), 6).empty());
  EXPECT_EQ(1u, receiver.counters().checksum_errors);
  EXPECT_TRUE(receive(receiver, fromHex("10 02 08 00 0A 17"), 6).empty());
  EXPECT_EQ(1u, receiver.counters().checksum_errors);
  expectBalance(receiver);
}

TEST(TelegramReceiver, GivesUpAnIncompleteTelegramWhenTold) {
  TelegramReceiver receiver;
  EXPECT_TRUE(receive(receiver, fromHex("68 F9 F9 68 01 02"), 6).empty());
  EXPECT_EQ(6u, receiver.buffered());
  expectBalance(receiver);
  receiver.discard();
  EXPECT_EQ(0u, receiver.buffered());
  EXPECT_EQ(6u, receiver.counters().bytes_discarded);
  EXPECT_EQ(1u, receive(receiver, fromHex("10 02 08 00 0A 16"), 1).size());
  expectBalance(receiver);
}

TEST(TelegramReceiver, CountsEveryByteOfAMillionRandomOnes) {
  std::mt19937 random{20240607};
  TelegramReceiver receiver;
  std::vector<std::uint8_t> chunk;
  for (std::size_t total = 0; total < 1'000'000; total += chunk.size()) {
    chunk.resize(1 + random() % 700);
    for (auto& byte : chunk) {
      // Half of it looks like the beginning of something.
      constexpr std::uint8_t kLikely[] = {0x10, 0x68, 0xA2, 0xDC, 0xE5, 0x16, 0x05, 0xF9};
      byte = random() % 2 == 0 ? kLikely[random() % 8] : static_cast<std::uint8_t>(random());
    }
    receiver.receive(chunk, [](const Telegram&) {});
    ASSERT_LT(receiver.buffered(), kMaxTelegramLength);
  }
  expectBalance(receiver);
  EXPECT_GT(receiver.counters().telegrams, 0u);
  EXPECT_GT(receiver.counters().checksum_errors, 0u);
}

}  // namespace
}  // namespace nord_driver::profibus

#include <gtest/gtest.h>

#include <vector>

#include "nord_driver/trace/telegram_trace.h"

namespace nord_driver {
namespace {

Instant at(int milliseconds) {
  return Instant{std::chrono::milliseconds{milliseconds}};
}

// The last telegrams stay, oldest first, with time and direction.
TEST(TelegramTrace, KeepsTheLastTelegrams) {
  TelegramTrace trace{kLinkTypeProfibusDl, nullptr, 3};
  for (int i = 1; i <= 5; ++i) {
    trace.record(i % 2 == 0 ? TraceKind::kReceived : TraceKind::kSent, fromHex(std::string("E") + std::to_string(i)),
                 at(i));
  }
  const std::vector<TraceRecord> records = trace.copy();
  ASSERT_EQ(3u, records.size());
  EXPECT_EQ(5u, trace.recorded());
  EXPECT_EQ("E3", toHex(records[0].view()));
  EXPECT_EQ("E4", toHex(records[1].view()));
  EXPECT_EQ("E5", toHex(records[2].view()));
  EXPECT_EQ(at(3), records[0].time);
  EXPECT_EQ(TraceKind::kSent, records[0].kind);
  EXPECT_EQ(TraceKind::kReceived, records[1].kind);
}

// The longest telegram fits one record; more bytes than that take another one and none is lost.
TEST(TelegramTrace, CutsWhatIsLongerThanARecord) {
  TelegramTrace trace{kLinkTypeProfibusDl, nullptr, 4};
  std::vector<std::uint8_t> bytes(256, 0x68);
  bytes.back() = 0x16;
  trace.record(TraceKind::kNoise, bytes, at(1));
  trace.record(TraceKind::kNoise, {}, at(2));
  const std::vector<TraceRecord> records = trace.copy();
  ASSERT_EQ(2u, records.size());
  EXPECT_EQ(255u, records[0].view().size());
  EXPECT_EQ("16", toHex(records[1].view()));
}

// A bus may have its own way to write its bytes; without one they are hexadecimal.
TEST(TelegramTrace, WritesBytesTheWayOfTheirBus) {
  TelegramTrace plain{kLinkTypeProfibusDl, nullptr, 4};
  TelegramTrace own{kLinkTypeCanSocketCan, nullptr, 4,
                    [](const TraceRecord& record) { return "<" + std::to_string(record.length) + ">"; }};
  const std::vector<std::uint8_t> bytes{0x68, 0x16};
  plain.record(TraceKind::kSent, bytes, at(1));
  own.record(TraceKind::kSent, bytes, at(1));
  EXPECT_EQ("68 16", plain.raw(plain.copy()[0]));
  EXPECT_EQ("<2>", own.raw(own.copy()[0]));
}

// The default length is the one users are told.
TEST(TelegramTrace, HoldsTenThousand) {
  TelegramTrace trace{kLinkTypeProfibusDl, nullptr};
  const std::vector<std::uint8_t> acknowledge{0xE5};
  for (int i = 0; i < 10'001; ++i) trace.record(TraceKind::kReceived, acknowledge, at(i));
  const std::vector<TraceRecord> records = trace.copy();
  ASSERT_EQ(10'000u, records.size());
  EXPECT_EQ(at(1), records.front().time);
}

}  // namespace
}  // namespace nord_driver

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "transport/profibus/profibus_recorder.h"

namespace nord_driver {
namespace {

class ProfibusRecorderTest : public ::testing::Test {
 protected:
  static Instant at(int milliseconds) { return Instant{std::chrono::milliseconds{milliseconds}}; }
  void send(const std::string& hex, int ms) { recorder_.handleSent(fromHex(hex), at(ms)); }
  void receive(const std::string& hex, int ms) { recorder_.handleReceived(fromHex(hex), at(ms)); }
  /// "3> 10 ..": time in ms, direction, bytes.
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const TraceRecord& record : trace_.copy()) {
      const char* sign = record.kind == TraceKind::kSent ? "> " : record.kind == TraceKind::kReceived ? "< " : "? ";
      lines.push_back(std::to_string(record.time.time_since_epoch() / std::chrono::milliseconds{1}) + sign +
                      toHex(record.view()));
    }
    return lines;
  }
  using Lines = std::vector<std::string>;

  TelegramTrace trace_{kLinkTypeProfibusDl, nullptr, 20};
  ProfibusRecorder recorder_{trace_};
};

// An answer that comes in pieces is one telegram, stamped when it was whole.
TEST_F(ProfibusRecorderTest, JoinsPieces) {
  send("10 03 01 49 4D 16", 1);
  receive("10 01", 2);
  EXPECT_EQ(1u, lines().size());
  receive("03 00 04 16", 3);
  EXPECT_EQ((Lines{"1> 10 03 01 49 4D 16", "3< 10 01 03 00 04 16"}), lines());
}

// Two telegrams in one read are two records.
TEST_F(ProfibusRecorderTest, SeparatesTelegrams) {
  receive("E5 DC 02 01 E5", 1);
  EXPECT_EQ((Lines{"1< E5", "1< DC 02 01", "1< E5"}), lines());
}

// Bytes that are no telegram are kept as such, together, in their place before the telegram that follows.
TEST_F(ProfibusRecorderTest, MarksNoise) {
  receive("00 FF", 1);
  receive("00", 2);
  receive("E5", 3);
  EXPECT_EQ((Lines{"1? 00 FF 00", "3< E5"}), lines());
}

// A telegram with a wrong checksum is noise: its bytes are all there.
TEST_F(ProfibusRecorderTest, MarksABrokenTelegram) {
  receive("10 01 03 00 05 16", 1);
  send("DC 02 01", 2);
  EXPECT_EQ((Lines{"1? 10 01 03 00 05 16", "2> DC 02 01"}), lines());
}

// What is still incomplete when the next telegram is sent will never be one.
TEST_F(ProfibusRecorderTest, GivesUpAnIncompleteTelegramAtTheNextRequest) {
  receive("68 0F 0F", 1);
  send("DC 02 01", 2);
  receive("E5", 3);
  EXPECT_EQ((Lines{"1? 68 0F 0F", "2> DC 02 01", "3< E5"}), lines());
}

// A babbling line fills a record with many bytes, not one each.
TEST_F(ProfibusRecorderTest, PutsMuchNoiseIntoFewRecords) {
  const std::vector<std::uint8_t> zeros(600, 0x00);
  recorder_.handleReceived(zeros, at(1));
  recorder_.flush();
  std::size_t bytes = 0;
  for (const TraceRecord& record : trace_.copy()) bytes += record.length;
  EXPECT_EQ(600u, bytes);
  EXPECT_LE(trace_.recorded(), 6u);
}

}  // namespace
}  // namespace nord_driver

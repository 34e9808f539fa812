#include <gtest/gtest.h>

#include "node/bus_log_debouncer.h"

namespace nord_driver::node {
namespace {

using std::chrono::milliseconds;

class BusLogDebouncerTest : public ::testing::Test {
 protected:
  /// What is said within `duration` while the bus is in this state, looked at every 10 ms; the sentences, joined.
  std::string during(milliseconds duration, const std::string& text, bool good) {
    std::string said;
    for (const Instant end = now_ + duration; now_ < end; now_ += milliseconds{10}) {
      const auto line = debouncer_.poll(text, good, now_);
      if (!line) continue;
      EXPECT_EQ(line->good, good);
      said += line->text + ".";
    }
    return said;
  }

  BusLogDebouncer debouncer_;
  Instant now_ = Instant{} + std::chrono::hours{1};
};

// No station can answer before it has been asked: that is not told.
TEST_F(BusLogDebouncerTest, AnOrdinaryStartIsNoTrouble) {
  EXPECT_EQ("", during(milliseconds{300}, "no station answers", false));
  EXPECT_EQ("", during(milliseconds{100}, "drive right: no answer", false));
  EXPECT_EQ("all drives answer.", during(milliseconds{5000}, "all drives answer", true));
}

TEST_F(BusLogDebouncerTest, TroubleThatLastsIsSaidOnceAndSoIsItsEnd) {
  EXPECT_EQ("", during(milliseconds{1000}, "cannot be opened", false));
  EXPECT_EQ("cannot be opened.", during(milliseconds{5000}, "cannot be opened", false));
  EXPECT_EQ("all drives answer.", during(milliseconds{5000}, "all drives answer", true));
}

// A loose contact: 20 ms of silence five times a second.
TEST_F(BusLogDebouncerTest, ShortGapsFillNoLog) {
  EXPECT_EQ("all drives answer.", during(milliseconds{1000}, "all drives answer", true));
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ("", during(milliseconds{20}, "drive left: no answer", false));
    EXPECT_EQ("", during(milliseconds{180}, "all drives answer", true));
  }
}

// Another cause is told, too, but a sentence that changes all the time once a second.
TEST_F(BusLogDebouncerTest, ChangingTroubleIsSaidOnceASecond) {
  EXPECT_EQ("no station answers.", during(milliseconds{1500}, "no station answers", false));
  std::size_t said = 0;
  for (int i = 0; i < 100; ++i) {
    said += during(milliseconds{50}, "drive left: no answer", false).empty() ? 0 : 1;
    said += during(milliseconds{50}, "drive left: is being parameterised", false).empty() ? 0 : 1;
  }
  EXPECT_LE(said, 10u);
  EXPECT_GE(said, 9u);
  EXPECT_EQ("cannot be opened.", during(milliseconds{2000}, "cannot be opened", false));
}

}  // namespace
}  // namespace nord_driver::node

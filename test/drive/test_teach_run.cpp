// The bits that teach a position: their order, and how long each stands.
#include <gtest/gtest.h>

#include "drive/teach_run.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds{10};

class TeachRunTest : public ::testing::Test {
 protected:
  TeachRunTest() { run_.start(now_, std::chrono::milliseconds{100}, seconds(2.0)); }
  /// Answered cycles until the bits change or it ends.
  int cyclesUntilNext() {
    const TeachBits before = run_.bits();
    for (int i = 1; i < 100; ++i) {
      now_ += kCycle;
      if (run_.handleAnswer(now_)) return i;
      if (run_.bits().teach_in != before.teach_in || run_.bits().quit != before.quit) return i;
    }
    return 100;
  }
  void expectBits(bool teach_in, bool quit) {
    EXPECT_EQ(teach_in, run_.bits().teach_in);
    EXPECT_EQ(quit, run_.bits().quit);
  }

  TeachRun run_;
  Instant now_{};
};

TEST_F(TeachRunTest, RaisesQuitInsideTeachInAndEndsWithAllLow) {
  expectBits(true, false);
  EXPECT_EQ(11, cyclesUntilNext()) << "100 ms from the first answer";
  expectBits(true, true);
  EXPECT_EQ(11, cyclesUntilNext());
  expectBits(true, false);
  EXPECT_EQ(11, cyclesUntilNext());
  expectBits(false, false);
  EXPECT_TRUE(run_.isRunning()) << "low for as long as it was high";
  EXPECT_EQ(11, cyclesUntilNext());
  EXPECT_FALSE(run_.isRunning());
}

TEST_F(TeachRunTest, DoesNotCountWhatIsNotAnswered) {
  now_ += seconds(1.0);
  EXPECT_FALSE(run_.handleAnswer(now_)) << "the first answer of this stage";
  expectBits(true, false);
  EXPECT_FALSE(run_.isOverdue(now_));
  EXPECT_TRUE(run_.isOverdue(now_ + seconds(1.0)));
  run_.end();
  expectBits(false, false);
  EXPECT_FALSE(run_.isOverdue(now_ + seconds(1.0)));
}

}  // namespace
}  // namespace nord_driver::drive

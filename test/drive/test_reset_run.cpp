// The bit that sets a count anew: how long it stands, and what ends the run.
#include <gtest/gtest.h>

#include "drive/reset_run.h"

namespace nord_driver::drive {
namespace {

constexpr Duration kCycle = std::chrono::milliseconds{10};

class ResetRunTest : public ::testing::Test {
 protected:
  ResetRunTest() { run_.start(now_, std::chrono::milliseconds{100}, seconds(2.0)); }
  bool answer(bool is_new) {
    now_ += kCycle;
    return run_.handleAnswer(is_new, now_);
  }

  ResetRun run_;
  Instant now_{};
};

TEST_F(ResetRunTest, HoldsTheBitAndThenLeavesItLowForAsLong) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(run_.bit());
    EXPECT_FALSE(answer(true));
  }
  EXPECT_FALSE(answer(true)) << "100 ms from the first answer";
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(run_.bit());
    EXPECT_FALSE(answer(true));
    EXPECT_TRUE(run_.isRunning());
  }
  EXPECT_TRUE(answer(true));
  EXPECT_FALSE(run_.isRunning());
  EXPECT_FALSE(answer(true)) << "it ended once";
}

TEST_F(ResetRunTest, WaitsForTheNewPosition) {
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(answer(false));
  EXPECT_TRUE(run_.isRunning());
  EXPECT_FALSE(run_.isOverdue(Instant{} + seconds(1.99)));
  EXPECT_TRUE(run_.isOverdue(Instant{} + seconds(2.0)));
  EXPECT_TRUE(answer(true));
  EXPECT_FALSE(run_.isOverdue(Instant{} + seconds(3.0)));
}

TEST_F(ResetRunTest, DoesNotCountWhatIsNotAnswered) {
  now_ += seconds(1.0);
  EXPECT_FALSE(answer(true)) << "the first answer of this stage";
  EXPECT_TRUE(run_.bit());
  run_.end();
  EXPECT_FALSE(run_.bit());
}

}  // namespace
}  // namespace nord_driver::drive

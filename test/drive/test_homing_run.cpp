// A reference run: when it has begun, and what counts as its end.
#include <gtest/gtest.h>

#include "drive/homing_run.h"

namespace nord_driver::drive {
namespace {

using Outcome = HomingRun::Outcome;

constexpr Duration kCycle = std::chrono::milliseconds{10};
constexpr HomingView kHeld{true, true, false, std::nullopt};  // bit 8 high, and still
constexpr HomingView kMoves{false, false, false, std::nullopt};
constexpr HomingView kSearches{false, true, false, std::nullopt};  // still, and bit 8 low

class HomingRunTest : public ::testing::Test {
 protected:
  void start() { run_.start(now_, seconds(1.0)); }
  Outcome see(const HomingView& view) {
    now_ += kCycle;
    return run_.handleView(view, now_);
  }
  /// How many cycles it shows this until the run ends, 0: it does not.
  int cyclesUntilDone(const HomingView& view) {
    for (int i = 1; i <= 90; ++i) {
      const Outcome outcome = see(view);
      if (outcome != Outcome::kGoesOn) return outcome == Outcome::kDone ? i : 0;
    }
    return 0;
  }

  HomingRun run_;
  Instant now_{};
};

// 200 ms from the first telegram in which all is quiet: 21 of them.
TEST_F(HomingRunTest, IsOverWhenItHasTurnedAndStoodStillForATime) {
  start();
  EXPECT_EQ(Outcome::kGoesOn, see(kMoves));
  EXPECT_TRUE(run_.isRunning());
  EXPECT_EQ(21, cyclesUntilDone(kHeld));
  EXPECT_FALSE(run_.isRunning());
}

// A speed told over more than 200 ms: a shaft that turned to and fro in this time would look still.
TEST_F(HomingRunTest, StandsStillForAsLongAsItsSpeedIsToldOver) {
  run_.start(now_, seconds(1.0), std::chrono::milliseconds{400});
  see(kMoves);
  EXPECT_EQ(41, cyclesUntilDone(kHeld));
  run_.start(now_, seconds(1.0), std::chrono::milliseconds{40});
  see(kMoves);
  EXPECT_EQ(21, cyclesUntilDone(kHeld));
}

TEST_F(HomingRunTest, BeginsWithABit8ThatFallsAlsoWhereNothingTurned) {
  start();
  see(kHeld);
  see(kSearches);
  EXPECT_EQ(21, cyclesUntilDone(kHeld));
}

TEST_F(HomingRunTest, HasNotBegunBeforeAnythingHappened) {
  start();
  see(kSearches);  // low from before: it has not been seen where it was held
  EXPECT_EQ(0, cyclesUntilDone(kHeld));
}

// What was seen in an earlier run begins no later one.
TEST_F(HomingRunTest, BeginsAnewEachTime) {
  start();
  see(kMoves);
  see(kHeld);
  run_.end();
  start();
  see(kSearches);
  EXPECT_EQ(0, cyclesUntilDone(kHeld)) << "neither turned nor fallen";
}

// Each of the four keeps it from being over, and has the time begin anew.
TEST_F(HomingRunTest, TheQuietIsInOnePiece) {
  const HomingView turns{true, false, false, std::nullopt}, on_its_way{false, true, false, std::nullopt};
  const HomingView doubtful{true, true, true, std::nullopt}, unreferenced{true, true, false, false};
  for (const HomingView& disturbance : {turns, on_its_way, doubtful, unreferenced}) {
    start();
    see(kMoves);
    for (int i = 0; i < 20; ++i) ASSERT_EQ(Outcome::kGoesOn, see(kHeld));
    ASSERT_EQ(Outcome::kGoesOn, see(disturbance));
    EXPECT_EQ(21, cyclesUntilDone(kHeld));
  }
}

TEST_F(HomingRunTest, WaitsForTheBitThatSaysReferencedWhereThereIsOne) {
  start();
  see(kMoves);
  for (int i = 0; i < 40; ++i) ASSERT_EQ(Outcome::kGoesOn, see({true, true, false, false}));
  EXPECT_EQ(21, cyclesUntilDone({true, true, false, true}));
}

TEST_F(HomingRunTest, EndsAtItsTimeOutAndNotBefore) {
  start();
  for (int i = 1; i < 100; ++i) ASSERT_EQ(Outcome::kGoesOn, see(kMoves)) << i;
  EXPECT_EQ(Outcome::kTimedOut, see(kMoves));
  EXPECT_FALSE(run_.isRunning());
}

TEST_F(HomingRunTest, SaysNothingWhileNoneRuns) {
  EXPECT_FALSE(run_.isRunning());
  EXPECT_EQ(Outcome::kGoesOn, see(kHeld)) << "none was ever begun, and so none is late";
  start();
  see(kMoves);
  run_.end();
  for (int i = 0; i < 150; ++i) ASSERT_EQ(Outcome::kGoesOn, see(kHeld));
}

}  // namespace
}  // namespace nord_driver::drive

// Stops asked for while a drive is not heard: it may hear us, so their words are sent all the same, for a bounded time.
#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

class StopsWhileSilent : public DriveTest {
 protected:
  /// For how long `word` is sent, from now on, before 0000.
  Duration sentFor(Word word) {
    const Instant begin = now_;
    while (now_ - begin < seconds(2.0)) {
      const Word sent = silence();
      if (sent == 0x0000) break;
      EXPECT_EQ(word, sent);
    }
    return now_ - begin - kCycle;
  }
};

TEST_F(StopsWhileSilent, QuickStop) {
  run();
  fallSilent();
  drive_.requestQuickStop(now_);
  const Duration sent = sentFor(0x047B);
  EXPECT_GE(sent, seconds(1.0));
  EXPECT_LE(sent, seconds(1.05));
}

TEST_F(StopsWhileSilent, Coasting) {
  run();
  fallSilent();
  drive_.requestCoast(now_);
  const Duration sent = sentFor(0x047D);
  EXPECT_GE(sent, seconds(1.0));
  EXPECT_LE(sent, seconds(1.05));
}

// It answers again and turns: the stop that was asked for is the one it gets, not the ramp of an ordinary one.
TEST_F(StopsWhileSilent, TheQuickStopIsCarriedOutWhenItAnswersAgain) {
  run();
  fallSilent();
  drive_.requestQuickStop(now_);
  ASSERT_EQ(0x047B, silence());
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(Phase::kQuickStopping, report().phase);
  EXPECT_EQ(Refusal::kStopping, drive_.enableRefusal());
  EXPECT_EQ(0x047B, cycle(0x0B17, 0x1000)) << "quick stop active";
  cycle(0x0B70);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
}

TEST_F(StopsWhileSilent, CoastingIsCarriedOutWhenItAnswersAgain) {
  run();
  fallSilent();
  drive_.requestCoast(now_);
  ASSERT_EQ(0x047D, silence());
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(Phase::kCoasting, report().phase);
  EXPECT_EQ(0x047D, cycle(0x0B37, 0x2000));
}

// Begun before the line broke, and perhaps never heard.
TEST_F(StopsWhileSilent, AQuickStopThatWasBegunGoesOn) {
  run();
  drive_.requestQuickStop(now_);
  fallSilent();
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(Phase::kQuickStopping, report().phase);
  EXPECT_EQ(0x047B, cycle(0x0B37, 0x1000));
}

TEST_F(StopsWhileSilent, WhoHasComeToRestIsIdle) {
  run();
  fallSilent();
  drive_.requestQuickStop(now_);
  silence();
  cycle(0x0B31);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0B31));
}

// An ordinary stop is what "idle" commands.
TEST_F(StopsWhileSilent, WhoWasOnlyLostRampsDown) {
  run();
  fallSilent();
  ASSERT_EQ(0x047E, silence());
  EXPECT_TRUE(drive_.stopsUnheard(now_));
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x2000));
  EXPECT_FALSE(drive_.stopsUnheard(now_));
}

// Also where that is shorter than a cycle.
TEST_F(StopsWhileSilent, OnceAtLeastHoweverShortShutdownTimeoutIs) {
  DriveConfig short_time = config();
  short_time.shutdown_timeout = kCycle / 2;
  drive_ = Drive{short_time};
  run();
  fallSilent();
  now_ += kCycle;
  EXPECT_EQ(0x047E, silence());
  EXPECT_EQ(0x0000, silence());
  drive_.requestQuickStop(now_);
  now_ += kCycle;
  EXPECT_EQ(0x047B, silence());
  EXPECT_EQ(0x0000, silence());
  drive_.requestCoast(now_);
  now_ += kCycle;
  EXPECT_EQ(0x047D, silence());
  EXPECT_EQ(0x0000, silence());
}

TEST_F(StopsWhileSilent, AStopAskedForLongAgoIsForgotten) {
  run();
  fallSilent();
  drive_.requestQuickStop(now_);
  now_ += seconds(2.0);
  EXPECT_FALSE(drive_.stopsUnheard(now_));
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(0x047E, cycle(0x0B37, 0x2000));
}

}  // namespace
}  // namespace nord_driver::drive

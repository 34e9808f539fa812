#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using Moment = SleepRecord::Moment;
using Span = SleepRecord::Span;

Moment at(int ms) {
  return Moment{} + milliseconds{ms};
}

TEST(SleepRecord, IsAsLateAsItsLatestWakeUp) {
  SleepRecord record{milliseconds{5}, at(0)};
  for (const int ms : {5, 10, 436, 441, 460}) record.woke(at(ms));
  EXPECT_NEAR(0.421, record.longestUntil(at(461)).count(), 1e-9) << "from 10 to 436, of which 5 are its own sleep";
}

TEST(SleepRecord, ASleeperInTimeIsNotLate) {
  SleepRecord record{milliseconds{5}, at(0)};
  for (int ms = 5; ms < 500; ms += 5) record.woke(at(ms));
  EXPECT_NEAR(0.0, record.longestUntil(at(500)).count(), 1e-9);
}

// Who asks is run again before the sleeper is.
TEST(SleepRecord, IsLateJustNow) {
  SleepRecord record{milliseconds{5}, at(0)};
  record.woke(at(5));
  EXPECT_NEAR(0.3, record.longestUntil(at(310)).count(), 1e-9);
}

TEST(RunDelay, IsReadAsTheKernelWritesIt) {
  const auto delay = RunDelay::from("118096 1630466 2\n");
  ASSERT_TRUE(delay);
  EXPECT_EQ(1'630'466u, delay->waited);
  EXPECT_EQ(2u, delay->turns);
  for (const char* text : {"", "118096", "118096 1630466", "not known"}) EXPECT_FALSE(RunDelay::from(text)) << text;
}

RunDelay waited(int ms, std::uint64_t turns) {
  return {static_cast<std::uint64_t>(ms) * 1'000'000, turns};
}

TEST(RunDelay, OneWaitIsKnownExactly) {
  EXPECT_NEAR(0.4, longestWait(waited(100, 7), waited(500, 8), milliseconds{10}).count(), 1e-9);
}

// 100 waits and 420 ms in a window of 10 ms: one began at least 410 ms before it.
TEST(RunDelay, OfManyWaitsOneIsLongerThanTheWindow) {
  EXPECT_NEAR(0.41, longestWait(waited(100, 7), waited(520, 107), milliseconds{10}).count(), 1e-9);
}

// What adds up to 420 ms within a second is not one wait of 420 ms.
TEST(RunDelay, ManyShortWaitsAreNoLongOne) {
  EXPECT_NEAR(0.0042, longestWait(waited(100, 7), waited(520, 107), milliseconds{1000}).count(), 1e-9);
}

TEST(RunDelay, NoWaitIsNone) {
  EXPECT_EQ(0.0, longestWait(waited(100, 7), waited(100, 12), milliseconds{10}).count());
  EXPECT_EQ(0.0, longestWait(waited(100, 7), waited(100, 7), milliseconds{10}).count());
}

/// Tries with a watch that has measured what it is given, and an end that is good from a try on.
struct Recorded {
  std::vector<double> hold_ups;  ///< s, of each try
  int good_from;
  int tries = 0, prepared = 0;
  std::vector<double> told{};

  void operator()(double excuse) {
    struct Watch {
      HoldUp seen;
      HoldUp longest() const { return seen; }
    };
    tryAgain(
        Span{excuse},
        [&] {
          return std::make_unique<Watch>(Watch{{Span{hold_ups.at(static_cast<std::size_t>(tries))}, ""}});
        },
        [&] { ++tries; }, [&] { return tries >= good_from; }, [&] { ++prepared; },
        [&](const HoldUp& seen) { told.push_back(seen.length.count()); });
  }
};
constexpr int kNever = 100;

TEST(SecondTry, IsNotMadeWhenTheFirstIsGood) {
  Recorded run{{5.0}, 1};
  run(0.1);
  EXPECT_EQ(1, run.tries);
  EXPECT_EQ(0, run.prepared);
  EXPECT_THAT(run.told, ElementsAre());
}

TEST(SecondTry, IsNotMadeWhereNothingStoodStill) {
  Recorded run{{0.0, 0.0, 0.0}, kNever};
  run(0.0);
  EXPECT_EQ(1, run.tries) << "the first result stands";
  EXPECT_THAT(run.told, ElementsAre());
}

TEST(SecondTry, IsNotMadeForAShorterHoldUpThanCouldBeTheReason) {
  Recorded run{{0.1, 5.0, 5.0}, kNever};
  run(0.1);
  EXPECT_EQ(1, run.tries);
}

TEST(SecondTry, IsMadeAndToldAfterAHoldUp) {
  Recorded run{{0.42, 0.0}, 2};
  run(0.1);
  EXPECT_EQ(2, run.tries);
  EXPECT_EQ(1, run.prepared);
  EXPECT_THAT(run.told, ElementsAre(0.42));
}

// The hold-up of one try excuses no other.
TEST(SecondTry, IsNotMadeForTheHoldUpOfTheTryBefore) {
  Recorded run{{0.42, 0.0, 0.0}, kNever};
  run(0.1);
  EXPECT_EQ(2, run.tries);
  EXPECT_THAT(run.told, ElementsAre(0.42));
}

TEST(SecondTry, EndsAfterTheThird) {
  Recorded run{{0.42, 0.43, 0.44}, kNever};
  run(0.1);
  EXPECT_EQ(3, run.tries);
  EXPECT_EQ(2, run.prepared);
  EXPECT_THAT(run.told, ElementsAre(0.42, 0.43));
}

}  // namespace
}  // namespace nord_driver::test

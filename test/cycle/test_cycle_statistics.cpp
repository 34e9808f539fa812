#include <gtest/gtest.h>

#include "cycle/cycle_statistics.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;

TEST(CycleStatistics, IsZeroBeforeTheFirstSecondHasPassed) {
  CycleStatistics statistics;
  Instant now{};
  for (int i = 0; i < 50; ++i) statistics.handleCycleStart(now += milliseconds{10});
  EXPECT_EQ(0.0, statistics.times().max);
  EXPECT_EQ(50u, statistics.cycles());
}

TEST(CycleStatistics, SumsUpTheLastSecond) {
  CycleStatistics statistics;
  Instant now{};
  statistics.handleCycleStart(now);
  for (int i = 0; i < 98; ++i) statistics.handleCycleStart(now += milliseconds{10});
  statistics.handleCycleStart(now += milliseconds{5});
  statistics.handleCycleStart(now += milliseconds{40});
  EXPECT_NEAR(0.005, statistics.times().min, 1e-9);
  EXPECT_NEAR((0.98 + 0.045) / 100, statistics.times().mean, 1e-9);
  EXPECT_NEAR(0.010, statistics.times().p99, 1e-6);  // 99 of 100 samples are not longer than 10 ms
  EXPECT_NEAR(0.040, statistics.times().max, 1e-9);
}

TEST(CycleStatistics, ForgetsTheSecondBefore) {
  CycleStatistics statistics;
  Instant now{};
  statistics.handleCycleStart(now);
  statistics.handleCycleStart(now += milliseconds{1500});
  EXPECT_NEAR(1.5, statistics.times().max, 1e-9);
  for (int i = 0; i < 100; ++i) statistics.handleCycleStart(now += milliseconds{10});
  EXPECT_NEAR(0.010, statistics.times().max, 1e-9);
  EXPECT_NEAR(0.010, statistics.times().mean, 1e-9);
}

TEST(CycleStatistics, MoreSamplesThanRoomAreSurvived) {
  CycleStatistics statistics;
  Instant now{};
  for (int i = 0; i < 5000; ++i) statistics.handleCycleStart(now += std::chrono::microseconds{250});
  EXPECT_NEAR(0.00025, statistics.times().mean, 1e-9);
  EXPECT_NEAR(0.00025, statistics.times().p99, 1e-6);
}

// A steady clock begins anywhere.
TEST(CycleStatistics, TheFirstSecondBeginsWithTheFirstCycle) {
  CycleStatistics statistics;
  Instant now{std::chrono::hours{1}};
  for (int i = 0; i < 50; ++i) statistics.handleCycleStart(now += milliseconds{10});
  EXPECT_EQ(0.0, statistics.times().max);
}

TEST(CycleStatistics, EachSecondIsTakenForItself) {
  CycleStatistics statistics;
  Instant now{};
  statistics.handleCycleStart(now);
  for (int i = 0; i < 50; ++i) statistics.handleCycleStart(now += milliseconds{20});
  EXPECT_NEAR(0.020, statistics.times().p99, 1e-6);
  for (int i = 0; i < 99; ++i) {
    statistics.handleCycleStart(now += milliseconds{10});
    EXPECT_NEAR(0.020, statistics.times().mean, 1e-9) << "of the second before, until this one is over";
  }
  statistics.handleCycleStart(now += milliseconds{10});
  EXPECT_NEAR(0.010, statistics.times().mean, 1e-9);
  EXPECT_NEAR(0.010, statistics.times().p99, 1e-6);
}

// Wherever the shortest and the longest cycle of a second are.
TEST(CycleStatistics, FindsTheShortestAndTheLongestCycle) {
  CycleStatistics statistics;
  Instant now{};
  statistics.handleCycleStart(now);
  statistics.handleCycleStart(now += milliseconds{5});
  statistics.handleCycleStart(now += milliseconds{300});
  statistics.handleCycleStart(now += milliseconds{695});
  EXPECT_NEAR(0.005, statistics.times().min, 1e-9);
  statistics.handleCycleStart(now += milliseconds{10});
  statistics.handleCycleStart(now += milliseconds{900});
  statistics.handleCycleStart(now += milliseconds{90});
  EXPECT_NEAR(0.010, statistics.times().min, 1e-9);
  EXPECT_NEAR(0.900, statistics.times().max, 1e-9);
}

// Of 100 cycles, each of another length, one may be longer.
TEST(CycleStatistics, ThePercentileIsTheSecondLongestOfAHundred) {
  CycleStatistics statistics;
  Instant now{};
  statistics.handleCycleStart(now);
  for (int i = 0; i < 100; ++i) {
    const int half = i < 50 ? 0 : 10'000;  // us: neither in order nor in reverse order
    statistics.handleCycleStart(now += std::chrono::microseconds{10'050 + half - 100 * i});
  }
  EXPECT_NEAR(0.01505, statistics.times().max, 1e-6);
  EXPECT_NEAR(0.01495, statistics.times().p99, 1e-6);
}

}  // namespace
}  // namespace nord_driver::cycle

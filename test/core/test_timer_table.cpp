#include <gtest/gtest.h>

#include "core/timer_table.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

enum class Timer { kAnswer, kPause, kCount };

TEST(TimerTable, NothingIsSetAtFirst) {
  const TimerTable<Timer> timers;
  EXPECT_FALSE(timers.isSet(Timer::kAnswer));
  EXPECT_FALSE(timers.isRunning(Timer::kAnswer, Instant{}));
  EXPECT_FALSE(timers.isOver(Timer::kAnswer, Instant{}));
  EXPECT_EQ(std::nullopt, timers.nextTimeout());
}

TEST(TimerTable, ATimerIsOverFromItsMomentOn) {
  TimerTable<Timer> timers;
  const Instant due = Instant{} + milliseconds{5};
  timers.set(Timer::kPause, due);
  EXPECT_TRUE(timers.isRunning(Timer::kPause, due - milliseconds{1}));
  EXPECT_FALSE(timers.isOver(Timer::kPause, due - milliseconds{1}));
  EXPECT_FALSE(timers.isRunning(Timer::kPause, due));
  EXPECT_TRUE(timers.isOver(Timer::kPause, due));
  EXPECT_FALSE(timers.isSet(Timer::kAnswer));
  timers.stop(Timer::kPause);
  EXPECT_FALSE(timers.isOver(Timer::kPause, due));
}

TEST(TimerTable, WhatIsDueIsTakenOnce) {
  TimerTable<Timer> timers;
  const Instant due = Instant{} + milliseconds{5};
  EXPECT_FALSE(timers.takeDue(Timer::kPause, due));
  timers.set(Timer::kPause, due);
  EXPECT_FALSE(timers.takeDue(Timer::kPause, due - milliseconds{1}));
  EXPECT_TRUE(timers.takeDue(Timer::kPause, due));
  EXPECT_FALSE(timers.takeDue(Timer::kPause, due));
  EXPECT_FALSE(timers.isSet(Timer::kPause));
}

TEST(TimerTable, TheEarliestIsNext) {
  TimerTable<Timer> timers;
  const Instant now{milliseconds{100}};
  timers.set(Timer::kAnswer, now + milliseconds{5});
  EXPECT_EQ(now + milliseconds{5}, timers.nextTimeout());
  timers.set(Timer::kPause, now + milliseconds{3});
  EXPECT_EQ(now + milliseconds{3}, timers.nextTimeout());
  timers.set(Timer::kPause, now + milliseconds{9});
  EXPECT_EQ(now + milliseconds{5}, timers.nextTimeout());
  timers.stopAll();
  EXPECT_EQ(std::nullopt, timers.nextTimeout());
}

TEST(TimerTable, ProlongsOnly) {
  TimerTable<Timer> timers;
  const Instant now{milliseconds{100}};
  timers.prolong(Timer::kAnswer, now);
  EXPECT_EQ(now, timers.at(Timer::kAnswer));
  timers.prolong(Timer::kAnswer, now - milliseconds{1});
  EXPECT_EQ(now, timers.at(Timer::kAnswer));
  timers.prolong(Timer::kAnswer, now + milliseconds{1});
  EXPECT_EQ(now + milliseconds{1}, timers.at(Timer::kAnswer));
}

TEST(Earlier, EitherMayBeMissing) {
  const Instant first{milliseconds{1}}, second{milliseconds{2}};
  EXPECT_EQ(first, earlier(first, second));
  EXPECT_EQ(first, earlier(second, first));
  EXPECT_EQ(first, earlier(first, std::nullopt));
  EXPECT_EQ(first, earlier(std::nullopt, first));
  EXPECT_EQ(std::nullopt, earlier(std::nullopt, std::nullopt));
}

}  // namespace
}  // namespace nord_driver

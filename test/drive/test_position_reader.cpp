// A count without jumps, whatever the words do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "drive/position_reader.h"

namespace nord_driver::drive {
namespace {

using profile::PositionField;
using profile::ProcessValues;

constexpr PositionField kWide{32, 1, 2, 1000};
constexpr PositionField kNarrow{16, 1, 1, 1000};
constexpr double kMaxSpeed = 25'000.0;  // steps/s: 50 Hz, two pole pairs
constexpr Duration kCycle = std::chrono::milliseconds{10};

ProcessValues wordsOf(std::int64_t steps) {
  ProcessValues words{};
  profile::putPosition(kWide, static_cast<std::int32_t>(steps), words);
  return words;
}

class Reading {
 public:
  explicit Reading(const PositionField& field, double max_speed = kMaxSpeed) : field_(field), max_speed_(max_speed) {}
  void see(const ProcessValues& words) {
    now_ += kCycle;
    reader.handleValues(field_, words, max_speed_, now_);
  }
  void see(std::int64_t steps) { see(wordsOf(steps)); }
  void settle(std::int64_t steps) {
    for (int i = 0; i < 4; ++i) see(steps);
  }

  PositionReader reader;

 private:
  PositionField field_;
  double max_speed_;
  Instant now_{};
};

TEST(PositionReader, BelievesAFirstValueWhenThoseAfterItAgree) {
  Reading reading{kWide};
  reading.see(100);
  EXPECT_FALSE(reading.reader.isKnown());
  reading.see(65'636);  // the first was torn, or this one is
  reading.see(65'640);
  EXPECT_FALSE(reading.reader.isKnown());
  reading.see(65'644);
  ASSERT_TRUE(reading.reader.isKnown());
  EXPECT_EQ(65'644, reading.reader.steps());
  EXPECT_FALSE(reading.reader.hasJumped()) << "nothing was known before";
}

// Half as much again as the motor can do, for the cycle and 50 ms that telegrams may lag behind, and 20 steps: 2270.
TEST(PositionReader, BelievesWhatTheMotorCanHaveDone) {
  Reading reading{kWide};
  reading.settle(0);
  reading.see(2270);
  EXPECT_EQ(2270, reading.reader.steps());
  reading.see(2270 + 2271);
  EXPECT_EQ(2270, reading.reader.steps());
  EXPECT_TRUE(reading.reader.isHeldBack());
}

// -1, 0, +1 and both borders of 16 bits, step by step and back.
TEST(PositionReader, WalksOverTheBordersWithoutAJump) {
  for (const PositionField& field : {kWide, kNarrow}) {
    Reading reading{field};
    reading.settle(-3);
    std::int64_t before = reading.reader.steps();
    EXPECT_EQ(-3, before);
    const auto walk = [&](std::int64_t to, std::int64_t stride) {
      for (std::int64_t at = before; at != to; at += std::clamp<std::int64_t>(to - at, -stride, stride)) {
        reading.see(at);
        ASSERT_TRUE(reading.reader.isKnown());
        ASSERT_FALSE(reading.reader.hasJumped());
        ASSERT_LE(std::abs(reading.reader.steps() - before), stride) << at;
        ASSERT_EQ(at, reading.reader.steps());
        before = at;
      }
      before = to;
      reading.see(to);
    };
    walk(3, 1);
    walk(-3, 1);
    walk(32'760, 200);
    walk(32'775, 1);
    walk(32'760, 1);
    walk(65'530, 200);
    walk(65'540, 1);
    walk(-65'540, 199);
  }
}

// The low word passes its border; the gateway has one half from before and one from after.
TEST(PositionReader, HoldsTornHalvesBack) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random{seed};
    Reading reading{kWide};
    const std::int64_t border = static_cast<std::int64_t>(random() % 4) * 65'536 - 65'536;
    std::int64_t at = border;
    reading.settle(at);
    int torn = 0;
    for (int i = 0; i < 20'000; ++i) {
      const std::int64_t before = reading.reader.steps();
      const std::int64_t last = at;
      at = std::clamp<std::int64_t>(at + static_cast<std::int64_t>(random() % 501) - 250, border - 600, border + 600);
      // Now and then one half is of the cycle before.
      ProcessValues words = wordsOf(at);
      if (random() % 3 == 0) {
        const std::size_t half = 1 + random() % 2;
        words[half] = wordsOf(last)[half];
      }
      const bool is_torn = profile::getPosition(kWide, words) != at && profile::getPosition(kWide, words) != last;
      torn += is_torn ? 1 : 0;
      reading.see(words);
      ASSERT_LE(std::abs(reading.reader.steps() - before), 20'000) << "seed " << seed << ", " << i;
      ASSERT_FALSE(reading.reader.hasJumped()) << "seed " << seed << ", " << i;
    }
    EXPECT_GT(torn, 100) << "seed " << seed;
  }
}

TEST(PositionReader, BelievesANewZeroAfterATime) {
  Reading reading{kWide};
  reading.settle(1'000'000);
  int cycles = 0;
  do {
    reading.see(5);
    ++cycles;
  } while (reading.reader.steps() != 5 && cycles < 100);
  EXPECT_TRUE(reading.reader.hasJumped());
  EXPECT_GE(cycles, 10) << "100 ms";
  EXPECT_LE(cycles, 12);
  reading.see(6);
  EXPECT_FALSE(reading.reader.hasJumped());
  EXPECT_EQ(6, reading.reader.steps());
}

// 8192 increments, 25 revolutions a second: after 0.2 s without a telegram it is 40 960 steps further, by its own motion.
// A new zero a few revolutions away: the time it was held back for is none in which the motor went there.
TEST(PositionReader, ANewZeroNearbyIsOneAllTheSame) {
  for (const std::int64_t jump : {2271, 5000, 6030, 7000, -5000}) {
    Reading reading{kWide};
    reading.settle(90'000);
    int jumps = 0;
    for (int i = 0; i < 20; ++i) {
      reading.see(90'000 + jump);
      if (!reading.reader.hasJumped()) continue;
      ++jumps;
      EXPECT_EQ(10, i) << "a tenth of a second after it was seen first";
    }
    EXPECT_EQ(1, jumps) << jump;
    EXPECT_EQ(90'000 + jump, reading.reader.steps());
  }
}

// Torn in one cycle, and of the true motion again after it.
TEST(PositionReader, AfterATornValueTheMotionGoesOn) {
  Reading reading{kWide};
  std::int64_t at = 65'000;
  reading.settle(at);
  for (int i = 0; i < 30; ++i) {
    at += 250;
    reading.see(i % 2 == 0 ? at - 65'536 : at);
    EXPECT_FALSE(reading.reader.hasJumped()) << i;
  }
  EXPECT_EQ(at, reading.reader.steps());
}

TEST(PositionReader, AHoldUpAtSpeedIsNoNewZero) {
  constexpr double kFast = 8192.0 * 25.0;
  PositionReader reader;
  Instant now{};
  std::int64_t at = 0;
  const auto see = [&](Duration after) {
    now += after;
    at += static_cast<std::int64_t>(kFast * toSeconds(after));
    reader.handleValues(kWide, wordsOf(at), kFast, now);
  };
  for (int i = 0; i < 50; ++i) see(kCycle);
  ASSERT_EQ(at, reader.steps());
  see(std::chrono::milliseconds{200});
  for (int i = 0; i < 20; ++i) {
    see(kCycle);
    EXPECT_FALSE(reader.hasJumped()) << i;
  }
  EXPECT_TRUE(reader.isKnown());
  EXPECT_EQ(at, reader.steps());
  // Held up where it stands, it is where it was.
  now += std::chrono::milliseconds{300};
  reader.handleValues(kWide, wordsOf(at), kFast, now);
  EXPECT_TRUE(reader.isKnown());
  // A new zero in the middle of it all is one still: 100 ms of agreeing values, each of them soon after the last.
  at -= 10'000'000;
  bool jumped = false;
  for (int i = 0; i < 15; ++i) {
    see(kCycle);
    jumped = jumped || reader.hasJumped();
  }
  EXPECT_TRUE(jumped);
}

TEST(PositionReader, Continues16BitsAfterAGap) {
  Reading reading{kNarrow};
  reading.settle(32'760);
  reading.see(32'770);
  EXPECT_EQ(32'770, reading.reader.steps());
  reading.reader.handleGap();
  EXPECT_FALSE(reading.reader.isKnown());
  EXPECT_EQ(32'770, reading.reader.steps()) << "the last one known";
  reading.settle(32'780);
  EXPECT_EQ(32'780, reading.reader.steps());
}

// 16 bits that do not go on from the last value are a new count, and no other turn of the old one: 65.536 revolutions.
TEST(PositionReader, ANewZeroOf16BitsIsWhatItsWordIs) {
  Reading reading{kNarrow};
  reading.settle(32'000);
  for (std::int64_t steps = 32'200; steps <= 40'000; steps += 200) reading.see(steps);
  ASSERT_EQ(40'000, reading.reader.steps());
  for (int i = 0; i < 12; ++i) reading.see(0);
  EXPECT_EQ(0, reading.reader.steps());
  EXPECT_TRUE(reading.reader.isKnown());
}

// The same where the new count happens to go on.
TEST(PositionReader, AfterAReferenceRun16BitsAreWhatTheirWordIs) {
  Reading reading{kNarrow};
  reading.settle(32'700);
  for (std::int64_t steps = 32'900; steps <= 65'500; steps += 200) reading.see(steps);
  reading.see(65'536 + 20);
  ASSERT_EQ(65'556, reading.reader.steps());
  reading.reader.handleNewZero(kNarrow);
  EXPECT_EQ(20, reading.reader.steps());
  reading.see(21);
  EXPECT_EQ(21, reading.reader.steps());
  EXPECT_FALSE(reading.reader.hasJumped());
}

TEST(PositionReader, TellsASpeed) {
  Reading reading{kWide};
  reading.settle(0);
  for (int i = 1; i <= 20; ++i) reading.see(100 * i);
  EXPECT_NEAR(10'000.0, reading.reader.speed(), 1.0);
  for (int i = 0; i < 10; ++i) reading.see(2000);
  EXPECT_EQ(0.0, reading.reader.speed());
}

// One step in 40 ms is 25 steps a second: 5 % of 500.
TEST(PositionReader, AStepToAndFroIsNoMotionOfACoarseCount) {
  for (const double max_speed : {200.0, 500.0, 1999.0}) {
    for (const int period : {1, 3, 5, 30}) {
      Reading reading{kWide, max_speed};
      for (int i = 0; i < 300; ++i) {
        reading.see(7 + i / period % 2);
        ASSERT_LE(std::fabs(reading.reader.speed()), 0.01 * max_speed) << max_speed << ", " << period << ", " << i;
      }
    }
  }
}

// 20 steps a second of 500.
TEST(PositionReader, TellsACreepOfACoarseCount) {
  Reading reading{kWide, 500.0};
  for (int i = 0; i < 300; ++i) {
    reading.see(i / 5);
    if (i >= 40) {
      ASSERT_NEAR(20.0, reading.reader.speed(), 5.0) << i;
    }
  }
}

// The time of a whole window is not waited for where the count goes on by more than a step.
TEST(PositionReader, TellsAFastMotionOfACoarseCountAtOnce) {
  Reading reading{kWide, 500.0};
  for (int i = 0; i < 8; ++i) reading.see(5 * i);
  EXPECT_NEAR(500.0, reading.reader.speed(), 1.0);
}

// Above 2550 steps a second a step is less than 1 % in 40 ms.
TEST(PositionReader, TheSpeedOfAFineCountIsThatOf40Ms) {
  Reading reading{kWide, 2560.0};
  reading.settle(0);
  for (int i = 0; i < 60; ++i) reading.see(10 * i);
  EXPECT_NEAR(1000.0, reading.reader.speed(), 1.0);
  for (int i = 0; i < 8; ++i) reading.see(600);
  EXPECT_EQ(0.0, reading.reader.speed());
  EXPECT_EQ(PositionReader::kShortestWindow, reading.reader.speedWindow());
}

// What a count that begins anew has jumped by was no motion: until a window has passed there is no speed, not that of before.
TEST(PositionReader, ANewCountHasNoSpeedYet) {
  const auto moving = [] {
    Reading reading{kWide};
    reading.settle(0);
    for (int i = 1; i <= 20; ++i) reading.see(100 * i);
    EXPECT_NEAR(10'000.0, reading.reader.speed(), 1.0);
    return reading;
  };
  Reading jumped = moving();
  for (int i = 0; i < 20 && !jumped.reader.hasJumped(); ++i) jumped.see(1'000'000);
  ASSERT_EQ(1'000'000, jumped.reader.steps());
  EXPECT_EQ(0.0, jumped.reader.speed());
  Reading zeroed = moving();
  zeroed.reader.handleNewZero(kWide);
  EXPECT_EQ(0.0, zeroed.reader.speed());
  Reading unheard = moving();
  unheard.reader.handleGap();
  EXPECT_EQ(0.0, unheard.reader.speed());
  unheard.settle(2000);
  ASSERT_TRUE(unheard.reader.isKnown());
  EXPECT_EQ(0.0, unheard.reader.speed());
}

}  // namespace
}  // namespace nord_driver::drive

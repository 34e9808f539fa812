#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "profile/position_scale.h"

namespace nord_driver::profile {
namespace {

constexpr PositionField kWide{32, 1, 2, 1000};
constexpr PositionField kNarrow{16, 1, 1, 1000};

TEST(PositionScale, CountsThousandthsOfARevolution) {
  PositionScale scale;
  scale.revolutions_per_unit = 20.0 / (2.0 * 3.14159265358979323846);  // gear 20, rad
  EXPECT_EQ(20'000, toSteps(2.0 * 3.14159265358979323846, scale, kWide));
  EXPECT_NEAR(3.14159265358979323846, toJoint(10'000, scale, kWide), 1e-12);
  scale.revolutions_per_unit = -20.0 / 0.1;  // m, 0.1 m a turn, the other way round
  EXPECT_EQ(-100'000, toSteps(0.5, scale, kWide));
  scale.offset = 0.25;
  EXPECT_EQ(-50'000, toSteps(0.5, scale, kWide));
  EXPECT_DOUBLE_EQ(0.25, toJoint(0, scale, kWide));
  scale.steps_per_revolution = 8192.0;
  EXPECT_DOUBLE_EQ(0.25 - 1.0 / 200.0, toJoint(8192, scale, kWide));
}

// BU 0020 7.3.5: 32767 and -32768 of 16 bits, +-50 000.000 revolutions of 32.
TEST(PositionScale, KnowsWhatTheWordsCanHave) {
  const PositionScale scale;
  EXPECT_EQ(32'767, toSteps(32.767, scale, kNarrow));
  EXPECT_EQ(-32'768, toSteps(-32.768, scale, kNarrow));
  EXPECT_FALSE(toSteps(32.768, scale, kNarrow));
  EXPECT_FALSE(toSteps(-32.769, scale, kNarrow));
  EXPECT_EQ(50'000'000, toSteps(50'000.0, scale, kWide));
  EXPECT_EQ(-50'000'000, toSteps(-50'000.0, scale, kWide));
  EXPECT_FALSE(toSteps(50'000.001, scale, kWide));
  EXPECT_FALSE(toSteps(0.0, scale, PositionField{})) << "no words";
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    EXPECT_FALSE(toSteps(wrong, scale, kWide)) << wrong;
  }
}

TEST(PositionScale, TurnsEveryTargetIntoItsNearestStep) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> ratio{-300.0, 300.0}, share{-1.0, 1.0};
    for (int i = 0; i < 20'000; ++i) {
      PositionScale scale;
      scale.revolutions_per_unit = ratio(random);
      if (std::fabs(scale.revolutions_per_unit) < 0.01) continue;
      scale.offset = 10.0 * share(random);
      const double wanted = 49'999.0 * share(random) / scale.revolutions_per_unit + scale.offset;
      const auto steps = toSteps(wanted, scale, kWide);
      ASSERT_TRUE(steps) << "seed " << seed << ", " << i;
      const double revolutions = (toJoint(*steps, scale, kWide) - wanted) * scale.revolutions_per_unit;
      ASSERT_LE(std::fabs(revolutions), 0.000501) << "seed " << seed << ", " << i;
    }
  }
}

// Converted all the same, some processor might make a target of it that is in range.
TEST(PositionScale, WhatIsBeyondEveryNumberIsNotConverted) {
  const PositionScale scale;
  for (const double wrong :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    std::feclearexcept(FE_ALL_EXCEPT);
    const bool taken = toSteps(wrong, scale, kWide).has_value();
    const int invalid = std::fetestexcept(FE_INVALID);
    EXPECT_FALSE(taken) << wrong;
    EXPECT_EQ(0, invalid) << wrong;
  }
}

// Of an encoder with so many steps the words end before the revolutions do.
TEST(PositionScale, EndsWithTheWordsOfFineSteps) {
  PositionScale scale;
  scale.steps_per_revolution = 1e6;
  EXPECT_EQ(INT32_MAX, toSteps(2147.483647, scale, kWide));
  EXPECT_FALSE(toSteps(2147.483648, scale, kWide));
  EXPECT_EQ(INT32_MIN, toSteps(-2147.483648, scale, kWide));
  EXPECT_FALSE(toSteps(-2147.483649, scale, kWide));
}

}  // namespace
}  // namespace nord_driver::profile

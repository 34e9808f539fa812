#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "robot/generators.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::robot {
namespace {

// Speeds inside the limits are not touched.
TEST(WheelSpeeds, InsideTheLimitsNothingChanges) {
  EXPECT_EQ((WheelSpeeds{3.0, -10.0}), scaleInto({3.0, -10.0}, {10.0, 10.0}));
}

// One side too fast slows both by the same factor: cut alone, it would bend the path.
TEST(WheelSpeeds, BothSidesAreScaledByOneFactor) {
  const WheelSpeeds scaled = scaleInto({-20.0, 5.0}, {10.0, 10.0});
  EXPECT_DOUBLE_EQ(-10.0, scaled[0]);
  EXPECT_DOUBLE_EQ(2.5, scaled[1]);
}

// Each side has its own limit; the tighter one decides.
TEST(WheelSpeeds, TheTighterSideDecides) {
  const WheelSpeeds scaled = scaleInto({20.0, 20.0}, {10.0, 4.0});
  EXPECT_DOUBLE_EQ(4.0, scaled[0]);
  EXPECT_DOUBLE_EQ(4.0, scaled[1]);
}

// Without a usable limit or a finite speed nothing turns.
TEST(WheelSpeeds, NonsenseGivesZero) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, {0.0, 10.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({0.0, 1.0}, {0.0, 10.0})) << "nor where only the other one is to turn";
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, {10.0, -1.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, {10.0, kNan}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({kNan, 1.0}, {10.0, 10.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, kInfinity}, {10.0, 10.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, {10.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, {}));
}

// Infinity is a limit that never bites.
TEST(WheelSpeeds, InfinityIsNoLimit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ((WheelSpeeds{5.0, 1e6}), scaleInto({5.0, 1e6}, {kInfinity, kInfinity}));
}

// The drive's limit and the joint's: the tighter one, wheel by wheel; of different bases nothing moves.
TEST(WheelSpeeds, TheTighterLimitCounts) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((WheelSpeeds{3.0, 4.0}), tighterOf({3.0, 9.0}, {7.0, 4.0}));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, tighterOf({3.0, 9.0}, {7.0})));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, tighterOf({kNan, 9.0}, {7.0, 9.0})));
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), scaleInto({1.0, 1.0}, tighterOf({7.0, 9.0}, {kNan, 9.0})));
}

// What rounding makes of a wheel at its limit is no reason to slow the base; where nothing may move, nothing is inside.
TEST(WheelSpeeds, ARestOfRoundingIsInsideTheLimits) {
  EXPECT_TRUE(areWithin({10.0, -4.0}, {10.0, 4.0}));
  EXPECT_TRUE(areWithin({10.0 * (1.0 + 1e-10), -4.0}, {10.0, 4.0}));
  EXPECT_TRUE(areWithin({1.0, -1.0}, {1.0, 1.0 - 1e-9})) << "so much is a rest";
  EXPECT_FALSE(areWithin({10.0, -4.0 * (1.0 + 1e-8)}, {10.0, 4.0}));
  EXPECT_FALSE(areWithin({0.0, 0.0}, {0.0, 4.0}));
  EXPECT_FALSE(areWithin({1.0, 1.0}, {4.0}));
  EXPECT_FALSE(areWithin({std::numeric_limits<double>::quiet_NaN(), 1.0}, {4.0, 4.0}));
}

TEST(WheelSpeeds, StandsStillWhenEveryWheelDoes) {
  EXPECT_TRUE(standsStill({0.0, -0.0, 0.0}));
  EXPECT_FALSE(standsStill({0.0, 1e-9, 0.0}));
}

// For any number of wheels: inside every limit, all by one factor, and not slower than needed.
RC_GTEST_PROP(WheelSpeedsProperty, OneFactorForAll, ()) {
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, kMaxWheels + 1);
  WheelSpeeds wanted;
  WheelSpeeds max;
  for (std::size_t i = 0; i < count; ++i) {
    wanted.push_back(*number(-50.0, 50.0));
    max.push_back(*number(1.0, 50.0));
  }
  const WheelSpeeds scaled = scaleInto(wanted, max);
  RC_ASSERT(scaled.size() == count);
  bool one_at_its_limit = scaled == wanted;
  for (std::size_t i = 0; i < count; ++i) {
    RC_ASSERT(std::abs(scaled[i]) <= max[i] * (1.0 + 1e-12));
    RC_ASSERT(std::abs(scaled[i] * wanted[0] - scaled[0] * wanted[i]) < 1e-9);
    one_at_its_limit = one_at_its_limit || std::abs(std::abs(scaled[i]) - max[i]) < 1e-9;
  }
  RC_ASSERT(one_at_its_limit);
}

}  // namespace
}  // namespace nord_driver::robot

#include <gtest/gtest.h>

#include <limits>

#include "nord_driver/robot/wheel_speeds.h"

namespace nord_driver::robot {
namespace {

// Speeds inside the limits are not touched.
TEST(WheelSpeeds, InsideTheLimitsNothingChanges) {
  EXPECT_EQ((WheelSpeeds{3.0, -10.0}), scaleInto({3.0, -10.0}, {10.0, 10.0}));
}

// One side too fast slows both by the same factor: cut alone, it would bend the path.
TEST(WheelSpeeds, BothSidesAreScaledByOneFactor) {
  const WheelSpeeds scaled = scaleInto({-20.0, 5.0}, {10.0, 10.0});
  EXPECT_DOUBLE_EQ(-10.0, scaled.left);
  EXPECT_DOUBLE_EQ(2.5, scaled.right);
}

// Each side has its own limit; the tighter one decides.
TEST(WheelSpeeds, TheTighterSideDecides) {
  const WheelSpeeds scaled = scaleInto({20.0, 20.0}, {10.0, 4.0});
  EXPECT_DOUBLE_EQ(4.0, scaled.left);
  EXPECT_DOUBLE_EQ(4.0, scaled.right);
}

// Without a usable limit or a finite speed nothing turns.
TEST(WheelSpeeds, NonsenseGivesZero) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ((WheelSpeeds{}), scaleInto({1.0, 1.0}, {0.0, 10.0}));
  EXPECT_EQ((WheelSpeeds{}), scaleInto({1.0, 1.0}, {10.0, -1.0}));
  EXPECT_EQ((WheelSpeeds{}), scaleInto({1.0, 1.0}, {10.0, kNan}));
  EXPECT_EQ((WheelSpeeds{}), scaleInto({kNan, 1.0}, {10.0, 10.0}));
  EXPECT_EQ((WheelSpeeds{}), scaleInto({1.0, kInfinity}, {10.0, 10.0}));
}

}  // namespace
}  // namespace nord_driver::robot

#include <gtest/gtest.h>

#include <cmath>

#include "robot/steered_reach.h"

namespace nord_driver::robot {
namespace {

SteeredReach reach(double range) {
  return SteeredReach{{{0.5, 0.0, 0.1, -range, range}, {-0.5, 0.0, 0.1, -range, range}}};
}

// On the spot both wheels go round half a metre away from the middle, the one to the left, the other to the right.
TEST(SteeredReach, WheelsOfAMotion) {
  EXPECT_EQ(2u, reach(1.6).wheelCount());
  const WheelSpeeds straight = reach(1.6).wheels({1.0, 0.0});
  EXPECT_NEAR(10.0, straight[0], 1e-12);
  EXPECT_NEAR(10.0, straight[1], 1e-12);
  const WheelSpeeds turning = reach(1.6).wheels({0.0, 1.0});
  EXPECT_NEAR(5.0, std::abs(turning[0]), 1e-12);
  EXPECT_NEAR(5.0, std::abs(turning[1]), 1e-12);
}

// What the steering range does not let it do asks nothing of the wheels.
TEST(SteeredReach, NothingOutsideTheSteeringRange) {
  EXPECT_TRUE(reach(1.6).movesSideways());
  EXPECT_FALSE(reach(1.0).movesSideways());
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), reach(1.0).wheels({0.0, 1.0}));
}

TEST(SteeredReach, BackFromWheelsThatStandStraight) {
  SteeredReach base = reach(1.0);
  EXPECT_DOUBLE_EQ(1.0, base.twist({10.0, 10.0}).linear_x);
  EXPECT_FALSE(base.setGeometry(BaseGeometry{}));
}

}  // namespace
}  // namespace nord_driver::robot

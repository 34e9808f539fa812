#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "profile/scaling.h"

namespace nord_driver::profile {
namespace {

// 4000h is 100 % of P105, 2000h 50 %, C000h -100 % (BU 2700 6.4.4; some manuals print -16385 or -16383).
TEST(Scaling, TurnsFrequenciesIntoSharesOfP105) {
  EXPECT_EQ(0x4000, toSetpoint1({50.0}, {50.0}).word);
  EXPECT_EQ(0x2000, toSetpoint1({25.0}, {50.0}).word);
  EXPECT_EQ(-16384, toSetpoint1({-70.0}, {70.0}).word);
  EXPECT_EQ(0, toSetpoint1({0.0}, {50.0}).word);
  EXPECT_DOUBLE_EQ(25.0, fromActualValue1(0x2000, {50.0}).value);
  EXPECT_DOUBLE_EQ(-70.0, fromActualValue1(-16384, {70.0}).value);
}

TEST(Scaling, SaturatesAtOneHundredPercent) {
  const Setpoint beyond = toSetpoint1({51.0}, {50.0});
  EXPECT_EQ(16384, beyond.word);
  EXPECT_TRUE(beyond.saturated);
  EXPECT_EQ(-16384, toSetpoint1({-1e300}, {50.0}).word);
  EXPECT_FALSE(toSetpoint1({50.0}, {50.0}).saturated);
}

// What is no number stops: it becomes 0, and says so.
TEST(Scaling, TurnsNonsenseIntoZero) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double wanted : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(0, toSetpoint1({wanted}, {50.0}).word);
    EXPECT_TRUE(toSetpoint1({wanted}, {50.0}).invalid);
  }
  for (const double maximum : {0.0, -50.0, kNan, 1e-320}) {
    EXPECT_EQ(0, toSetpoint1({10.0}, {maximum}).word) << maximum;
    EXPECT_TRUE(toSetpoint1({10.0}, {maximum}).invalid) << maximum;
  }
}

// Two pole pairs, gear 20: 50 Hz are 25 motor turns and 1.25 joint turns per second.
TEST(Scaling, TurnsAJointsSpeedIntoAFrequency) {
  JointScaling scaling;
  scaling.gear_ratio = 20.0;
  scaling.pole_pairs = 2;
  EXPECT_NEAR(7.853981633974483, toRadPerSec({50.0}, scaling).value, 1e-12);
  EXPECT_NEAR(50.0, toHertz({7.853981633974483}, scaling).value, 1e-12);
  scaling.inverted = true;
  EXPECT_NEAR(-7.853981633974483, toRadPerSec({50.0}, scaling).value, 1e-12);
  EXPECT_NEAR(-50.0, toHertz({7.853981633974483}, scaling).value, 1e-12);
}

}  // namespace
}  // namespace nord_driver::profile

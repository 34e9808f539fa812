#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "robot/generators.h"
#include "robot/steered_kinematics.h"

namespace nord_driver::robot {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kQuarter = kPi / 2.0;

/// Two axles on the middle line, 0.5 m before and behind the base, on wheels of 0.1 m.
SteeredAxles twoAxles(double range = kQuarter) {
  return {{0.5, 0.0, 0.1, -range, range}, {-0.5, 0.0, 0.1, -range, range}};
}

SteeringAngles straight() {
  return {0.0, 0.0};
}

/// Two to four axles anywhere, each with a place of its own, free to turn by half a turn at least.
SteeredAxles anyAxles() {
  SteeredAxles axles;
  const int count = *rc::gen::inRange(2, 5);
  for (int i = 0; i < count; ++i) {
    SteeredAxle axle;
    axle.x = *number(-0.4, 0.4) + (i % 2 == 0 ? 1.0 : -1.0);
    axle.y = *number(-0.4, 0.4) + (i < 2 ? 0.0 : 1.0);
    axle.wheel_radius = *number(0.02, 0.5);
    axle.min_angle = *number(-4.0, -kQuarter);
    axle.max_angle = *number(kQuarter, 4.0);
    axles.push_back(axle);
  }
  return axles;
}

SteeringAngles anyAngles(const SteeredAxles& axles) {
  SteeringAngles angles;
  for (const SteeredAxle& axle : axles) angles.push_back(*number(axle.min_angle, axle.max_angle));
  return angles;
}

std::string problemOf(const SteeredAxles& axles) {
  try {
    SteeredKinematics{axles};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(SteeredKinematics, StraightAhead) {
  const SteeredSetpoint setpoint = SteeredKinematics{twoAxles()}.solve({1.0, 0.0}, straight(), straight());
  EXPECT_EQ(straight(), setpoint.angles);
  EXPECT_EQ((WheelSpeeds{10.0, 10.0}), setpoint.wheels);
}

// REP-103: a turn to the left. The front wheel points to the left, the rear wheel to the right, about (0, 0.5).
TEST(SteeredKinematics, TurningLeftOnACircle) {
  const SteeredSetpoint setpoint = SteeredKinematics{twoAxles()}.solve({0.5, 1.0}, straight(), straight());
  EXPECT_NEAR(kPi / 4.0, setpoint.angles[0], 1e-12);
  EXPECT_NEAR(-kPi / 4.0, setpoint.angles[1], 1e-12);
  EXPECT_NEAR(std::sqrt(0.5) / 0.1, setpoint.wheels[0], 1e-12);
  EXPECT_NEAR(std::sqrt(0.5) / 0.1, setpoint.wheels[1], 1e-12);
}

// REP-103: positive y is to the left, and so is a quarter of a turn of the wheels.
TEST(SteeredKinematics, ToTheLeft) {
  const SteeredSetpoint setpoint = SteeredKinematics{twoAxles()}.solve({0.0, 0.0, 1.0}, {0.1, 0.1}, {0.1, 0.1});
  EXPECT_NEAR(kQuarter, setpoint.angles[0], 1e-12);
  EXPECT_NEAR(kQuarter, setpoint.angles[1], 1e-12);
  EXPECT_NEAR(10.0, setpoint.wheels[0], 1e-12);
}

// A wheel turned by 70 degrees to the left goes backward sooner than by 110 degrees to the right.
TEST(SteeredKinematics, ReversesTheWheelWhereThatIsNearer) {
  const double to_the_right = -20.0 * kPi / 180.0;
  const Twist2d twist{-std::cos(to_the_right), 0.0, -std::sin(to_the_right)};
  const SteeredSetpoint setpoint = SteeredKinematics{twoAxles()}.solve(twist, straight(), straight());
  EXPECT_NEAR(to_the_right, setpoint.angles[0], 1e-12);
  EXPECT_NEAR(-10.0, setpoint.wheels[0], 1e-12);
}

// Sideways is a quarter of a turn to either side: whichever was chosen is kept, although the wheel stands on the other
// side of the middle a moment later.
TEST(SteeredKinematics, DoesNotSwingBetweenTwoThatAreNear) {
  const SteeredKinematics kinematics{twoAxles()};
  const Twist2d left{0.0, 0.0, 1.0};
  for (const double side : {-1.0, 1.0}) {
    const SteeringAngles last{side * kQuarter, side * kQuarter};
    const SteeredSetpoint setpoint = kinematics.solve(left, {-side * 0.05, side * 0.05}, last);
    EXPECT_NEAR(side * kQuarter, setpoint.angles[0], 1e-12);
    EXPECT_NEAR(side * kQuarter, setpoint.angles[1], 1e-12);
    EXPECT_NEAR(side * 10.0, setpoint.wheels[0], 1e-12);
  }
}

// About a point under a wheel: that wheel has no direction, and keeps its angle.
TEST(SteeredKinematics, AWheelTheBaseTurnsAboutKeepsItsAngle) {
  const SteeredKinematics kinematics{twoAxles()};
  const Twist2d about_the_rear{0.0, 1.0, 0.5};
  ASSERT_TRUE(kinematics.isPossible(about_the_rear));
  const SteeredSetpoint setpoint = kinematics.solve(about_the_rear, {1.0, 0.3}, {1.0, 0.3});
  EXPECT_NEAR(kQuarter, setpoint.angles[0], 1e-12);
  EXPECT_EQ(0.3, setpoint.angles[1]);
  EXPECT_NEAR(0.0, setpoint.wheels[1], 1e-12);
}

// Standing asks for no angle.
TEST(SteeredKinematics, StandingKeepsTheAngles) {
  const SteeredSetpoint setpoint = SteeredKinematics{twoAxles()}.solve({}, {1.0, -1.0}, {0.4, -0.3});
  EXPECT_EQ((SteeringAngles{0.4, -0.3}), setpoint.angles);
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), setpoint.wheels);
}

// A curve too tight for 45 degrees becomes the tightest there is, at the same speed forward.
TEST(SteeredKinematics, TheCurveIsWidenedToTheSteeringRange) {
  const SteeredKinematics kinematics{twoAxles(kPi / 4.0)};
  const Twist2d tight{0.5, 4.0};
  EXPECT_FALSE(kinematics.isPossible(tight));
  const Twist2d possible = kinematics.possible(tight);
  EXPECT_EQ(0.5, possible.linear_x);
  EXPECT_NEAR(1.0, possible.angular_z, 1e-6);
  const Twist2d backward = kinematics.possible({-0.5, 4.0});
  EXPECT_EQ(-0.5, backward.linear_x);
  EXPECT_NEAR(1.0, backward.angular_z, 1e-6);
}

// Without a forward part there is nothing to hold on to: the base stands.
TEST(SteeredKinematics, NeitherTurnsOnTheSpotNorGoesSidewaysInANarrowRange) {
  const SteeredKinematics kinematics{twoAxles(kPi / 4.0)};
  EXPECT_EQ(Twist2d{}, kinematics.possible({0.0, 1.0}));
  EXPECT_EQ(Twist2d{}, kinematics.possible({0.0, 0.0, 1.0}));
  EXPECT_EQ((Twist2d{0.0, 1.0}), SteeredKinematics{twoAxles()}.possible({0.0, 1.0}));
}

TEST(SteeredKinematics, NoNumberIsNoMotion) {
  const SteeredKinematics kinematics{twoAxles()};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Twist2d{}, kinematics.possible({nan, 1.0}));
  EXPECT_FALSE(kinematics.isPossible({1.0, nan}));
  const SteeredSetpoint setpoint = kinematics.solve({1.0, nan}, straight(), {0.1, 0.2});
  EXPECT_EQ((SteeringAngles{0.1, 0.2}), setpoint.angles);
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), setpoint.wheels);
}

// Half-way to its angle a wheel turns with the part of the motion along it, and not at all across it.
TEST(SteeredKinematics, AWheelTurnsWithItsPartOfTheMotion) {
  const SteeredKinematics kinematics{twoAxles()};
  const WheelSpeeds wheels = kinematics.wheels({1.0, 0.0}, {kPi / 3.0, kQuarter});
  EXPECT_NEAR(5.0, wheels[0], 1e-12);
  EXPECT_NEAR(0.0, wheels[1], 1e-12);
  EXPECT_EQ((WheelSpeeds{0.0, 0.0}), kinematics.wheels({1.0, 0.0}, {0.0}));
}

// One wheel that says 0.4 m/s more moves the best fit by half of it.
TEST(SteeredKinematics, ContradictingWheelsGiveTheBestFit) {
  const SteeredKinematics kinematics{twoAxles()};
  const Twist2d twist = kinematics.twist({14.0, 10.0}, straight());
  EXPECT_NEAR(1.2, twist.linear_x, 1e-12);
  EXPECT_NEAR(0.0, twist.angular_z, 1e-12);
  EXPECT_EQ(Twist2d{}, kinematics.twist({14.0}, straight()));
  EXPECT_EQ(Twist2d{}, kinematics.twist({14.0, 10.0}, {0.0}));
}

TEST(SteeredKinematics, LargestDifference) {
  EXPECT_DOUBLE_EQ(0.5, largestDifference({0.0, 1.0}, {0.2, 0.5}));
  EXPECT_EQ(std::numeric_limits<double>::infinity(), largestDifference({0.0}, {0.0, 0.0}));
  EXPECT_EQ(std::numeric_limits<double>::infinity(),
            largestDifference({0.0, std::numeric_limits<double>::quiet_NaN()}, {9.0, 0.0}));
}

TEST(SteeredKinematics, RefusesImpossibleBases) {
  using testing::HasSubstr;
  EXPECT_EQ("", problemOf(twoAxles()));
  EXPECT_THAT(problemOf({twoAxles()[0]}), HasSubstr("has 1 axles, expected two at least"));
  const auto with = [](double SteeredAxle::*field, double value) {
    SteeredAxles axles = twoAxles();
    axles[1].*field = value;
    return problemOf(axles);
  };
  EXPECT_THAT(with(&SteeredAxle::x, 0.5), HasSubstr("axle 2 of the steered base stands where axle 1 stands"));
  EXPECT_THAT(with(&SteeredAxle::y, std::numeric_limits<double>::infinity()), HasSubstr("stands at no finite place"));
  EXPECT_THAT(with(&SteeredAxle::wheel_radius, 0.0), HasSubstr("has a wheel radius of 0"));
  EXPECT_THAT(with(&SteeredAxle::min_angle, 0.1), HasSubstr("expected a range that holds 0"));
  EXPECT_THAT(with(&SteeredAxle::max_angle, 20.0), HasSubstr("three turns to either side at most"));
}

// For every base: angles and speeds and back is the same motion. A wheel within a thousandth of the middle of the
// motion keeps its angle, and bends the fit by that.
RC_GTEST_PROP(SteeredKinematicsProperty, ForwardThenInverseIsIdentity, ()) {
  const SteeredAxles axles = anyAxles();
  const SteeredKinematics kinematics{axles};
  const Twist2d twist = *twistWithin(5.0, 10.0, 5.0);
  RC_ASSERT(kinematics.possible(twist) == twist);
  const SteeringAngles present = anyAngles(axles);
  const SteeredSetpoint setpoint = kinematics.solve(twist, present, anyAngles(axles));
  const Twist2d back = kinematics.twist(setpoint.wheels, setpoint.angles);
  bool keeps = false;
  for (std::size_t i = 0; i < axles.size(); ++i) {
    const double size =
        std::hypot(twist.linear_x - twist.angular_z * axles[i].y, twist.linear_y + twist.angular_z * axles[i].x);
    keeps = keeps || std::abs(std::abs(setpoint.wheels[i]) * axles[i].wheel_radius - size) > 1e-9;
  }
  const double bound = keeps ? 0.1 : 1e-9;
  RC_ASSERT(std::abs(back.linear_x - twist.linear_x) < bound);
  RC_ASSERT(std::abs(back.angular_z - twist.angular_z) < bound);
  RC_ASSERT(std::abs(back.linear_y - twist.linear_y) < bound);
}

// Against geometry: seen from the instantaneous centre, every wheel stands across the line to it.
RC_GTEST_PROP(SteeredKinematicsProperty, EveryWheelStandsAcrossTheLineToTheCentre, ()) {
  const SteeredAxles axles = anyAxles();
  const SteeredKinematics kinematics{axles};
  Twist2d twist = *twistWithin(2.0, 3.0, 2.0);
  if (std::abs(twist.angular_z) < 0.01) twist.angular_z = 0.01;
  const double center_x = -twist.linear_y / twist.angular_z;
  const double center_y = twist.linear_x / twist.angular_z;
  const SteeringAngles present = anyAngles(axles);
  const SteeredSetpoint setpoint = kinematics.solve(twist, present, present);
  for (std::size_t i = 0; i < axles.size(); ++i) {
    const double to_x = axles[i].x - center_x;
    const double to_y = axles[i].y - center_y;
    if (std::hypot(to_x, to_y) < 0.05 * (1.0 + std::hypot(center_x, center_y))) continue;
    const double along = to_x * std::cos(setpoint.angles[i]) + to_y * std::sin(setpoint.angles[i]);
    RC_ASSERT(std::abs(along) < 1e-6 * std::hypot(to_x, to_y));
    // Counter-clockwise about the centre when the base turns so.
    const double across = -to_y * std::cos(setpoint.angles[i]) + to_x * std::sin(setpoint.angles[i]);
    RC_ASSERT(std::signbit(across * setpoint.wheels[i]) == std::signbit(twist.angular_z));
  }
}

// With half a turn of range no wheel is steered by more than a quarter (and kKeep), unless the end of its range is in
// the way.
RC_GTEST_PROP(SteeredKinematicsProperty, SteersTheShorterWay, ()) {
  const SteeredKinematics kinematics{{{1.0, 0.0, 0.1, -9.0, 9.0}, {-1.0, 0.3, 0.1, -9.0, 9.0}}};
  const SteeringAngles present{*number(-7.0, 7.0), *number(-7.0, 7.0)};
  const SteeringAngles last{*number(-7.0, 7.0), *number(-7.0, 7.0)};
  const SteeredSetpoint setpoint = kinematics.solve(*twistWithin(5.0, 10.0, 5.0), present, last);
  for (std::size_t i = 0; i < 2; ++i) {
    if (setpoint.angles[i] == last[i]) continue;  // stands
    RC_ASSERT(std::abs(setpoint.angles[i] - present[i]) <= kQuarter + SteeredKinematics::kKeep / 2.0 + 1e-9);
  }
}

// Angles of a motion that changes little change little, as long as no end of a range and no standing wheel is near.
RC_GTEST_PROP(SteeredKinematicsProperty, NoJumpOnASteadyWay, ()) {
  const SteeredKinematics kinematics{{{0.6, 0.1, 0.1, -9.0, 9.0}, {-0.5, -0.2, 0.1, -9.0, 9.0}}};
  const Twist2d from = *twistWithin(1.0, 1.0, 1.0);
  const Twist2d to = *twistWithin(1.0, 1.0, 1.0);
  SteeringAngles last = kinematics.solve(from, straight(), straight()).angles;
  constexpr int kSteps = 2000;
  for (int i = 1; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const Twist2d twist{from.linear_x + part * (to.linear_x - from.linear_x),
                        from.angular_z + part * (to.angular_z - from.angular_z),
                        from.linear_y + part * (to.linear_y - from.linear_y)};
    const SteeredSetpoint setpoint = kinematics.solve(twist, last, last);
    for (std::size_t axle = 0; axle < 2; ++axle) {
      // The direction turns by at most the step over the speed.
      const double speed = std::abs(setpoint.wheels[axle]) * 0.1;
      if (speed < 0.05) continue;
      RC_ASSERT(std::abs(setpoint.angles[axle] - last[axle]) < 5.0 / kSteps / speed);
    }
    last = setpoint.angles;
  }
}

// Whatever is asked for: what comes out is in range, goes as fast forward, and is no other curve than one between
// straight on and the one asked for.
RC_GTEST_PROP(SteeredKinematicsProperty, PossibleStaysInRange, ()) {
  const double range = *number(0.1, 1.5);
  const SteeredKinematics kinematics{twoAxles(range)};
  const Twist2d twist = *twistWithin(2.0, 3.0, 2.0);
  const Twist2d possible = kinematics.possible(twist);
  RC_ASSERT(kinematics.isPossible(possible) || possible == Twist2d{});
  RC_ASSERT(possible.linear_x == twist.linear_x);
  const double part = twist.angular_z != 0.0 ? possible.angular_z / twist.angular_z : 0.0;
  RC_ASSERT(part >= 0.0 && part <= 1.0);
  RC_ASSERT(std::abs(possible.linear_y - (twist.angular_z != 0.0 ? part * twist.linear_y : possible.linear_y)) < 1e-9);
  const SteeredSetpoint setpoint = kinematics.solve(possible, straight(), straight());
  for (const double angle : setpoint.angles) RC_ASSERT(std::abs(angle) <= range);
  const Twist2d back = kinematics.twist(setpoint.wheels, setpoint.angles);
  RC_ASSERT(std::abs(back.linear_x - possible.linear_x) < 1e-2);
}

}  // namespace
}  // namespace nord_driver::robot

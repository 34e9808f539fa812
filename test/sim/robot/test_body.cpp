#include <gtest/gtest.h>

#include <cmath>

#include "sim/robot/body.h"

namespace nord_driver::sim {
namespace {

constexpr double kPi = 3.141592653589793;

Wheels sides(double left, double right) {
  return {left, left, right, right};
}

/// Moves from the reference to `angles` in small steps.
void roll(Body& body, const Wheels& from, const Wheels& to, int steps = 1000) {
  body.moveTo(from);
  for (int i = 1; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    const auto between = [part](double a, double b) { return a + part * (b - a); };
    body.moveTo({between(from.front_left, to.front_left), between(from.rear_left, to.rear_left),
                 between(from.front_right, to.front_right), between(from.rear_right, to.rear_right)});
  }
}

// Equal wheels go straight, unequal ones turn about the middle of the axle.
TEST(DiffDriveBody, IntegratesThePose) {
  DiffDriveBody body{0.1, 0.5};
  roll(body, sides(5.0, 5.0), sides(15.0, 15.0));
  EXPECT_NEAR(1.0, body.pose().x, 1e-12);
  EXPECT_NEAR(0.0, body.pose().y, 1e-12);
  const double quarter = kPi / 2 * 0.25 / 0.1;  // wheel angle for 90 degrees on the spot
  roll(body, sides(15.0, 15.0), sides(15.0 - quarter, 15.0 + quarter));
  EXPECT_NEAR(kPi / 2, body.pose().theta, 1e-9);
  EXPECT_NEAR(1.0, body.pose().x, 1e-9);
  body.setSpeeds(sides(2.0, 4.0));
  EXPECT_DOUBLE_EQ(0.3, body.linear());
  EXPECT_DOUBLE_EQ(0.0, body.lateral());
  EXPECT_DOUBLE_EQ(0.4, body.angular());
}

// Rollers as an X seen from above: rear left and front right forward, the others backward, is a metre to the left.
TEST(MecanumBody, MovesSideways) {
  MecanumBody body{0.1, 0.5, 0.7};
  roll(body, {}, {-10.0, 10.0, 10.0, -10.0});
  EXPECT_NEAR(0.0, body.pose().x, 1e-12);
  EXPECT_NEAR(1.0, body.pose().y, 1e-12);
  EXPECT_NEAR(0.0, body.pose().theta, 1e-12);
  body.setSpeeds({-2.0, 2.0, 2.0, -2.0});
  EXPECT_DOUBLE_EQ(0.2, body.lateral());
  EXPECT_DOUBLE_EQ(0.0, body.linear());
  EXPECT_DOUBLE_EQ(0.0, body.angular());
}

// All forward is straight on; the sides against each other turn it, with half of length plus width as lever (0.6 m).
TEST(MecanumBody, DrivesAndTurns) {
  MecanumBody body{0.1, 0.5, 0.7};
  roll(body, {}, sides(10.0, 10.0));
  EXPECT_NEAR(1.0, body.pose().x, 1e-12);
  const double quarter = kPi / 2 * 0.6 / 0.1;
  roll(body, sides(10.0, 10.0), sides(10.0 - quarter, 10.0 + quarter));
  EXPECT_NEAR(kPi / 2, body.pose().theta, 1e-9);
  EXPECT_NEAR(1.0, body.pose().x, 1e-9);
  // Turned by 90 degrees, sideways to the left is backward in the world.
  const Wheels here = sides(10.0 - quarter, 10.0 + quarter);
  roll(body, here, {here.front_left - 5.0, here.rear_left + 5.0, here.front_right + 5.0, here.rear_right - 5.0});
  EXPECT_NEAR(0.5, body.pose().x, 1e-9);
  EXPECT_NEAR(0.0, body.pose().y, 1e-9);
}

/// Half a metre before and behind the middle, wheels of 0.1 m.
SteeredBody twoSteeredAxles() {
  return SteeredBody{{0.5, 0.0, 0.1}, {-0.5, 0.0, 0.1}};
}

// Straight on, and to the left with both wheels turned by a quarter.
TEST(SteeredBody, DrivesWhereItsWheelsPoint) {
  SteeredBody body = twoSteeredAxles();
  roll(body, {}, {10.0, 10.0, 0.0, 0.0});
  EXPECT_NEAR(1.0, body.pose().x, 1e-12);
  body.moveTo({20.0, 20.0, 0.0, 0.0}, {kPi / 2, kPi / 2});
  EXPECT_NEAR(1.0, body.pose().x, 1e-12);
  EXPECT_NEAR(1.0, body.pose().y, 1e-12);
  EXPECT_NEAR(0.0, body.pose().theta, 1e-12);
}

// 45 degrees to either side is a circle of half a metre about (0, 0.5): after one turn the robot is where it was.
TEST(SteeredBody, DrivesACircle) {
  SteeredBody body = twoSteeredAxles();
  const Steering left{kPi / 4, -kPi / 4};
  const double way = 2 * kPi * std::sqrt(0.5) / 0.1;
  constexpr int kSteps = 10000;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = way * i / kSteps;
    body.moveTo({angle, angle, 0.0, 0.0}, left);
    if (i != kSteps / 2) continue;
    EXPECT_NEAR(0.0, body.pose().x, 1e-6);
    EXPECT_NEAR(1.0, body.pose().y, 1e-6);
  }
  EXPECT_NEAR(0.0, body.pose().x, 1e-6);
  EXPECT_NEAR(0.0, body.pose().y, 1e-6);
  EXPECT_NEAR(2 * kPi, body.pose().theta, 1e-9);
}

// Wheels that stand still and are steered move nothing.
TEST(SteeredBody, SteeringAloneMovesNothing) {
  SteeredBody body = twoSteeredAxles();
  for (int i = 0; i < 100; ++i) body.moveTo({}, {0.01 * i, -0.02 * i});
  EXPECT_EQ(0.0, body.pose().x);
  EXPECT_EQ(0.0, body.pose().y);
  EXPECT_EQ(0.0, body.pose().theta);
}

// One wheel that turns faster than the other drags it: both slip by half the difference.
TEST(SteeredBody, ContradictingWheelsShareTheSlip) {
  SteeredBody body = twoSteeredAxles();
  body.setSpeeds({14.0, 10.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(1.2, body.linear());
  EXPECT_DOUBLE_EQ(0.0, body.lateral());
  EXPECT_DOUBLE_EQ(0.0, body.angular());
}

// Only the front wheel is steered: the robot turns about the point where the axles' lines meet.
TEST(SteeredBody, TurnsLikeACarWithOneAxleStraight) {
  SteeredBody body{{1.0, 0.0, 0.1}, {0.0, 0.0, 0.1}};
  body.setSpeeds({std::sqrt(2.0) * 10.0, 10.0, 0.0, 0.0}, {kPi / 4, 0.0});
  EXPECT_NEAR(1.0, body.linear(), 1e-12);
  EXPECT_NEAR(0.0, body.lateral(), 1e-12);
  EXPECT_NEAR(1.0, body.angular(), 1e-12);
}

}  // namespace
}  // namespace nord_driver::sim

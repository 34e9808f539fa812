#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>

#include "robot/generators.h"
#include "robot/mecanum_kinematics.h"

namespace nord_driver::robot {
namespace {

/// A lever of half a metre on wheels of 0.1 m.
BaseGeometry geometry() {
  BaseGeometry geometry;
  geometry.wheel_separation = 0.4;
  geometry.wheel_base = 0.6;
  geometry.left_wheel_radius = 0.1;
  geometry.right_wheel_radius = 0.1;
  return geometry;
}

BaseGeometry anyGeometry() {
  BaseGeometry any;
  any.wheel_separation = *number(0.05, 5.0);
  any.wheel_base = *number(0.05, 5.0);
  any.left_wheel_radius = *number(0.01, 1.0);
  any.right_wheel_radius = *number(0.01, 1.0);
  any.wheel_separation_multiplier = *number(0.5, 1.5);
  any.left_wheel_radius_multiplier = *number(0.5, 1.5);
  any.right_wheel_radius_multiplier = *number(0.5, 1.5);
  return any;
}

std::string problemOf(const BaseGeometry& geometry, std::size_t left = 2, std::size_t right = 2) {
  try {
    makeKinematics(BaseKind::kMecanum, geometry, left, right);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

// Wheels: front left, rear left, front right, rear right.
TEST(MecanumKinematics, StraightAhead) {
  EXPECT_EQ((WheelSpeeds{10.0, 10.0, 10.0, 10.0}), MecanumKinematics{geometry()}.wheels({1.0, 0.0}));
}

// REP-103: positive y is to the left. Front right and rear left roll forward, the other two backward.
TEST(MecanumKinematics, ToTheLeft) {
  EXPECT_EQ((WheelSpeeds{-10.0, 10.0, 10.0, -10.0}), MecanumKinematics{geometry()}.wheels({0.0, 0.0, 1.0}));
}

// A turn to the left: the right wheels forward.
TEST(MecanumKinematics, TurningLeft) {
  EXPECT_EQ((WheelSpeeds{-10.0, -10.0, 10.0, 10.0}), MecanumKinematics{geometry()}.wheels({0.0, 2.0}));
}

// Forward and left at once: two wheels stand, the others turn at the sum.
TEST(MecanumKinematics, Diagonally) {
  EXPECT_EQ((WheelSpeeds{0.0, 20.0, 20.0, 0.0}), MecanumKinematics{geometry()}.wheels({1.0, 0.0, 1.0}));
}

// Multipliers act on their own side; that of the separation on the whole lever.
TEST(MecanumKinematics, MultipliersAct) {
  BaseGeometry changed = geometry();
  changed.wheel_separation_multiplier = 2.0;
  changed.left_wheel_radius_multiplier = 0.5;
  const MecanumKinematics kinematics{changed};
  EXPECT_EQ((WheelSpeeds{20.0, 20.0, 10.0, 10.0}), kinematics.wheels({1.0, 0.0}));
  EXPECT_EQ((WheelSpeeds{-20.0, -20.0, 10.0, 10.0}), kinematics.wheels({0.0, 1.0}));
}

// Taken over as if built so; sizes that cannot be leave it as it was.
TEST(MecanumKinematics, GoesOnWithOtherSizes) {
  MecanumKinematics kinematics{geometry()};
  BaseGeometry changed = geometry();
  changed.left_wheel_radius_multiplier = 0.5;
  EXPECT_TRUE(kinematics.setGeometry(changed));
  EXPECT_EQ(MecanumKinematics{changed}.wheels({1.0, 0.2}), kinematics.wheels({1.0, 0.2}));
  changed.wheel_base = 0.0;
  EXPECT_FALSE(kinematics.setGeometry(changed));
  EXPECT_EQ((WheelSpeeds{20.0, 20.0, 10.0, 10.0}), kinematics.wheels({1.0, 0.0}));
}

// One wheel that slips by 0.4 m/s moves the best fit by a quarter of it.
TEST(MecanumKinematics, ContradictingWheelsGiveTheBestFit) {
  const Twist2d twist = MecanumKinematics{geometry()}.twist({14.0, 10.0, 10.0, 10.0});
  EXPECT_NEAR(1.1, twist.linear_x, 1e-12);
  EXPECT_NEAR(-0.1, twist.linear_y, 1e-12);
  EXPECT_NEAR(-0.2, twist.angular_z, 1e-12);
  EXPECT_EQ(Twist2d{}, (MecanumKinematics{geometry()}.twist({1.0, 1.0})));
}

// What cannot be is refused in words: a missing wheel base, a side without its two wheels.
TEST(MecanumKinematics, RefusesImpossibleBases) {
  EXPECT_EQ("", problemOf(geometry()));
  EXPECT_EQ("a mecanum base has 2 wheels in left_wheel and 1 in right_wheel, expected two in each, the front one first",
            problemOf(geometry(), 2, 1));
  EXPECT_NE("", problemOf(geometry(), 4, 2));
  const auto with = [](double BaseGeometry::*field, double value) {
    BaseGeometry changed = geometry();
    changed.*field = value;
    return problemOf(changed);
  };
  using testing::HasSubstr;
  EXPECT_THAT(with(&BaseGeometry::wheel_base, 0.0), HasSubstr("wheel_base is 0"));
  EXPECT_THAT(with(&BaseGeometry::wheel_separation, -1.0), HasSubstr("wheel_separation is -1"));
  EXPECT_THAT(with(&BaseGeometry::right_wheel_radius, std::numeric_limits<double>::infinity()),
              HasSubstr("right_wheel_radius is inf"));
}

// For every geometry: wheels and back is the same motion, in three axes.
RC_GTEST_PROP(MecanumKinematicsProperty, ForwardThenInverseIsIdentity, ()) {
  const MecanumKinematics kinematics{anyGeometry()};
  const Twist2d twist = *twistWithin(5.0, 10.0, 5.0);
  const Twist2d back = kinematics.twist(kinematics.wheels(twist));
  RC_ASSERT(std::abs(back.linear_x - twist.linear_x) < 1e-9);
  RC_ASSERT(std::abs(back.angular_z - twist.angular_z) < 1e-9);
  RC_ASSERT(std::abs(back.linear_y - twist.linear_y) < 1e-9);
}

// Against the roller itself: at the floor its axis lies across the X seen from above, and along that axis the contact
// point, which moves with the hub and backward with the wheel, must stand.
RC_GTEST_PROP(MecanumKinematicsProperty, NoRollerIsDraggedAlongItsAxis, ()) {
  const BaseGeometry geometry = [] {
    BaseGeometry any = anyGeometry();
    any.wheel_separation_multiplier = 1.0;
    return any;
  }();
  const Twist2d twist = *twistWithin(5.0, 10.0, 5.0);
  const WheelSpeeds speeds = MecanumKinematics{geometry}.wheels(twist);
  for (std::size_t i = 0; i < 4; ++i) {
    const bool is_left = i < 2;
    const bool is_front = i % 2 == 0;
    const double x = (is_front ? 1.0 : -1.0) * geometry.wheel_base / 2.0;
    const double y = (is_left ? 1.0 : -1.0) * geometry.wheel_separation / 2.0;
    const double radius = is_left ? geometry.left_wheel_radius * geometry.left_wheel_radius_multiplier
                                  : geometry.right_wheel_radius * geometry.right_wheel_radius_multiplier;
    const double hub_x = twist.linear_x - twist.angular_z * y;
    const double hub_y = twist.linear_y + twist.angular_z * x;
    // Seen from above the rollers on top point from the corner to the middle, (x, y) of that corner's signs; those at
    // the floor are their mirror image.
    const double axis_y = is_front == is_left ? -1.0 : 1.0;
    RC_ASSERT(std::abs((hub_x - speeds[i] * radius) + hub_y * axis_y) < 1e-9);
  }
}

}  // namespace
}  // namespace nord_driver::robot

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>

#include "nord_driver/robot/diff_drive_kinematics.h"
#include "robot/generators.h"

namespace nord_driver::robot {
namespace {

DiffDriveGeometry geometry() {
  DiffDriveGeometry geometry;
  geometry.wheel_separation = 0.5;
  geometry.left_wheel_radius = 0.1;
  geometry.right_wheel_radius = 0.1;
  return geometry;
}

std::string problemOf(const DiffDriveGeometry& geometry) {
  try {
    DiffDriveKinematics{geometry};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

// Straight ahead both wheels turn at v / r.
TEST(DiffDriveKinematics, StraightAhead) {
  const WheelSpeeds wheels = DiffDriveKinematics{geometry()}.wheels({1.0, 0.0});
  EXPECT_DOUBLE_EQ(10.0, wheels.left);
  EXPECT_DOUBLE_EQ(10.0, wheels.right);
}

// REP-103: a positive yaw is counter-clockwise, so the right wheel runs ahead.
TEST(DiffDriveKinematics, TurningLeftRunsTheRightWheelForward) {
  const WheelSpeeds wheels = DiffDriveKinematics{geometry()}.wheels({0.0, 2.0});
  EXPECT_DOUBLE_EQ(-5.0, wheels.left);
  EXPECT_DOUBLE_EQ(5.0, wheels.right);
}

// About a point under the left wheel, the left wheel stands.
TEST(DiffDriveKinematics, TurningAboutOneWheel) {
  const WheelSpeeds wheels = DiffDriveKinematics{geometry()}.wheels({0.25, 1.0});
  EXPECT_DOUBLE_EQ(0.0, wheels.left);
  EXPECT_DOUBLE_EQ(5.0, wheels.right);
}

// Multipliers act on their own side and on the separation.
TEST(DiffDriveKinematics, MultipliersAct) {
  DiffDriveGeometry changed = geometry();
  changed.wheel_separation_multiplier = 2.0;
  changed.left_wheel_radius_multiplier = 0.5;
  changed.right_wheel_radius_multiplier = 2.0;
  const DiffDriveKinematics kinematics{changed};
  EXPECT_DOUBLE_EQ(1.0, kinematics.wheelSeparation());
  EXPECT_DOUBLE_EQ(0.05, kinematics.leftWheelRadius());
  EXPECT_DOUBLE_EQ(0.2, kinematics.rightWheelRadius());
  const WheelSpeeds wheels = kinematics.wheels({1.0, 0.0});
  EXPECT_DOUBLE_EQ(20.0, wheels.left);
  EXPECT_DOUBLE_EQ(5.0, wheels.right);
}

// A geometry that cannot be is refused in words that name the field.
TEST(DiffDriveKinematics, RefusesImpossibleGeometry) {
  EXPECT_EQ("", problemOf(geometry()));
  const auto with = [](double DiffDriveGeometry::*field, double value) {
    DiffDriveGeometry changed = geometry();
    changed.*field = value;
    return problemOf(changed);
  };
  using testing::HasSubstr;
  EXPECT_THAT(with(&DiffDriveGeometry::wheel_separation, 0.0), HasSubstr("wheel_separation is 0"));
  EXPECT_THAT(with(&DiffDriveGeometry::left_wheel_radius, -0.1), HasSubstr("left_wheel_radius is -0.1"));
  EXPECT_THAT(with(&DiffDriveGeometry::right_wheel_radius, std::numeric_limits<double>::quiet_NaN()),
              HasSubstr("right_wheel_radius is nan"));
  EXPECT_THAT(with(&DiffDriveGeometry::wheel_separation_multiplier, std::numeric_limits<double>::infinity()),
              HasSubstr("wheel_separation_multiplier is inf"));
  EXPECT_THAT(with(&DiffDriveGeometry::left_wheel_radius_multiplier, 0.0), HasSubstr("left_wheel_radius_multiplier"));
  EXPECT_THAT(with(&DiffDriveGeometry::right_wheel_radius_multiplier, 0.0), HasSubstr("right_wheel_radius_multiplier"));
}

// For every geometry: wheels and back is the same motion.
RC_GTEST_PROP(DiffDriveKinematicsProperty, ForwardThenInverseIsIdentity, ()) {
  DiffDriveGeometry any;
  any.wheel_separation = *number(0.05, 5.0);
  any.left_wheel_radius = *number(0.01, 1.0);
  any.right_wheel_radius = *number(0.01, 1.0);
  any.wheel_separation_multiplier = *number(0.5, 1.5);
  any.left_wheel_radius_multiplier = *number(0.5, 1.5);
  any.right_wheel_radius_multiplier = *number(0.5, 1.5);
  const DiffDriveKinematics kinematics{any};
  const Twist2d twist = *twistWithin(5.0, 10.0);
  const Twist2d back = kinematics.twist(kinematics.wheels(twist));
  RC_ASSERT(std::abs(back.linear_x - twist.linear_x) < 1e-9);
  RC_ASSERT(std::abs(back.angular_z - twist.angular_z) < 1e-9);
}

}  // namespace
}  // namespace nord_driver::robot

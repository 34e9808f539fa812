#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>

#include "robot/diff_drive_kinematics.h"
#include "robot/generators.h"

namespace nord_driver::robot {
namespace {

BaseGeometry geometry() {
  BaseGeometry geometry;
  geometry.wheel_separation = 0.5;
  geometry.left_wheel_radius = 0.1;
  geometry.right_wheel_radius = 0.1;
  return geometry;
}

std::string problemOf(const BaseGeometry& geometry) {
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
  EXPECT_DOUBLE_EQ(10.0, wheels[0]);
  EXPECT_DOUBLE_EQ(10.0, wheels[1]);
}

// REP-103: a positive yaw is counter-clockwise, so the right wheel runs ahead.
TEST(DiffDriveKinematics, TurningLeftRunsTheRightWheelForward) {
  const WheelSpeeds wheels = DiffDriveKinematics{geometry()}.wheels({0.0, 2.0});
  EXPECT_DOUBLE_EQ(-5.0, wheels[0]);
  EXPECT_DOUBLE_EQ(5.0, wheels[1]);
}

// About a point under the left wheel, the left wheel stands.
TEST(DiffDriveKinematics, TurningAboutOneWheel) {
  const WheelSpeeds wheels = DiffDriveKinematics{geometry()}.wheels({0.25, 1.0});
  EXPECT_DOUBLE_EQ(0.0, wheels[0]);
  EXPECT_DOUBLE_EQ(5.0, wheels[1]);
}

// Multipliers act on their own side and on the separation.
TEST(DiffDriveKinematics, MultipliersAct) {
  BaseGeometry changed = geometry();
  changed.wheel_separation_multiplier = 2.0;
  changed.left_wheel_radius_multiplier = 0.5;
  changed.right_wheel_radius_multiplier = 2.0;
  const DiffDriveKinematics kinematics{changed};
  const WheelSpeeds wheels = kinematics.wheels({1.0, 0.0});
  EXPECT_DOUBLE_EQ(20.0, wheels[0]);
  EXPECT_DOUBLE_EQ(5.0, wheels[1]);
  const WheelSpeeds turning = kinematics.wheels({0.0, 1.0});
  EXPECT_DOUBLE_EQ(-10.0, turning[0]);
  EXPECT_DOUBLE_EQ(2.5, turning[1]);
}

// Taken over as if built so; sizes that cannot be leave it as it was.
TEST(DiffDriveKinematics, GoesOnWithOtherSizes) {
  BaseGeometry geometry;
  geometry.wheel_separation = 0.5;
  geometry.left_wheel_radius = geometry.right_wheel_radius = 0.1;
  DiffDriveKinematics kinematics{geometry, 2, 2};
  geometry.right_wheel_radius_multiplier = 2.0;
  EXPECT_TRUE(kinematics.setGeometry(geometry));
  EXPECT_EQ((WheelSpeeds{10.0, 10.0, 5.0, 5.0}), kinematics.wheels({1.0, 0.0}));
  geometry.wheel_separation_multiplier = -1.0;
  EXPECT_FALSE(kinematics.setGeometry(geometry));
  EXPECT_EQ((WheelSpeeds{10.0, 10.0, 5.0, 5.0}), kinematics.wheels({1.0, 0.0}));
}

// A geometry that cannot be is refused in words that name the field.
TEST(DiffDriveKinematics, RefusesImpossibleGeometry) {
  EXPECT_EQ("", problemOf(geometry()));
  const auto with = [](double BaseGeometry::*field, double value) {
    BaseGeometry changed = geometry();
    changed.*field = value;
    return problemOf(changed);
  };
  using testing::HasSubstr;
  EXPECT_THAT(with(&BaseGeometry::wheel_separation, 0.0), HasSubstr("wheel_separation is 0"));
  EXPECT_THAT(with(&BaseGeometry::left_wheel_radius, -0.1), HasSubstr("left_wheel_radius is -0.1"));
  EXPECT_THAT(with(&BaseGeometry::right_wheel_radius, std::numeric_limits<double>::quiet_NaN()),
              HasSubstr("right_wheel_radius is nan"));
  EXPECT_THAT(with(&BaseGeometry::wheel_separation_multiplier, std::numeric_limits<double>::infinity()),
              HasSubstr("wheel_separation_multiplier is inf"));
  EXPECT_THAT(with(&BaseGeometry::left_wheel_radius_multiplier, 0.0), HasSubstr("left_wheel_radius_multiplier"));
  EXPECT_THAT(with(&BaseGeometry::right_wheel_radius_multiplier, 0.0), HasSubstr("right_wheel_radius_multiplier"));
}

// Skid steer: every wheel of a side turns at the side's speed, and a side moves with the mean of its wheels.
TEST(DiffDriveKinematics, SeveralWheelsASide) {
  const DiffDriveKinematics kinematics{geometry(), 2, 3};
  EXPECT_EQ(5u, kinematics.wheelCount());
  EXPECT_EQ((WheelSpeeds{-5.0, -5.0, 5.0, 5.0, 5.0}), kinematics.wheels({0.0, 2.0}));
  const Twist2d twist = kinematics.twist({4.0, 6.0, 9.0, 10.0, 11.0});  // 0.5 and 1 m/s
  EXPECT_NEAR(0.75, twist.linear_x, 1e-12);
  EXPECT_NEAR(1.0, twist.angular_z, 1e-12);
}

// Two sides cannot go sideways: the wheels do not see it, and the possible part of the motion is without it.
TEST(DiffDriveKinematics, CannotGoSideways) {
  const DiffDriveKinematics kinematics{geometry()};
  EXPECT_FALSE(kinematics.movesSideways());
  EXPECT_EQ((WheelSpeeds{10.0, 10.0}), kinematics.wheels({1.0, 0.0, 3.0}));
  EXPECT_EQ((Twist2d{1.0, 2.0}), kinematics.possible({1.0, 2.0, 3.0}));
}

// Speeds of another base are no motion.
TEST(DiffDriveKinematics, AnotherNumberOfWheelsIsNoMotion) {
  EXPECT_EQ(Twist2d{}, (DiffDriveKinematics{geometry()}.twist({1.0, 1.0, 1.0})));
}

// A side without wheels, or more wheels than fit, are refused in words.
TEST(DiffDriveKinematics, RefusesImpossibleNumbersOfWheels) {
  const auto with = [](std::size_t left, std::size_t right) {
    try {
      makeKinematics(BaseKind::kDifferential, geometry(), left, right);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string{};
  };
  EXPECT_EQ("", with(kMaxWheels / 2, kMaxWheels / 2));
  EXPECT_EQ(
      "the base has 0 wheels in left_wheel and 2 in right_wheel, expected at least one in each and 16 in all at most",
      with(0, 2));
  EXPECT_NE("", with(2, 0));
  EXPECT_NE("", with(kMaxWheels, 1));
}

// For every geometry: wheels and back is the same motion.
RC_GTEST_PROP(DiffDriveKinematicsProperty, ForwardThenInverseIsIdentity, ()) {
  BaseGeometry any;
  any.wheel_separation = *number(0.05, 5.0);
  any.left_wheel_radius = *number(0.01, 1.0);
  any.right_wheel_radius = *number(0.01, 1.0);
  any.wheel_separation_multiplier = *number(0.5, 1.5);
  any.left_wheel_radius_multiplier = *number(0.5, 1.5);
  any.right_wheel_radius_multiplier = *number(0.5, 1.5);
  const DiffDriveKinematics kinematics{any, *rc::gen::inRange<std::size_t>(1, 5), *rc::gen::inRange<std::size_t>(1, 5)};
  const Twist2d twist = *twistWithin(5.0, 10.0);
  const Twist2d back = kinematics.twist(kinematics.wheels(twist));
  RC_ASSERT(std::abs(back.linear_x - twist.linear_x) < 1e-9);
  RC_ASSERT(std::abs(back.angular_z - twist.angular_z) < 1e-9);
}

}  // namespace
}  // namespace nord_driver::robot

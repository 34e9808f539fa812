#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cycle/base_config.h"
#include "cycle/wheels_of_a_base.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using test::MapSettings;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const JointNames kJoints{"left_wheel_joint", "right_wheel_joint", "lift_joint"};

MapSettings robot() {
  return wheelsOfABase("left_wheel_joint", "right_wheel_joint");
}

std::string refusal(const MapSettings& settings) {
  return refusalOfABase(settings, kJoints);
}

TEST(BaseConfig, FindsTheDrivesOfTheWheels) {
  const auto base = readBaseConfig(robot(), kJoints);
  ASSERT_TRUE(base);
  EXPECT_EQ(std::vector<DriveIndex>{0}, base->left);
  EXPECT_EQ(std::vector<DriveIndex>{1}, base->right);
  EXPECT_EQ(0.5, base->geometry.wheel_separation);
  EXPECT_EQ(0.1, base->geometry.left_wheel_radius);
  EXPECT_EQ(0.1, base->geometry.right_wheel_radius);
  EXPECT_FALSE(base->limits.linear_x.has_velocity_limits);
}

TEST(BaseConfig, WithoutALeftWheelThereIsNoBase) {
  EXPECT_FALSE(readBaseConfig(MapSettings{"~"}, kJoints));
}

TEST(BaseConfig, TakesIntegersAsNumbersAndListsOfWheels) {
  auto settings = robot();
  settings.set("wheel_separation", 1).set("left_wheel", std::vector<std::string>{"left_wheel_joint", "lift_joint"});
  const auto base = readBaseConfig(settings, kJoints);
  EXPECT_EQ(1.0, base->geometry.wheel_separation);
  EXPECT_EQ((std::vector<DriveIndex>{0, 2}), base->left);
}

// As diff_drive_controller has it; the sides' own ones may be what dynamic_reconfigure left behind.
TEST(BaseConfig, AMultiplierForBothSidesWinsOverTheirOwn) {
  auto settings = robot();
  settings.set("left_wheel_radius_multiplier", 0.9).set("right_wheel_radius_multiplier", 1.2);
  const auto sides = readBaseConfig(settings, kJoints);
  EXPECT_EQ(0.9, sides->geometry.left_wheel_radius_multiplier);
  EXPECT_EQ(1.2, sides->geometry.right_wheel_radius_multiplier);
  const auto both = readBaseConfig(settings.set("wheel_radius_multiplier", 1.1), kJoints);
  EXPECT_EQ(1.1, both->geometry.left_wheel_radius_multiplier);
  EXPECT_EQ(1.1, both->geometry.right_wheel_radius_multiplier);
}

TEST(BaseConfig, ReadsTheLimitsOfBothAxes) {
  auto settings = robot();
  settings.set("linear/x/has_acceleration_limits", true).set("linear/x/max_acceleration", 0.5);
  settings.set("linear/x/min_acceleration", -0.7).set("angular/z/has_velocity_limits", true);
  settings.set("angular/z/max_velocity", 2);
  const auto base = readBaseConfig(settings, kJoints);
  EXPECT_EQ(-0.7, base->limits.linear_x.minAcceleration());
  EXPECT_EQ(-2.0, base->limits.angular_z.minVelocity());
}

TEST(BaseConfig, RefusalsNameKeyValueAndExpectation) {
  EXPECT_THAT(refusal(robot().erase("wheel_radius")), AllOf(HasSubstr("~wheel_radius"), HasSubstr("missing")));
  EXPECT_THAT(refusal(robot().set("wheel_radius", 0.0)), AllOf(HasSubstr("~wheel_radius: 0"), HasSubstr("0.001")));
  EXPECT_THAT(refusal(robot().set("wheel_separation", -0.5)), HasSubstr("~wheel_separation: -0.5"));
  EXPECT_THAT(refusal(robot().set("left_wheel", "wheel")), AllOf(HasSubstr("~left_wheel"), HasSubstr("\"wheel\"")));
  EXPECT_THAT(refusal(robot().set("right_wheel", "left_wheel_joint")), HasSubstr("only once"));
  EXPECT_THAT(refusal(robot().erase("right_wheel")), HasSubstr("~right_wheel is missing"));
  EXPECT_THAT(refusal(robot().erase("left_wheel")), HasSubstr("~left_wheel is missing"));
  for (const std::string key : {"left_wheel", "right_wheel"}) {
    EXPECT_EQ("~" + key + ": [] is not valid, expected the joint name of a drive, or a list of them",
              refusal(robot().set(key, std::vector<std::string>{})));
  }
  EXPECT_THAT(refusal(robot().set("wheel_separation", "wide")), HasSubstr("a number"));
  EXPECT_THAT(refusal(robot().set("linear/x/has_velocity_limits", true).set("linear/x/max_velocity", -1.0)),
              HasSubstr("linear/x/max_velocity"));
}

// A size may be typed in or drawn.
TEST(BaseConfig, AMissingSizeNamesTheUrdfAsTheOtherWay) {
  EXPECT_EQ(
      "~wheel_separation is missing: expected a number from 0.001 to 100 m, or the robot's URDF in robot_description, "
      "which it is taken from then",
      refusal(robot().erase("wheel_separation")));
}

TEST(BaseConfig, WarnsOfALimitThatIsNotSwitchedOn) {
  auto settings = robot();
  settings.set("linear/x/max_velocity", 1.0).set("angular/z/max_acceleration", 2.0);
  EXPECT_THAT(readBaseConfig(settings, kJoints)->warnings,
              ElementsAre("~linear/x/max_velocity limits nothing as long as ~linear/x/has_velocity_limits is not true",
                          "~angular/z/max_acceleration limits nothing as long as ~angular/z/has_acceleration_limits is "
                          "not true"));
  settings.set("linear/x/has_velocity_limits", false).set("angular/z/has_acceleration_limits", true);
  EXPECT_THAT(readBaseConfig(settings, kJoints)->warnings, IsEmpty()) << "said so";
}

/// Wheels of 0.2 m, 0.8 m apart; the right one may turn at 12 rad/s.
std::string description(const std::string& shape = "cylinder radius=\"0.2\" length=\"0.1\"") {
  const auto wheel = [&](const std::string& side, const std::string& y, const std::string& inside) {
    return "<link name=\"" + side + "\"><visual><geometry><" + shape + "/></geometry></visual></link><joint name=\"" +
           side + "_wheel_joint\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"" + side +
           "\"/><origin xyz=\"0 " + y + " 0\"/>" + inside + "</joint>";
  };
  return "<robot name=\"r\"><link name=\"base_link\"/>" + wheel("left", "0.4", "") +
         wheel("right", "-0.4", "<limit effort=\"1\" velocity=\"12\"/>") + "</robot>";
}

// What is not typed in comes from the URDF, the joints' limits too.
TEST(BaseConfig, TakesWhatIsMissingFromTheRobotDescription) {
  const auto base = readBaseConfig(robot().erase("wheel_separation").erase("wheel_radius"), kJoints, description());
  EXPECT_NEAR(0.8, base->geometry.wheel_separation, 1e-12);
  EXPECT_NEAR(0.2, base->geometry.left_wheel_radius, 1e-12);
  EXPECT_NEAR(0.2, base->geometry.right_wheel_radius, 1e-12);
  ASSERT_EQ(2u, base->joint_velocity_limits.size());
  EXPECT_TRUE(std::isinf(base->joint_velocity_limits[0]));
  EXPECT_EQ(12.0, base->joint_velocity_limits[1]);
}

// What is typed in wins, and then the description may say what it likes of it.
TEST(BaseConfig, WhatIsTypedInWins) {
  const auto base = readBaseConfig(robot(), kJoints, description("box size=\"1 1 1\""));
  EXPECT_EQ(0.5, base->geometry.wheel_separation);
  EXPECT_EQ(0.1, base->geometry.left_wheel_radius);
  EXPECT_EQ(0.1, base->geometry.right_wheel_radius);
}

TEST(BaseConfig, ARobotDescriptionThatCannotBeIsAConfigError) {
  const auto refusalWith = [](const MapSettings& settings, const std::string& urdf) {
    try {
      readBaseConfig(settings, kJoints, urdf);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusalWith(robot().erase("wheel_radius"), description("box size=\"1 1 1\"")), HasSubstr("a box"));
  EXPECT_THAT(refusalWith(robot().erase("wheel_radius"), "<robot"), HasSubstr("robot_description"));
}

// A description nothing is taken from may be of a part of the robot that knows nothing of our wheels; but nobody should
// believe that their limits are kept.
TEST(BaseConfig, ADescriptionWithoutOurWheelsDoesNotMatterWhenAllIsTypedIn) {
  const auto base = readBaseConfig(robot(), kJoints, "<robot name=\"arm\"><link name=\"base_link\"/></robot>");
  ASSERT_TRUE(base);
  EXPECT_TRUE(base->joint_velocity_limits.empty());
  EXPECT_EQ(0.5, base->geometry.wheel_separation);
  EXPECT_THAT(base->warnings, ElementsAre(HasSubstr("no joint \"left_wheel_joint\""),
                                          AllOf(HasSubstr("no joint \"right_wheel_joint\""),
                                                HasSubstr("no velocity limit is kept for it"))));
}

// A joint's limit is its own: no frame is asked for it.
TEST(BaseConfig, JointLimitsAreKeptWhateverTheBaseFrame) {
  const auto base = readBaseConfig(robot().set("base_frame_id", "base_footprint"), kJoints, description());
  EXPECT_EQ((std::vector<double>{std::numeric_limits<double>::infinity(), 12.0}), base->joint_velocity_limits);
  EXPECT_THAT(base->warnings, IsEmpty());
}

// One joint that cannot be read is named; the limits of the others are kept.
TEST(BaseConfig, ABadJointDoesNotTakeTheLimitsOfTheOthersAway) {
  const JointNames joints{"left_joint", "right_wheel_joint", "lift_joint"};
  const auto base = readBaseConfig(robot().set("left_wheel", "left_joint"), joints, description());
  EXPECT_EQ((std::vector<double>{std::numeric_limits<double>::infinity(), 12.0}), base->joint_velocity_limits);
  EXPECT_THAT(base->warnings, ElementsAre(HasSubstr("no joint \"left_joint\"")));
}

TEST(BaseConfig, ALimitOfZeroIsNamedWhenAllIsTypedIn) {
  std::string urdf = description();
  urdf.replace(urdf.find("velocity=\"12\""), 13, "velocity=\"0\"");
  const auto base = readBaseConfig(robot(), kJoints, urdf);
  EXPECT_TRUE(base->joint_velocity_limits.empty());
  EXPECT_THAT(base->warnings, ElementsAre(HasSubstr("velocity limit of joint \"right_wheel_joint\" is 0 rad/s")));
}

TEST(BaseConfig, ADescriptionThatIsNoneIsAWarningWhenAllIsTypedIn) {
  const auto base = readBaseConfig(robot(), kJoints, "<robot");
  EXPECT_THAT(base->warnings, ElementsAre(AllOf(HasSubstr("expected the XML of a URDF"),
                                                HasSubstr("no velocity limit of its joints is kept"))));
}

/// Wheels of 0.2 m that stand along x of base_link; `z` lifts the left one.
std::string turnedDescription(const std::string& left_x = "0.35", const std::string& z = "0") {
  const auto wheel = [](const std::string& name, const std::string& xyz) {
    return "<link name=\"" + name + "\"><collision><geometry><cylinder radius=\"0.2\" length=\"0.1\"/></geometry>" +
           "</collision></link><joint name=\"" + name + "_joint\" type=\"continuous\"><parent link=\"base_link\"/>" +
           "<child link=\"" + name + "\"/><origin xyz=\"" + xyz + "\"/></joint>";
  };
  return "<robot name=\"r\"><link name=\"base_link\"/>" + wheel("left_wheel", left_x + " 0 " + z) +
         wheel("right_wheel", "-0.35 0 0") + "</robot>";
}

// diff_drive_controller takes the distance of the wheel joints wherever they stand, and robots were drawn for it.
TEST(BaseConfig, TakesTheDistanceOfWheelsThatStandAlongX) {
  const MapSettings settings = robot().erase("wheel_separation");
  const auto base = readBaseConfig(settings, kJoints, turnedDescription());
  EXPECT_NEAR(0.7, base->geometry.wheel_separation, 1e-12);
  EXPECT_THAT(base->warnings, ElementsAre(AllOf(HasSubstr("\"left_wheel_joint\" and \"right_wheel_joint\""),
                                                HasSubstr("0.7 m"), HasSubstr("diff_drive_controller"))));
  EXPECT_NEAR(0.5, readBaseConfig(settings, kJoints, turnedDescription("-0.05", "0.4"))->geometry.wheel_separation,
              1e-12)
      << "the way between the joints, not only along x";
  try {
    readBaseConfig(settings, kJoints, turnedDescription("-0.35"));
    FAIL() << "wheels in one place";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("stand in one place"), HasSubstr("wheel_separation typed in")));
  }
}

// What crosses the direction of travel has no need of it, and no warning.
TEST(BaseConfig, WheelsThatStandAcrossXAreNotNamed) {
  const auto base = readBaseConfig(robot().erase("wheel_separation"), kJoints, description());
  EXPECT_THAT(base->warnings, IsEmpty());
}

// A mecanum base has an axle at the front: in line its wheels have neither separation nor wheel base.
TEST(BaseConfig, AMecanumBaseInLineIsRefused) {
  const JointNames joints{"left_wheel_joint", "rear_left", "right_wheel_joint", "rear_right"};
  MapSettings settings = robot().erase("wheel_separation");
  settings.set("base_type", "mecanum").set("wheel_base", 0.6);
  settings.set("left_wheel", std::vector<std::string>{"left_wheel_joint"})
      .set("right_wheel", std::vector<std::string>{"right_wheel_joint"});
  try {
    readBaseConfig(settings, joints, turnedDescription());
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("stand in line"));
  }
}

// Mecanum: four drives, a wheel base and limits of linear/y.
TEST(BaseConfig, ReadsAMecanumBase) {
  const JointNames joints{"fl", "rl", "fr", "rr"};
  MapSettings settings = robot();
  settings.set("base_type", "mecanum").set("wheel_base", 0.6);
  settings.set("left_wheel", std::vector<std::string>{"fl", "rl"})
      .set("right_wheel", std::vector<std::string>{"fr", "rr"});
  settings.set("linear/y/has_velocity_limits", true).set("linear/y/max_velocity", 0.3);
  const auto base = readBaseConfig(settings, joints);
  EXPECT_EQ(robot::BaseKind::kMecanum, base->kind);
  EXPECT_EQ(0.6, base->geometry.wheel_base);
  EXPECT_EQ(0.3, base->limits.linear_y.max_velocity);
  EXPECT_EQ((std::vector<DriveIndex>{0, 1, 2, 3}), base->wheels());
  EXPECT_THAT(refusal(robot().set("base_type", "mecanum").set("wheel_base", 0.6)), HasSubstr("two in each"));
  EXPECT_THAT(refusal(robot().set("base_type", "mecanum")), HasSubstr("~wheel_base is missing"));
  EXPECT_THAT(refusal(robot().set("base_type", "tricycle")), HasSubstr("differential, mecanum or steered"));
}

}  // namespace
}  // namespace nord_driver::cycle

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "cycle/base_config.h"
#include "cycle/cycle_config.h"
#include "robot/urdf_robots.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using test::MapSettings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const JointNames kJoints{"front_wheel_joint", "front_steering_joint", "rear_wheel_joint", "rear_steering_joint",
                         "lift_joint"};

/// Of the drives above: two position within 1.5 rad, the lift without a limit.
SteeringRanges ranges() {
  return {std::nullopt, SteeringRange{-1.5, 1.5}, std::nullopt, SteeringRange{-1.5, 1.4}, SteeringRange{}};
}

MapSettings robot() {
  MapSettings settings{"~"};
  settings.set("base_type", "steered").set("wheel_radius", 0.1);
  settings.set("steered/front/wheel_joint", "front_wheel_joint").set("steered/rear/wheel_joint", "rear_wheel_joint");
  settings.set("steered/front/steering_joint", "front_steering_joint");
  settings.set("steered/rear/steering_joint", "rear_steering_joint");
  settings.set("steered/front/x", 0.4).set("steered/front/y", 0.1);
  settings.set("steered/rear/x", -0.5).set("steered/rear/y", 0.0);
  return settings;
}

/// The sentence a configuration is refused with.
std::string refusal(const MapSettings& settings, const std::string& urdf = {}) {
  try {
    readBaseConfig(settings, kJoints, urdf, ranges());
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SteeredConfig, FindsDrivesPlacesAndRanges) {
  const auto base = readBaseConfig(robot(), kJoints, {}, ranges());
  ASSERT_TRUE(base && base->steered);
  EXPECT_EQ(robot::BaseKind::kSteered, base->kind);
  EXPECT_THAT(base->wheels(), ElementsAre(0, 2));
  EXPECT_THAT(base->steered->steering, ElementsAre(1, 3));
  EXPECT_THAT(base->drives(), ElementsAre(0, 2, 1, 3));
  ASSERT_EQ(2u, base->steered->axles.size());
  const robot::SteeredAxle& front = base->steered->axles[0];
  EXPECT_EQ(0.4, front.x);
  EXPECT_EQ(0.1, front.y);
  EXPECT_EQ(0.1, front.wheel_radius);
  EXPECT_EQ(-1.5, front.min_angle);
  EXPECT_EQ(1.4, base->steered->axles[1].max_angle);
  EXPECT_EQ(0.05, base->steered->angle_tolerance);
  EXPECT_TRUE(base->movesSideways());
  EXPECT_EQ(2u, base->kinematics()->wheelCount());
}

// The narrower range holds: what the drive does not take, the base must not ask for.
TEST(SteeredConfig, TheNarrowerRangeHolds) {
  auto settings = robot();
  settings.set("steered/front/min_angle", -1.0).set("steered/front/max_angle", 2.0);
  settings.set("wheel_radius_multiplier", 0.9).set("steered/angle_tolerance", 0.1);
  const auto base = readBaseConfig(settings, kJoints, {}, ranges());
  EXPECT_EQ(-1.0, base->steered->axles[0].min_angle);
  EXPECT_EQ(1.5, base->steered->axles[0].max_angle);
  EXPECT_DOUBLE_EQ(0.09, base->steered->axles[1].wheel_radius);
  EXPECT_EQ(0.1, base->steered->angle_tolerance);
}

TEST(SteeredConfig, ReadsTheLimitsOfThreeAxes) {
  auto settings = robot();
  settings.set("linear/y/has_velocity_limits", true).set("linear/y/max_velocity", 0.3);
  EXPECT_EQ(0.3, readBaseConfig(settings, kJoints, {}, ranges())->limits.linear_y.max_velocity);
}

TEST(SteeredConfig, RefusesInWords) {
  EXPECT_EQ("accepted", refusal(robot()));
  EXPECT_THAT(refusal(robot().set("left_wheel", "front_wheel_joint")), HasSubstr("none beside base_type: steered"));
  EXPECT_THAT(refusal(robot().erase("steered/front/wheel_joint")),
              HasSubstr("~steered/front/wheel_joint is missing: expected the `joint` of one of the drives"));
  EXPECT_THAT(
      refusal(robot().set("steered/rear/wheel_joint", "nobody")),
      HasSubstr("~steered/rear/wheel_joint: \"nobody\" is not valid, expected the `joint` of one of the drives"));
  EXPECT_THAT(refusal(robot().set("steered/rear/steering_joint", "front_steering_joint")),
              HasSubstr("every joint of the base only once"));
  EXPECT_THAT(refusal(robot().set("steered/rear/steering_joint", "rear_wheel_joint")),
              HasSubstr("every joint of the base only once"));
  auto swapped = robot();
  swapped.set("steered/rear/wheel_joint", "rear_steering_joint");
  swapped.set("steered/rear/steering_joint", "rear_wheel_joint");
  EXPECT_THAT(refusal(swapped), HasSubstr("the joint of a drive with mode: position"));
  EXPECT_THAT(refusal(robot().erase("steered/front/x")), HasSubstr("~steered/front/x is missing"));
  EXPECT_THAT(refusal(robot().set("steered/rear/steering_joint", "lift_joint")),
              HasSubstr("~steered/rear/min_angle is missing"));
  EXPECT_THAT(refusal(robot().set("steered/front/min_angle", 0.2)), HasSubstr("~steered/front/min_angle: 0.2"));
  EXPECT_THAT(refusal(robot().set("steered/rear/x", 0.4).set("steered/rear/y", 0.1)),
              HasSubstr("stands where axle 1 stands"));
  EXPECT_THAT(refusal(robot().set("limit_axes_independently", true)),
              HasSubstr("~limit_axes_independently: true is not valid, expected false with base_type: steered"));
  EXPECT_THAT(refusal(robot().set("steered/angle_tolerance", 0.0)), HasSubstr("~steered/angle_tolerance: 0"));
}

std::string urdf(const std::string& axis = "0 0 1", const std::string& wheel_at = "0 0 0") {
  using namespace robot;
  const auto axle = [&](const std::string& name, const std::string& at) {
    std::string joint =
        urdfJoint(name + "_steering_joint", "revolute", "base_link", name + "_fork", "xyz=\"" + at + "\"",
                  "<limit lower=\"-1\" upper=\"1\" velocity=\"2\" effort=\"9\"/>");
    joint.replace(joint.find("0 1 0"), 5, axis);
    std::string wheel = urdfWheel(name + "_wheel", wheel_at, name + "_fork", urdfShape("collision", kCylinder),
                                  "<limit velocity=\"7\" effort=\"9\"/>");
    return urdfLink(name + "_fork") + joint + wheel;
  };
  return urdfRobot(urdfLink("base_link") + axle("front", "0.45 0 0.1") + axle("rear", "-0.35 0 0.1"));
}

MapSettings bare() {
  return robot().erase("steered/front/x").erase("steered/front/y").erase("steered/rear/x").erase("wheel_radius");
}

// What is not typed in comes from the description: where the wheels stand, their radius, how fast their joints may turn.
TEST(SteeredConfig, TakesSizesFromTheDescription) {
  const auto base = readBaseConfig(bare(), kJoints, urdf(), ranges());
  EXPECT_DOUBLE_EQ(0.45, base->steered->axles[0].x);
  EXPECT_DOUBLE_EQ(0.0, base->steered->axles[0].y);
  EXPECT_DOUBLE_EQ(-0.35, base->steered->axles[1].x);
  EXPECT_DOUBLE_EQ(0.1, base->steered->axles[1].wheel_radius);
  EXPECT_THAT(base->joint_velocity_limits, ElementsAre(7.0, 7.0));
  EXPECT_THAT(readBaseConfig(robot(), kJoints, urdf(), ranges())->joint_velocity_limits, ElementsAre(7.0, 7.0));
}

TEST(SteeredConfig, RefusesADescriptionThatCannotBe) {
  EXPECT_EQ("accepted", refusal(bare(), urdf()));
  EXPECT_THAT(refusal(bare(), urdf("0 0 -1")), HasSubstr("expected 0 0 1: a steering angle grows counter-clockwise"));
  EXPECT_THAT(refusal(bare(), urdf("0 1 0")), HasSubstr("expected 0 0 1"));
  EXPECT_THAT(refusal(bare(), urdf("0 0 1", "0.02 0 0")), HasSubstr("stands 0.02 m beside the axis of joint"));
  auto crossed = bare();
  crossed.set("steered/front/steering_joint", "rear_steering_joint");
  crossed.set("steered/rear/steering_joint", "front_steering_joint");
  EXPECT_THAT(refusal(crossed, urdf()), HasSubstr("does not carry joint"));
}

// A steering drive's own limits hold for the base: what it does not take must not be asked for. In m they are none.
TEST(SteeredConfig, TheLimitsOfADriveThatTurnsAreASteeringRange) {
  std::vector<DriveSettings> drives;
  const auto add = [&drives](const std::string& name) {
    auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
    settings->set("series", "sk5xxe").set("pole_pairs", 2).set("joint", name + "_joint");
    drives.push_back({name, settings});
    return settings;
  };
  for (const char* const wheel : {"front_wheel", "rear_wheel"}) add(wheel);
  add("rear_steering")->set("mode", "position").set("position/lower", -1.2).set("position/upper", 1.1);
  const auto front = add("front_steering");
  front->set("mode", "position").set("position/lower", -0.7).set("position/upper", 0.8);
  const CycleConfig config = readCycleConfig(robot(), drives);
  ASSERT_TRUE(config.base && config.base->steered);
  EXPECT_EQ(-0.7, config.base->steered->axles[0].min_angle);
  EXPECT_EQ(0.8, config.base->steered->axles[0].max_angle);
  EXPECT_EQ(-1.2, config.base->steered->axles[1].min_angle);
  front->set("lead", 0.2);
  EXPECT_THROW(readCycleConfig(robot(), drives), ConfigError) << "it does not turn";
}

}  // namespace
}  // namespace nord_driver::cycle

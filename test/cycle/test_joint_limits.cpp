// Limits of a drive that belongs to no base: what may be written, and what is said of the rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_config.h"
#include "cycle/joint_limits.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

MapSettings lift() {
  return MapSettings{"~drives/lift/", {{"series", "sk5xxe"}, {"pole_pairs", 2}, {"joint", "lift_joint"}}};
}

template <typename Read>
std::string refusalOf(Read read) {
  try {
    read();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const MapSettings& settings) {
  return refusalOf([&] { readJointLimits(settings); });
}

TEST(JointLimits, NoneIsGivenAndNoneHolds) {
  const robot::SpeedLimits limits = readJointLimits(lift());
  EXPECT_FALSE(limits.has_velocity_limits);
  EXPECT_FALSE(limits.has_acceleration_limits);
  EXPECT_FALSE(limits.has_jerk_limits);
}

TEST(JointLimits, OneThatIsGivenHoldsBothWays) {
  const robot::SpeedLimits limits = readJointLimits(lift().set("max_velocity", 6).set("max_acceleration", 3.0));
  EXPECT_TRUE(limits.has_velocity_limits);
  EXPECT_DOUBLE_EQ(6.0, limits.max_velocity);
  EXPECT_DOUBLE_EQ(-6.0, limits.minVelocity());
  EXPECT_TRUE(limits.has_acceleration_limits);
  EXPECT_DOUBLE_EQ(-3.0, limits.minAcceleration());
  EXPECT_FALSE(limits.has_jerk_limits);
}

TEST(JointLimits, EachWayMayHaveItsOwn) {
  const robot::SpeedLimits limits = readJointLimits(lift()
                                                        .set("max_velocity", 6.0)
                                                        .set("min_velocity", 0.0)
                                                        .set("max_acceleration", 3.0)
                                                        .set("min_acceleration", -4.0)
                                                        .set("max_jerk", 20.0)
                                                        .set("min_jerk", -30.0));
  EXPECT_DOUBLE_EQ(0.0, limits.minVelocity()) << "it does not turn backward";
  EXPECT_DOUBLE_EQ(-4.0, limits.minAcceleration());
  EXPECT_TRUE(limits.has_jerk_limits);
  EXPECT_DOUBLE_EQ(-30.0, limits.minJerk());
}

TEST(JointLimits, WhatCannotBeIsNamed) {
  EXPECT_THAT(refusal(lift().set("max_velocity", -6.0)),
              AllOf(HasSubstr("~drives/lift/max_velocity: -6 is not valid"), HasSubstr("0.001 to 10000 rad/s")));
  EXPECT_THAT(refusal(lift().set("max_acceleration", 0.0)), HasSubstr("~drives/lift/max_acceleration: 0 is not valid"));
  EXPECT_THAT(refusal(lift().set("max_acceleration", 3.0).set("min_acceleration", 3.0)),
              AllOf(HasSubstr("~drives/lift/min_acceleration: 3 is not valid"), HasSubstr("-0.001 rad/s^2")));
  EXPECT_THAT(refusal(lift().set("min_velocity", -1.0)), HasSubstr("~drives/lift/max_velocity is missing"));
  EXPECT_THAT(refusal(lift().set("max_jerk", "fast")), HasSubstr("~drives/lift/max_jerk"));
}

// It may be forbidden to turn backward, and then stands; but it has to be able to brake, and to end its acceleration.
TEST(JointLimits, OnlyTheVelocityMayBeZeroTheOtherWay) {
  EXPECT_THAT(refusal(lift().set("max_velocity", 6.0).set("min_velocity", 0.5)),
              HasSubstr("~drives/lift/min_velocity: 0.5 is not valid"));
  for (const std::string limit : {"acceleration", "jerk"}) {
    EXPECT_THAT(refusal(lift().set("max_" + limit, 6.0).set("min_" + limit, 0.0)),
                HasSubstr("~drives/lift/min_" + limit + ": 0 is not valid"));
  }
}

// A limit that would limit nothing looks like one that does.
TEST(JointLimits, ADriveOfTheBaseHasNone) {
  MapSettings node{
      "~", {{"left_wheel", "left"}, {"right_wheel", "right"}, {"wheel_separation", 0.5}, {"wheel_radius", 0.1}}};
  std::vector<DriveSettings> drives;
  for (const char* name : {"left", "right", "lift"}) {
    drives.push_back({name, std::make_shared<MapSettings>(MapSettings{std::string("~drives/") + name + "/"}
                                                              .set("series", "sk5xxe")
                                                              .set("pole_pairs", 2)
                                                              .set("joint", name)
                                                              .set("max_acceleration", 3.0))});
  }
  EXPECT_EQ(
      "~drives/left/max_acceleration: 3 is not valid, expected none: this drive belongs to the base, whose limits "
      "are those of linear/x and angular/z",
      refusalOf([&] { readCycleConfig(node, drives); }));
  for (const char* key : {"left_wheel", "right_wheel"}) node.erase(key);
  EXPECT_DOUBLE_EQ(3.0, readCycleConfig(node, drives).drives[2].limits.max_acceleration);
}

}  // namespace
}  // namespace nord_driver::cycle

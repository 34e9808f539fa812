// The values a configuration of a base may have, which of them hold where none is written, and what is told of each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/base_config.h"
#include "cycle/listening_settings.h"
#include "cycle/wheels_of_a_base.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using test::MapSettings;
using ::testing::HasSubstr;

const JointNames kJoints{"left", "right", "third"};

MapSettings robot() {
  return wheelsOfABase("left", "right");
}

std::string refusal(const MapSettings& settings) {
  return refusalOfABase(settings, kJoints);
}

TEST(BaseValues, HoldWhereNothingIsWritten) {
  const auto base = readBaseConfig(robot(), kJoints);
  EXPECT_EQ(1.0, base->geometry.wheel_separation_multiplier);
  EXPECT_EQ(1.0, base->geometry.left_wheel_radius_multiplier);
  EXPECT_EQ(1.0, base->geometry.right_wheel_radius_multiplier);
  EXPECT_FALSE(base->open_loop) << "the pose is what was measured";
  EXPECT_EQ(10u, base->velocity_rolling_window_size);
}

TEST(BaseValues, AMultiplierIsFromAHundredthToAHundred) {
  for (const char* const key : {"wheel_separation_multiplier", "left_wheel_radius_multiplier",
                                "right_wheel_radius_multiplier", "wheel_radius_multiplier"}) {
    for (const double good : {0.01, 100.0}) EXPECT_EQ("accepted", refusal(robot().set(key, good))) << key;
    for (const double bad : {0.009, 101.0}) EXPECT_THAT(refusal(robot().set(key, bad)), HasSubstr(key));
  }
}

TEST(BaseValues, AWindowIsFromOneToTenThousand) {
  const char* const key = "velocity_rolling_window_size";
  for (const int good : {1, 10'000}) EXPECT_EQ("accepted", refusal(robot().set(key, good)));
  for (const int bad : {0, 10'001}) EXPECT_THAT(refusal(robot().set(key, bad)), HasSubstr(key));
}

// Of a list of wheels each one counts, wherever it stands.
TEST(BaseValues, AWheelBelongsToOneSide) {
  EXPECT_EQ("~right_wheel: \"left\" is not valid, expected every wheel joint only once",
            refusal(robot().set("left_wheel", std::vector<std::string>{"left", "third"}).set("right_wheel", "left")));
}

// Who switches a limit on and does not say which is told so: nothing is put in its place.
TEST(BaseValues, ALimitThatIsSwitchedOnHasToBeWritten) {
  for (const std::string limit : {"velocity", "acceleration", "jerk"}) {
    auto settings = robot().set("linear/x/has_acceleration_limits", true).set("linear/x/max_acceleration", 1.0);
    settings.erase("linear/x/max_" + limit).set("linear/x/has_" + limit + "_limits", true);
    EXPECT_THAT(refusal(settings), HasSubstr("linear/x/max_" + limit)) << limit;
  }
}

TEST(BaseValues, EachLimitMayBeAnotherOneTheOtherWay) {
  auto settings = robot();
  double value = 1.0;
  for (const std::string limit : {"velocity", "acceleration", "jerk"}) {
    settings.set("angular/z/has_" + limit + "_limits", true).set("angular/z/max_" + limit, value);
    settings.set("angular/z/min_" + limit, -value - 0.5);
    value += 1.0;
  }
  const auto base = readBaseConfig(settings, kJoints);
  EXPECT_EQ(-1.5, base->limits.angular_z.minVelocity());
  EXPECT_EQ(-2.5, base->limits.angular_z.minAcceleration());
  EXPECT_EQ(-3.5, base->limits.angular_z.minJerk());
}

/// Wheels and steering axes of drives that position without limits of their own.
MapSettings steered() {
  MapSettings settings{"~"};
  settings.set("base_type", "steered").set("wheel_radius", 0.1);
  for (const std::string axle : {"front", "rear"}) {
    settings.set("steered/" + axle + "/wheel_joint", axle + "_wheel");
    settings.set("steered/" + axle + "/steering_joint", axle + "_steering");
    settings.set("steered/" + axle + "/x", axle == "front" ? 0.4 : -0.4).set("steered/" + axle + "/y", 0.0);
    settings.set("steered/" + axle + "/min_angle", -1.0).set("steered/" + axle + "/max_angle", 1.0);
  }
  return settings;
}

std::optional<BaseConfig> readSteered(const Settings& settings) {
  return readBaseConfig(settings, {"front_wheel", "rear_wheel", "front_steering", "rear_steering"}, {},
                        {std::nullopt, std::nullopt, SteeringRange{}, SteeringRange{}});
}

std::string steeredRefusal(const char* key, double value) {
  try {
    readSteered(steered().set(key, value));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SteeredValues, HaveTheirRanges) {
  struct Range {
    const char* key;
    double low, high;
    double beyond;  ///< how far is too far
  };
  // Three turns are 18.8496 rad.
  for (const Range& range :
       {Range{"steered/front/x", -100.0, 100.0, 1.0}, Range{"steered/rear/y", -100.0, 100.0, 1.0},
        Range{"steered/front/min_angle", -18.849, 0.0, 0.01}, Range{"steered/front/max_angle", 0.0, 18.849, 0.01},
        Range{"steered/angle_tolerance", 0.001, 0.5, 0.0001}}) {
    for (const double good : {range.low, range.high}) {
      EXPECT_EQ("accepted", steeredRefusal(range.key, good)) << range.key << " " << good;
    }
    for (const double bad : {range.low - range.beyond, range.high + range.beyond}) {
      EXPECT_THAT(steeredRefusal(range.key, bad), HasSubstr(std::string("~") + range.key + ": ")) << bad;
    }
  }
}

// What the list of all parameters is made of.
TEST(SteeredValues, AreToldToWhoeverListens) {
  const ListeningSettings settings{steered().set("wheel_radius_multiplier", 1.1)};
  ASSERT_TRUE(readSteered(settings));
  for (const std::string axle : {"steered/front/", "steered/rear/"}) {
    EXPECT_EQ("a text", settings.noteOf(axle + "wheel_joint"));
    EXPECT_EQ("a text", settings.noteOf(axle + "steering_joint"));
    EXPECT_EQ("a number, -100 to 100 m", settings.noteOf(axle + "x"));
    EXPECT_EQ("a number, -18.8496 to 0 rad", settings.noteOf(axle + "min_angle"));
    EXPECT_EQ("a number, 0 to 18.8496 rad", settings.noteOf(axle + "max_angle"));
  }
  EXPECT_EQ("a number, 0.001 to 0.5 rad, default 0.05", settings.noteOf("steered/angle_tolerance"));
}

// A key that is missing is one of those a list has to name.
TEST(SteeredValues, AreToldWhereTheyAreMissing) {
  for (const std::string key : {"steered/front/x", "steered/front/min_angle"}) {
    const ListeningSettings settings{steered().erase(key)};
    EXPECT_THROW(readSteered(settings), ConfigError);
    EXPECT_EQ(key == "steered/front/x" ? "a number, -100 to 100 m" : "a number, -18.8496 to 0 rad",
              settings.noteOf(key));
  }
}

TEST(BaseValues, AreToldToWhoeverListens) {
  const ListeningSettings settings{robot().set("wheel_radius_multiplier", 1.1)};
  ASSERT_TRUE(readBaseConfig(settings, kJoints));
  for (const char* const key : {"wheel_separation_multiplier", "wheel_radius_multiplier"}) {
    EXPECT_EQ("a number, 0.01 to 100, default 1", settings.noteOf(key)) << key;
  }
}

}  // namespace
}  // namespace nord_driver::cycle

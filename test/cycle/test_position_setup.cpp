// `mode: position` as users write it: what is taken, and what is refused with its key.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cycle/position_configuration.h"

namespace nord_driver::cycle {
namespace {

using ::testing::HasSubstr;

constexpr const char* kRobot = R"(<robot name="lift">
  <link name="base_link"/><link name="platform"/><link name="mast"/>
  <joint name="lift_joint" type="prismatic"><parent link="base_link"/><child link="platform"/>
    <limit lower="0.1" upper="2.0" effort="1" velocity="1"/></joint>
  <joint name="mast_joint" type="continuous"><parent link="base_link"/><child link="mast"/></joint>
</robot>)";

TEST_F(PositionConfiguration, IsRadiansWithoutALead) {
  const PositionSetup turning = setup();
  EXPECT_NEAR(20.0 / (2.0 * 3.14159265358979), turning.axis.scale.revolutions_per_unit, 1e-12);
  EXPECT_DOUBLE_EQ(1.0, turning.axis.unit_per_radian);
  EXPECT_EQ(32, turning.bits);
  EXPECT_FALSE(turning.axis.lower || turning.axis.upper || turning.axis.speed || turning.home);
  drive_->set("lead", 0.2).set("inverted", true).set("position/speed", 0.3);
  const PositionSetup lift = setup();
  EXPECT_DOUBLE_EQ(-100.0, lift.axis.scale.revolutions_per_unit);
  EXPECT_NEAR(0.3 / 0.2 * 2.0 * 3.14159265358979, lift.axis.speed->value, 1e-9);
  EXPECT_NEAR(0.0001, lift.axis.tolerance, 1e-12) << "0.01 revolutions";
  EXPECT_DOUBLE_EQ(1.0, lift.axis.revolutions_per_motor_turn) << "what the motor turns is counted";
  drive_->set("position/gear_ratio", 40.0);
  EXPECT_DOUBLE_EQ(2.0, setup().axis.revolutions_per_motor_turn);
}

TEST_F(PositionConfiguration, TakesTheNarrowerLimits) {
  drive_->set("lead", 0.2).set("position/lower", 0.5).set("position/upper", 3.0);
  const PositionSetup lift = setup(kRobot);
  EXPECT_EQ(0.5, lift.axis.lower);
  EXPECT_EQ(2.0, lift.axis.upper) << "of the robot's description";
}

TEST_F(PositionConfiguration, TakesLimitsOfAMillion) {
  drive_->set("position/lower", -1e6).set("position/upper", 1e6);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/lower", -1.000001e6);
  EXPECT_THAT(refusal(), HasSubstr("position/lower"));
  drive_->set("position/lower", -1e6).set("position/upper", 1.000001e6);
  EXPECT_THAT(refusal(), HasSubstr("position/upper"));
}

TEST_F(PositionConfiguration, RefusesWhatDoesNotFit) {
  EXPECT_THAT(refusal(kRobot), HasSubstr("~drives/lift/lead is missing: expected m per revolution"));
  drive_->set("joint", "mast_joint").set("lead", 0.2);
  EXPECT_THAT(refusal(kRobot), HasSubstr("in robot_description this joint turns"));
  drive_->set("position/lower", 1.0).set("position/upper", 0.5);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/upper"));
  drive_->set("position/upper", 1.0);
  EXPECT_THAT(refusal(), HasSubstr("more than the lower limit, 1")) << "nowhere to go";
  drive_->set("position/upper", 2.0).set("max_velocity", 1.0);
  EXPECT_THAT(refusal(), HasSubstr("position/speed"));
}

TEST_F(PositionConfiguration, CountsAtLeastOneStepInARevolution) {
  drive_->set("position/steps_per_revolution", 1.0);
  EXPECT_EQ(1.0, setup().axis.scale.steps_per_revolution);
  drive_->set("position/steps_per_revolution", 0.99);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/steps_per_revolution"));
}

TEST_F(PositionConfiguration, RefusesSeriesThatDoNotPosition) {
  for (const char* series : {"sk300e", "sk1x0e"}) {
    drive_->set("series", series);
    EXPECT_THAT(refusal(), HasSubstr("do not position")) << series;
  }
}

TEST_F(PositionConfiguration, IsNoWheel) {
  auto other = std::make_shared<test::MapSettings>("~drives/other/");
  other->set("address", 4).set("series", "sk5xxe").set("joint", "other_joint").set("pole_pairs", 2);
  node_.set("left_wheel", "lift_joint").set("right_wheel", "other_joint");
  node_.set("wheel_separation", 0.5).set("wheel_radius", 0.1);
  try {
    readCycleConfig(node_, {{"lift", drive_}, {"other", other}});
    FAIL() << "taken";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("~drives/lift/mode"));
    EXPECT_THAT(error.what(), HasSubstr("is a wheel of the base"));
  }
}

// It follows a fresh velocity command, and a single drive that positions has none: always 0, it would only forbid enabling.
TEST_F(PositionConfiguration, RefusesASetpointThatTurnsTheMotor) {
  drive_->set("setpoints/push/function", "torque_precontrol").set("setpoints/push/limit", 20.0);
  EXPECT_EQ(
      "~drives/lift/setpoints/push/function: \"torque_precontrol\" is not valid, expected one that turns no motor: a "
      "drive "
      "with mode: position has no velocity command",
      refusal());
  EXPECT_NO_THROW(readCycleConfig(node_, {{"lift", drive_}}, {}, false))
      << "what reads no base knows of none it steers";
  drive_->erase("setpoints/push/limit").set("setpoints/push/function", "torque_limit");
  EXPECT_EQ("taken", refusal());
}

// A steering drive follows what the base follows.
TEST_F(PositionConfiguration, TakesASetpointThatTurnsTheMotorOfASteeringDrive) {
  std::vector<DriveSettings> drives;
  for (const std::string axle : {"front", "rear"}) {
    for (const std::string kind : {"wheel", "steering"}) {
      const std::string name = axle + "_" + kind;
      auto drive = std::make_shared<test::MapSettings>("~drives/" + name + "/");
      drive->set("address", 3 + static_cast<int>(drives.size())).set("series", "sk5xxe").set("pole_pairs", 2);
      drive->set("joint", name + "_joint");
      if (kind == "steering") {
        drive->set("mode", "position").set("position/lower", -1.5).set("position/upper", 1.5);
        drive->set("setpoints/push/function", "torque_precontrol").set("setpoints/push/limit", 20.0);
      }
      node_.set("steered/" + axle + "/" + kind + "_joint", name + "_joint");
      drives.push_back({name, drive});
    }
    node_.set("steered/" + axle + "/x", axle == "front" ? 0.4 : -0.5).set("steered/" + axle + "/y", 0.0);
  }
  node_.set("base_type", "steered").set("wheel_radius", 0.1);
  EXPECT_EQ(1u, readCycleConfig(node_, drives).drives[1].words.setpoints.size());
}

TEST_F(PositionConfiguration, RefusesALeadWithoutTheMode) {
  drive_->set("mode", "velocity").set("lead", 0.2);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/lead"));
}

TEST_F(PositionConfiguration, NeedsWordsTheBusCarries) {
  const auto carried = [&](std::uint8_t values) {
    DriveIdentity identity;
    identity.process_values = values;
    const CycleConfig config = read();
    try {
      checkPositionCarried(*drive_, *config.drives[0].position, config.drives[0].series, identity);
    } catch (const ConfigError& error) {
      return std::string{error.what()};
    }
    return std::string{"taken"};
  };
  EXPECT_EQ("taken", carried(3));
  EXPECT_EQ("taken", carried(2));
  EXPECT_THAT(carried(1), HasSubstr("~drives/lift/position/bits"));
  drive_->set("position/bits", 16);
  EXPECT_EQ("taken", carried(1));
  drive_->set("position/bits", 32).set("series", "sk700e");
  EXPECT_THAT(carried(2), HasSubstr("need 3 setpoints"));
}

// Its one word is a speed: 16 bits of position in steps would be rpm, and the motor would turn for ever.
TEST_F(PositionConfiguration, NeedsAProfileWithWordsForAPosition) {
  DriveIdentity identity;
  identity.process_values = 1;
  identity.nord_profile = false;
  for (const int bits : {16, 32}) {
    drive_->set("position/bits", bits);
    const CycleConfig config = read();
    try {
      checkPositionCarried(*drive_, *config.drives[0].position, config.drives[0].series, identity);
      ADD_FAILURE() << bits << " bits are taken";
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("~drives/lift/mode: \"position\" is not valid, expected velocity: the profile "
                            "of this drive carries a speed, no position"));
    }
  }
}

// One end only is a limit as well.
TEST_F(PositionConfiguration, TakesOneLimitWithoutTheOther) {
  drive_->set("position/lower", 0.5);
  EXPECT_EQ(0.5, setup().axis.lower);
  EXPECT_FALSE(setup().axis.upper);
  drive_->erase("position/lower").set("position/upper", -0.5);
  EXPECT_EQ(-0.5, setup().axis.upper);
  EXPECT_FALSE(setup().axis.lower);
}

TEST_F(PositionConfiguration, TakesTheLimitsOfTheDescriptionWhereNoneAreTyped) {
  drive_->set("lead", 0.2);
  EXPECT_EQ(0.1, setup(kRobot).axis.lower);
  EXPECT_EQ(2.0, setup(kRobot).axis.upper);
}

TEST_F(PositionConfiguration, CountsAsItIsToldTo) {
  EXPECT_EQ(0.0, setup().axis.scale.offset);
  EXPECT_EQ(profile::FieldOrder::kHighFirst, setup().order);
  drive_->set("position/word_order", "low_first").set("position/offset", -0.25);
  EXPECT_EQ(-0.25, setup().axis.scale.offset);
  EXPECT_EQ(profile::FieldOrder::kLowFirst, setup().order);
}

TEST_F(PositionConfiguration, GivesAReferenceRunAMinuteUnlessItIsToldOtherwise) {
  EXPECT_EQ(std::chrono::seconds{60}, setup().axis.homing_timeout);
}

// The ends of each range are in it, and what is beyond is not.
TEST_F(PositionConfiguration, RefusesNumbersBeyondTheirRanges) {
  struct Range {
    const char* key;
    double least, most;
  };
  for (const Range& range :
       {Range{"lead", 1e-6, 1e3}, Range{"position/offset", -1e6, 1e6}, Range{"position/steps_per_revolution", 1.0, 1e6},
        Range{"position/homing_timeout", 0.1, 3600.0}}) {
    for (const double inside : {range.least, range.most}) {
      drive_->set(range.key, inside);
      EXPECT_EQ("taken", refusal()) << range.key << ": " << inside;
    }
    const double step = 1e-6 * (range.most - range.least);
    drive_->set(range.key, range.most + step);
    EXPECT_THAT(refusal(), HasSubstr(std::string("~drives/lift/") + range.key));
    drive_->set(range.key, range.least - std::min(step, 0.01 * std::abs(range.least)));
    EXPECT_THAT(refusal(), HasSubstr(std::string("~drives/lift/") + range.key));
    drive_->erase(range.key);
  }
  drive_->set("position/gear_ratio", 1e6);
  EXPECT_EQ("taken", refusal());
  drive_->set("position/gear_ratio", 1.000001e6);
  EXPECT_THAT(refusal(), HasSubstr("~drives/lift/position/gear_ratio"));
}

}  // namespace
}  // namespace nord_driver::cycle

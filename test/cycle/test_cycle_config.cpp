// The configuration of the cycle: defaults, and refusals that name key, value and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_config.h"
#include "support/map_settings.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;
using test::MapSettings;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::shared_ptr<MapSettings> drive(const std::string& name) {
  auto settings = std::make_shared<MapSettings>("~drives/" + name + "/");
  settings->set("series", "sk5xxe").set("pole_pairs", 2).set("joint", name + "_joint");
  return settings;
}

struct Configured {
  MapSettings node{"~", {}};
  std::shared_ptr<MapSettings> left = drive("left");
  std::shared_ptr<MapSettings> right = drive("right");
  std::vector<DriveSettings> drives{{"left", left}, {"right", right}};

  CycleConfig read() const { return readCycleConfig(node, drives); }
  std::string refusal() const {
    try {
      readCycleConfig(node, drives);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST(CycleConfigTest, HasItsDefaults) {
  const CycleConfig config = Configured{}.read();
  EXPECT_DOUBLE_EQ(100.0, config.cycle_rate);
  EXPECT_EQ(milliseconds{10}, config.period());
  EXPECT_EQ(milliseconds{500}, config.cmd_vel_timeout);
  EXPECT_EQ(milliseconds{3000}, config.service_timeout);
  EXPECT_EQ(milliseconds{10'000}, config.shutdown_timeout);
  EXPECT_EQ(0, config.real_time.priority);
  EXPECT_FALSE(config.real_time.lock_memory);
  EXPECT_FALSE(config.base.has_value());
  ASSERT_EQ(2u, config.drives.size());
  EXPECT_DOUBLE_EQ(1.0, config.drives[0].drive.joint.gear_ratio);
  EXPECT_FALSE(config.drives[0].drive.joint.inverted);
  EXPECT_EQ(milliseconds{3000}, config.drives[0].drive.enable_timeout);
  EXPECT_EQ(milliseconds{10'000}, config.drives[0].drive.shutdown_timeout);
}

// Teaching holds its bits for 0.4 s: however short a service may wait, the run has its own time.
TEST(CycleConfigTest, ASetUpRunIsNotCutShortByTheServices) {
  Configured robot;
  robot.node.set("service_timeout", 0.4);
  const CycleConfig config = robot.read();
  EXPECT_EQ(milliseconds{400}, config.drives[0].drive.enable_timeout);
  EXPECT_EQ(milliseconds{2000}, config.drives[0].drive.setup_timeout);
}

// Teaching needs eight answers.
TEST(CycleConfigTest, ASetUpRunHasTenCyclesAtLeast) {
  Configured robot;
  EXPECT_EQ(milliseconds{2000}, robot.read().setupTimeout(robot.read().drives[0]));
  robot.node.set("cycle_rate", 2);
  EXPECT_EQ(milliseconds{5000}, robot.read().setupTimeout(robot.read().drives[0]));
}

// What stops how, by a word each; the torque is never kept on behind "disabled".
TEST(CycleConfigTest, TheWayOfEachStopIsAWord) {
  Configured robot;
  EXPECT_EQ(drive::StopWay::kSetpointZero, robot.read().stop_ways.command_timeout);
  EXPECT_EQ(drive::StopWay::kOff1, robot.read().stop_ways.disable);
  EXPECT_EQ(drive::StopWay::kSetpointZero, robot.read().stop_ways.drive_stopped);
  robot.node.set("stop/command_timeout", "off1").set("stop/disable", "coast").set("stop/drive_stopped", "quick_stop");
  EXPECT_EQ(drive::StopWay::kOff1, robot.read().stop_ways.command_timeout);
  EXPECT_EQ(drive::StopWay::kCoast, robot.read().stop_ways.disable);
  EXPECT_EQ(drive::StopWay::kQuickStop, robot.read().stop_ways.drive_stopped);
  robot.node.set("stop/disable", "setpoint_zero");
  EXPECT_THAT(robot.refusal(),
              AllOf(HasSubstr("~stop/disable: \"setpoint_zero\""), HasSubstr("expected off1, quick_stop or coast")));
}

// Three cycles, at least 50 ms.
TEST(CycleConfigTest, DriveTimeoutFollowsTheCycle) {
  Configured robot;
  EXPECT_EQ(milliseconds{50}, robot.read().drives[0].drive.drive_timeout);
  robot.node.set("cycle_rate", 10);
  EXPECT_EQ(milliseconds{300}, robot.read().drives[0].drive.drive_timeout);
  robot.node.set("drive_timeout", 0.4);
  EXPECT_EQ(milliseconds{400}, robot.read().drives[0].drive.drive_timeout);
}

// P105 decides what a setpoint means; a typed value that was not held against it may not.
TEST(CycleConfigTest, ATypedMaxFrequencyIsNotYetTheDrives) {
  Configured robot;
  robot.left->set("max_frequency", 70);
  const CycleConfig config = robot.read();
  EXPECT_DOUBLE_EQ(70.0, config.drives[0].typed_max_frequency.value());
  EXPECT_FALSE(config.drives[0].drive.max_frequency[0].has_value());
  EXPECT_FALSE(config.drives[1].typed_max_frequency.has_value());
}

// What stands in a drive's group is what the drive works by.
TEST(CycleConfigTest, EachDriveHasWhatItsGroupSays) {
  Configured robot;
  robot.node.set("shutdown_timeout", 4.5);
  robot.right->set("address", 7).set("rated_current", 3.5).set("gear_ratio", 20.5).set("inverted", true);
  robot.right->set("pole_pairs", 3).set("allow_minimum_frequency", true);
  const CycleConfig config = robot.read();
  const DriveSetup& right = config.drives.at(1);
  EXPECT_EQ(7, right.address);
  EXPECT_EQ(3.5, right.rated_current);
  EXPECT_EQ(20.5, right.drive.joint.gear_ratio);
  EXPECT_TRUE(right.drive.joint.inverted);
  EXPECT_EQ(3, right.drive.joint.pole_pairs);
  EXPECT_TRUE(right.drive.allow_minimum_frequency);
  EXPECT_FALSE(config.drives.at(0).drive.allow_minimum_frequency) << "nobody has accepted it";
  EXPECT_EQ(milliseconds{4500}, right.drive.shutdown_timeout);
}

// A drive that positions does so by its own scale and limits.
TEST(CycleConfigTest, ADriveThatPositionsHasItsAxis) {
  Configured robot;
  robot.right->set("mode", "position").set("position/lower", -1.5).set("gear_ratio", 20.0);
  const CycleConfig config = robot.read();
  ASSERT_TRUE(config.drives.at(1).drive.position);
  EXPECT_EQ(-1.5, config.drives[1].drive.position->lower);
  EXPECT_EQ(config.drives[1].position->axis.scale.revolutions_per_unit,
            config.drives[1].drive.position->scale.revolutions_per_unit);
  EXPECT_FALSE(config.drives.at(0).drive.position);
}

// The torque may stay on where a command grows old and where another drive stops, if somebody says so.
TEST(CycleConfigTest, SetpointZeroIsAWayOfTheStopsThatKeepTheTorque) {
  Configured robot;
  robot.node.set("stop/command_timeout", "setpoint_zero").set("stop/drive_stopped", "setpoint_zero");
  EXPECT_EQ(drive::StopWay::kSetpointZero, robot.read().stop_ways.command_timeout);
  EXPECT_EQ(drive::StopWay::kSetpointZero, robot.read().stop_ways.drive_stopped);
  robot.node.set("stop/drive_stopped", "none");
  EXPECT_THAT(robot.refusal(), HasSubstr("~stop/drive_stopped: \"none\" is not valid, expected setpoint_zero, off1"));
}

// Faults are acknowledged by somebody who has looked, unless the configuration says otherwise.
TEST(CycleConfigTest, BusTimeoutsAreAcknowledgedAtStartOnlyWhereItIsAskedFor) {
  Configured robot;
  EXPECT_FALSE(robot.read().acknowledge_bus_timeouts);
  robot.node.set("acknowledge_at_start", "bus_timeouts");
  EXPECT_TRUE(robot.read().acknowledge_bus_timeouts);
  robot.node.set("acknowledge_at_start", "none");
  EXPECT_FALSE(robot.read().acknowledge_bus_timeouts);
}

// One that is typed holds, one that is not follows what the bus needs.
TEST(CycleConfigTest, ADriveTimeoutThatIsTypedIsTold) {
  Configured robot;
  EXPECT_FALSE(robot.read().drive_timeout_given);
  robot.node.set("drive_timeout", 0.05);
  EXPECT_TRUE(robot.read().drive_timeout_given);
}

TEST(CycleConfigTest, DrivesWithoutAJointShareNone) {
  Configured robot;
  robot.left->erase("joint");
  robot.right->erase("joint");
  EXPECT_EQ("accepted", robot.refusal());
}

struct Wrong {
  std::string key;
  MapSettings::Value value;
  std::string named;     // the value in the sentence
  std::string expected;  // what the sentence says was expected
};

class WrongNodeKey : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongNodeKey, IsRefusedByNameValueAndExpectation) {
  Configured robot;
  robot.node.set(GetParam().key, GetParam().value);
  EXPECT_THAT(robot.refusal(),
              AllOf(HasSubstr("~" + GetParam().key), HasSubstr(GetParam().named), HasSubstr(GetParam().expected)));
}

INSTANTIATE_TEST_SUITE_P(All, WrongNodeKey,
                         ::testing::Values(Wrong{"cycle_rate", 0.5, "0.5", "from 1 to 1000 Hz"},
                                           Wrong{"cycle_rate", 2000, "2000", "from 1 to 1000 Hz"},
                                           Wrong{"cycle_rate", std::string{"fast"}, "", "a number"},
                                           Wrong{"realtime_priority", 100, "100", "a whole number from 0 to 99"},
                                           Wrong{"service_timeout", 0.0, "0", "from 0.1 to 60 s"},
                                           Wrong{"shutdown_timeout", 601.0, "601", "from 0.1 to 600 s"},
                                           Wrong{"cmd_vel_timeout", -0.1, "-0.1", "from 0 to 60 s"},
                                           Wrong{"drive_timeout", 0.01, "0.01", "from 0.02 to 60 s"},
                                           Wrong{"lock_memory", 1, "", "true or false"},
                                           Wrong{"left_wheel", std::string{"nowhere"}, "\"nowhere\"",
                                                 "the `joint` of one of the drives"}));

class WrongDriveKey : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongDriveKey, IsRefusedByNameValueAndExpectation) {
  Configured robot;
  robot.right->set(GetParam().key, GetParam().value);
  EXPECT_THAT(robot.refusal(), AllOf(HasSubstr("~drives/right/" + GetParam().key), HasSubstr(GetParam().named),
                                     HasSubstr(GetParam().expected)));
}

INSTANTIATE_TEST_SUITE_P(All, WrongDriveKey,
                         ::testing::Values(Wrong{"series", std::string{"sk999"}, "\"sk999\"",
                                                 "one of sk1x0e, sk2xxe, sk300e, sk5xxe, sk54xe, sk700e, sk750e"},
                                           Wrong{"pole_pairs", 0, "0", "a whole number from 1 to 64"},
                                           Wrong{"gear_ratio", 0.0, "0", "a number from 0.001 to 100000"},
                                           Wrong{"gear_ratio", -20.0, "-20", "a number from 0.001 to 100000"},
                                           Wrong{"max_frequency", 0.0, "0", "from 0.1 to 400 Hz"},
                                           Wrong{"rated_current", -1.0, "-1", "from 0.01 to 10000 A"},
                                           Wrong{"inverted", 1, "", "true or false"},
                                           Wrong{"joint", std::string{"left_joint"}, "\"left_joint\"",
                                                 "a joint that drive \"left\" does not turn already"}));

TEST(CycleConfigTest, WhatIsMissingIsNamed) {
  Configured robot;
  robot.left->erase("pole_pairs");
  EXPECT_THAT(robot.refusal(), HasSubstr("~drives/left/pole_pairs is missing: expected a whole number from 1 to 64"));
  robot = Configured{};
  robot.left->erase("series");
  EXPECT_THAT(robot.refusal(), HasSubstr("~drives/left/series is missing: expected one of sk1x0e"));
  robot = Configured{};
  robot.drives.clear();
  EXPECT_THAT(robot.refusal(), HasSubstr("~drives is missing: expected at least one drive"));
}

// A drive's name becomes a part of topic names.
TEST(CycleConfigTest, NamesThatAreNoRosNamesAreRefused) {
  for (const char* name : {"", "1st", "left wheel", "a/b", "l\xC3\xA4ngs", "_x"}) {
    Configured robot;
    robot.drives[0].name = name;
    EXPECT_THAT(robot.refusal(), HasSubstr("letters, digits and underscores")) << name;
  }
}

}  // namespace
}  // namespace nord_driver::cycle

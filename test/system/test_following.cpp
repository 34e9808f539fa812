// Inverters that follow another one by broadcast (P509, P510), in place of this driver: known, and stopped with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cycle/parameter_requests.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr DriveIndex kLeft = 0, kRearLeft = 2;
constexpr std::int32_t kCanBroadcast = 9;
const sim::ParameterPreset kSetpointFromLeader{510, 0, 0, kCanBroadcast}, kAllFromLeader{509, 0, 0, kCanBroadcast};

/// Two wheels, and behind the left one a drive that hears it.
struct Rig {
  explicit Rig(const SimulatedRobot::Options& options) : robot(options) {
    robot.unit(kRearLeft).hear(&robot.unit(kLeft));
  }
  Rig(const std::vector<sim::ParameterPreset>& parameters, bool configured) : Rig(options(parameters, configured)) {}
  static SimulatedRobot::Options options(const std::vector<sim::ParameterPreset>& parameters, bool configured) {
    SimulatedRobot::Options options;
    options.wheels_a_side = 2;
    options.node = {{"left_wheel", std::vector<std::string>{"left_wheel_joint"}},
                    {"right_wheel", std::vector<std::string>{"right_wheel_joint"}}};
    options.parameters_of["rear_left"] = parameters;
    if (configured) options.of_drive["rear_left"] = {{"follows", std::string{"left"}}};
    return options;
  }
  double speed(std::size_t drive) { return robot.unit(drive).shaftSpeed(); }
  bool runs(std::size_t drive) { return robot.unit(drive).inverter().state() == sim::InverterState::kOperationEnabled; }
  std::string refusalOf(DriveIndex drive) {
    const cycle::Completion answer = robot.ask(cycle::RequestKind::kEnable, drive);
    return answer.success ? "" : answer.message.c_str();
  }

  SimulatedRobot robot;
};

// Enabled by this driver it would go as fast as somebody else says.
TEST(Following, ADriveThatHearsAnotherOneIsNotEnabledUnasked) {
  Rig rig{{kSetpointFromLeader}, false};
  ASSERT_TRUE(rig.robot.bringUp());
  EXPECT_EQ(
      "drive rear_left follows another inverter: P510[-01] is 9, broadcast, so that its setpoint does not come from "
      "this driver; set it to this bus, or name that drive: drives/rear_left/follows",
      rig.refusalOf(kRearLeft));
  EXPECT_THAT(rig.refusalOf(cycle::kAllDrives), HasSubstr("drive rear_left follows another inverter"));
  EXPECT_FALSE(rig.runs(kLeft)) << "all or none";
  Rig led{{kAllFromLeader}, false};
  ASSERT_TRUE(led.robot.bringUp());
  EXPECT_THAT(led.refusalOf(kRearLeft), HasSubstr("P509 is 9, broadcast, so that its control word does not come"));
}

// Enabled, it would turn at what its analogue input says, and no setpoint 0 would stop it.
TEST(Following, ADriveThatTakesItsSetpointFromTheTerminalsIsNotEnabled) {
  Rig rig{{{510, 0, 0, 1}}, false};
  ASSERT_TRUE(rig.robot.bringUp());
  EXPECT_EQ(
      "drive rear_left: P510[-01] is 1: its setpoint does not come from this bus, and enabled it would turn whatever "
      "this driver says; set it to 0 (as P509)",
      rig.refusalOf(kRearLeft));
  EXPECT_FALSE(rig.runs(kRearLeft));
}

// With the wheel it follows, and as fast.
TEST(Following, AFollowerIsEnabledAndDrivenWithItsLeader) {
  for (const auto& preset : {kSetpointFromLeader, kAllFromLeader}) {
    Rig rig{{preset}, true};
    ASSERT_TRUE(rig.robot.bringUp());
    EXPECT_EQ("drive rear_left belongs to the base: use ~enable", rig.refusalOf(kRearLeft));
    ASSERT_EQ("", rig.refusalOf(cycle::kAllDrives));
    rig.robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{4});
    EXPECT_TRUE(rig.runs(kRearLeft));
    EXPECT_GT(std::fabs(rig.speed(kLeft)), 50.0);
    EXPECT_NEAR(rig.speed(kLeft), rig.speed(kRearLeft), 5.0);
    rig.robot.drive(0.0, 0.0, std::chrono::seconds{4});
    ASSERT_TRUE(rig.robot.ask(cycle::RequestKind::kDisable).success);
    EXPECT_FALSE(rig.runs(kRearLeft));
    EXPECT_EQ("no rule broken", rig.robot.segment().referee().report());
  }
}

// The follower obeys its leader's control word: sent 047F, a leader at rest would have it turn at its P104 unasked, and
// sent 047E by its own P104 alone, would leave it disabled.
TEST(Following, LeaderAndFollowerRestTogetherWhereOneHasAMinimumFrequency) {
  for (const char* const with_minimum : {"left", "rear_left"}) {
    SCOPED_TRACE(with_minimum);
    SimulatedRobot::Options options = Rig::options({kAllFromLeader}, true);
    options.drives = {{"allow_minimum_frequency", true}};
    options.parameters_of[with_minimum].push_back({104, 0, 0, 50});  // 5 Hz
    Rig rig{options};
    ASSERT_TRUE(rig.robot.bringUp());
    ASSERT_EQ("", rig.refusalOf(cycle::kAllDrives));
    rig.robot.drive(0.0, 0.0, std::chrono::seconds{2});
    for (const double velocity : {kHalfSpeed, -kHalfSpeed}) {
      EXPECT_LT(std::fabs(rig.speed(kRearLeft)), 0.1);
      EXPECT_FALSE(rig.runs(kLeft) || rig.runs(kRearLeft));
      rig.robot.drive(velocity, 0.0, std::chrono::seconds{4});
      EXPECT_GT(std::fabs(rig.speed(kLeft)), 50.0);
      EXPECT_NEAR(rig.speed(kLeft), rig.speed(kRearLeft), 5.0);
      rig.robot.drive(0.0, 0.0, std::chrono::seconds{4});
    }
    EXPECT_FALSE(rig.runs(kLeft) || rig.runs(kRearLeft));
    EXPECT_TRUE(rig.robot.snapshot().base.enabled) << rig.robot.snapshot().base.text.c_str();
  }
}

// A fault of the one that follows ends the whole base.
TEST(Following, ALeaderStopsWithItsFollower) {
  Rig rig{{kSetpointFromLeader}, true};
  ASSERT_TRUE(rig.robot.bringUpAndEnable());
  rig.robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{2});
  rig.robot.unit(kRearLeft).inverter().trip(30, true);
  rig.robot.drive(kHalfSpeed, 0.0, std::chrono::seconds{4});
  EXPECT_FALSE(rig.robot.snapshot().base.enabled);
  EXPECT_THAT(rig.robot.snapshot().base.text.c_str(), HasSubstr("drive rear_left stopped"));
  EXPECT_FALSE(rig.runs(kLeft));
  EXPECT_LT(std::fabs(rig.speed(kLeft)), 1.0);
}

// Configured to follow, and deaf for its leader: it would stand, or go by what this driver says to others.
TEST(Following, AFollowerThatHearsThisBusIsNotEnabled) {
  Rig rig{{}, true};
  ASSERT_TRUE(rig.robot.bringUp());
  EXPECT_THAT(rig.refusalOf(cycle::kAllDrives),
              HasSubstr("drive rear_left is to follow another inverter (drives/rear_left/follows), and P510[-01] is 0, "
                        "no broadcast: it would go by this bus"));
}

// A drive that no base commands leads, too.
TEST(Following, ASingleDriveLeads) {
  SimulatedRobot::Options options;
  options.wheels_a_side = 2;
  options.node = {{"left_wheel", std::vector<std::string>{"left_wheel_joint"}},
                  {"right_wheel", std::vector<std::string>{"right_wheel_joint"}}};
  options.parameters_of["rear_left"] = {kSetpointFromLeader};
  options.of_drive["rear_left"] = {{"follows", std::string{"rear_right"}}};
  SimulatedRobot robot{options};
  robot.unit(kRearLeft).hear(&robot.unit(3));
  ASSERT_TRUE(robot.bringUp());
  EXPECT_STREQ(
      "drive rear_left follows drive rear_right (drives/rear_left/follows), and is enabled and disabled with it: use "
      "~rear_right/enable",
      robot.ask(cycle::RequestKind::kEnable, kRearLeft).message.c_str());
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kEnable, 3).success);
  robot.runUntil(
      [&] {
        robot.ports().commandDrive(3, {2.0, robot.transport().now(), true});
        return false;
      },
      std::chrono::seconds{4});
  EXPECT_GT(std::fabs(robot.unit(3).wheelSpeed()), 1.5);
  EXPECT_GT(std::fabs(robot.unit(kRearLeft).wheelSpeed()), 1.5);
  ASSERT_TRUE(robot.ask(cycle::RequestKind::kQuickStop, kRearLeft).success) << "stops both";
  EXPECT_NE(sim::InverterState::kOperationEnabled, robot.unit(3).inverter().state());
}

// What is written while the node runs counts, too.
TEST(Following, IsKnownAfterAWrite) {
  Rig rig{{}, false};
  ASSERT_TRUE(rig.robot.bringUp());
  cycle::Request request = writeRequest(kRearLeft, 510, kCanBroadcast);
  request.parameter.shape = profile::ParameterShape::kArray;
  request.parameter.index = 1;
  ASSERT_TRUE(rig.robot.ask(request).success);
  rig.robot.run(std::chrono::milliseconds{50});
  ASSERT_TRUE(rig.robot.bringUp());
  EXPECT_THAT(rig.refusalOf(kRearLeft), HasSubstr("P510[-01] is 9, broadcast"));
}

}  // namespace
}  // namespace nord_driver::test

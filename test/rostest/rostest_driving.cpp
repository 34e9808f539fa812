// A base that drives: what it does of what it is told, and what its odometry says against the simulator's truth.
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/TwistStamped.h>
#include <gmock/gmock.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "rostest/robot_under_test.h"
#include "support/second_try.h"

namespace nord_driver::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kMaxSpeed = 0.7, kAcceleration = 0.8, kJerk = 4.0, kMaxTurn = 2.0;  // the .test, robot.yaml
constexpr double kWheelRadius = 0.1, kWheelSeparation = 0.5;                         // m

struct Pose {
  double x, y, heading;
};

Pose poseOf(const nav_msgs::Odometry& odometry) {
  const auto& pose = odometry.pose.pose;
  return {pose.position.x, pose.position.y, 2.0 * std::atan2(pose.orientation.z, pose.orientation.w)};
}

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * M_PI);
}

/// `to` as seen from `from`.
Pose between(const Pose& from, const Pose& to) {
  const double x = to.x - from.x, y = to.y - from.y;
  const double c = std::cos(from.heading), s = std::sin(from.heading);
  return {c * x + s * y, c * y - s * x, wrapped(to.heading - from.heading)};
}

class Driving : public RobotTest {
 protected:
  void SetUp() override {
    RobotTest::SetUp();
    ASSERT_TRUE(robot().waitForDrivesOnline());
    robot().drive(0.0);
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().enable(true)).success; })) << answer;
    ASSERT_TRUE(robot().waitForStandstill());
    told_ = poseOf(*robot().odom.next());
    true_ = poseOf(*robot().true_odom.next());
    odom_from_ = robot().odom.mark();
  }
  /// Stops, and compares the way since `SetUp` as told with the true one.
  void stopAndMeasure() {
    robot().drive(0.0);
    ASSERT_TRUE(robot().waitForStandstill());
    told_way_ = between(told_, poseOf(*robot().odom.next()));
    true_way_ = between(true_, poseOf(*robot().true_odom.next()));
  }
  bool waitForOdom(const std::function<bool(const Pose&)>& good) {
    return robot().odom.waitNext(
               [&](const nav_msgs::Odometry& odometry) { return good(between(told_, poseOf(odometry))); }) != nullptr;
  }

  ros::NodeHandle node_;
  Topic<geometry_msgs::TwistStamped> limited_{node_, "cmd_vel_out"};
  Pose told_{}, true_{}, told_way_{}, true_way_{};
  std::size_t odom_from_ = 0;
};

/// What a speed did between two samples is not seen: at 0.8 m/s2 a hold-up of this length can hide 4 mm.
constexpr Seconds kHidesWay{0.2};

class ComparedWay : public Driving {
 protected:
  /// Drives until `arrived` and compares: told and true way are one within `metres` and `radians`.
  void expectOneWay(double linear, double angular, const std::function<bool(const Pose&)>& arrived, double metres,
                    double radians) {
    double apart = 0.0, turned = 0.0;
    const auto attempt = [&] {
      told_ = poseOf(*robot().odom.next());
      true_ = poseOf(*robot().true_odom.next());
      robot().drive(linear, angular);
      ASSERT_TRUE(waitForOdom(arrived));
      ASSERT_NO_FATAL_FAILURE(stopAndMeasure());
      apart = std::hypot(told_way_.x - true_way_.x, told_way_.y - true_way_.y);
      turned = std::fabs(wrapped(told_way_.heading - true_way_.heading));
    };
    tryAgainOnlyIfStoodStill(kHidesWay, attempt, [&] { return apart <= metres && turned <= radians; });
    std::fprintf(stderr, "told and true way are %.1f mm and %.4f rad apart\n", 1000.0 * apart, turned);
    EXPECT_LE(apart, metres);
    EXPECT_LE(turned, radians);
  }
};

// At most 1 cm of error in 1 m.
TEST_F(ComparedWay, StraightOnTheWayIsTrueToACentimetreInAMetre) {
  expectOneWay(
      0.5, 0.0, [](const Pose& pose) { return pose.x > 1.0; }, 0.01, 0.02);
  EXPECT_GT(true_way_.x, 1.0 - 0.01);
  EXPECT_NEAR(0.0, true_way_.y, 0.02);
}

TEST_F(ComparedWay, TurnsOnTheSpot) {
  expectOneWay(
      0.0, 1.0, [](const Pose& pose) { return pose.heading > 2.0; }, 0.01, 0.03);
  EXPECT_GT(true_way_.heading, 1.9);
  EXPECT_NEAR(0.0, std::hypot(true_way_.x, true_way_.y), 0.02);
}

// The radius is the commanded one, in truth and in the limited command, while it speeds up and while it brakes, too.
TEST_F(ComparedWay, AnArcKeepsItsRadius) {
  const std::size_t from = limited_.mark();
  expectOneWay(
      0.4, 0.8, [](const Pose& pose) { return pose.heading > 1.5; }, 0.02, 0.04);
  // Chord of a circle of 0.5 m.
  EXPECT_NEAR(2.0 * 0.5 * std::sin(true_way_.heading / 2.0), std::hypot(true_way_.x, true_way_.y), 0.02);
  int turning = 0;
  for (const auto& limited : limited_.since(from)) {
    EXPECT_NEAR(limited->twist.linear.x, 0.5 * limited->twist.angular.z, 0.01) << "the jerk limit may bend it a little";
    turning += limited->twist.angular.z > 0.1 ? 1 : 0;
  }
  EXPECT_GT(turning, 20);
}

TEST_F(Driving, VelocityLimitsAreKeptAndTheCurvatureToo) {
  const std::size_t from = limited_.mark();
  robot().drive(2.0, 0.5);
  ASSERT_TRUE(limited_.waitNext([](const auto& limited) { return limited.twist.linear.x > 0.999 * kMaxSpeed; }));
  robot().drive(0.0, 5.0);
  ASSERT_TRUE(limited_.waitNext([](const auto& limited) { return limited.twist.angular.z > 0.999 * kMaxTurn; }));
  ASSERT_NO_FATAL_FAILURE(stopAndMeasure());
  for (const auto& limited : limited_.since(from)) {
    EXPECT_LE(limited->twist.linear.x, kMaxSpeed + 1e-9);
    EXPECT_LE(limited->twist.angular.z, kMaxTurn + 1e-9);
    EXPECT_EQ(limited->header.frame_id, "base_link");
    if (limited->twist.linear.x > 0.999 * kMaxSpeed) {
      EXPECT_NEAR(limited->twist.angular.z, 0.5 * kMaxSpeed / 2.0, 0.005);
    }
  }
}

// Acceleration and jerk, seen in the time a ramp takes: v/a + a/j, and a begin along j t^2 / 2.
TEST_F(Driving, AccelerationAndJerkLimitsAreKept) {
  // A cycle that comes late is granted its time, which shortens what is seen of the ramp.
  constexpr Seconds kLate{0.03};
  const double shortest = 0.9 * (0.6 / kAcceleration + kAcceleration / kJerk);
  const double fastest = 0.5 * 0.1 * kAcceleration;
  double early = 0.0, end = 0.0;
  const auto attempt = [&] {
    const std::size_t from = limited_.mark();
    robot().drive(0.6);
    ASSERT_TRUE(limited_.waitNext([](const auto& limited) { return limited.twist.linear.x > 0.599; }));
    ros::Time start;
    early = end = 0.0;
    for (const auto& limited : limited_.since(from)) {
      if (limited->twist.linear.x == 0.0) start = limited->header.stamp;
      const double time = (limited->header.stamp - start).toSec();
      if (time < 0.1) early = std::max(early, limited->twist.linear.x);
      if (limited->twist.linear.x > 0.599 && end == 0.0) end = time;
    }
  };
  const auto prepare = [&] {
    robot().drive(0.0);
    ASSERT_TRUE(limited_.waitNext([](const auto& limited) { return limited.twist.linear.x == 0.0; }));
    ASSERT_TRUE(robot().waitForStandstill());
  };
  tryAgainOnlyIfStoodStill(
      kLate, attempt, [&] { return end > shortest && early < fastest; }, prepare);
  EXPECT_GT(end, shortest);
  EXPECT_LT(early, fastest) << "no step in the acceleration";
}

// No more commands: down the deceleration limit after cmd_vel_timeout, and the drives stay enabled.
TEST_F(Driving, ACommandThatGrowsOldIsBrakedAlongTheLimit) {
  robot().drive(0.5);
  ASSERT_TRUE(robot().left.status.waitNext(
      [](const DriveStatus& status) { return status.velocity_command > 0.999 * 0.5 / kWheelRadius; }));
  const std::size_t from = robot().left.status.mark();
  const ros::Time last = robot().silence();
  ASSERT_TRUE(
      robot().left.status.waitFrom(from, [](const DriveStatus& status) { return status.velocity_command == 0.0; }));
  double before = 0.5 / kWheelRadius;
  ros::Time slower, stood;
  for (const auto& status : robot().left.status.since(from)) {
    EXPECT_EQ(status->control_word, 0x047F);
    EXPECT_LE(status->velocity_command, before + 0.01);
    if (slower.isZero() && status->velocity_command < 0.95 * before) slower = status->header.stamp;
    if (stood.isZero() && status->velocity_command == 0.0) stood = status->header.stamp;
    before = status->velocity_command;
  }
  EXPECT_GT((slower - last).toSec(), 0.99 * commandTimeout().count());
  EXPECT_GT((stood - slower).toSec(), 0.7 * 0.5 / kAcceleration);
  EXPECT_EQ(robot().left.status.next()->state, DriveStatus::OPERATION_ENABLED);
}

// The pose jumps to zero; joints and truth go on.
TEST_F(Driving, ResetOdometryPutsThePoseToZeroAndNothingElse) {
  robot().drive(0.4, 0.3);
  ASSERT_TRUE(waitForOdom([](const Pose& pose) { return pose.x > 0.3; }));
  ASSERT_NO_FATAL_FAILURE(stopAndMeasure());
  const double joint = robot().joint_states.next()->position.at(0);
  const Answer answer = robot().trigger("reset_odometry");
  EXPECT_TRUE(answer.success) << answer;
  const Pose pose = poseOf(*robot().odom.next());
  EXPECT_EQ(pose.x, 0.0);
  EXPECT_EQ(pose.y, 0.0);
  EXPECT_EQ(pose.heading, 0.0);
  EXPECT_NEAR(robot().joint_states.next()->position.at(0), joint, 1e-3);
  EXPECT_GT(std::fabs(joint), 1.0);
}

// Continuous: neither wrapped nor reset, in step with the true wheel.
TEST_F(Driving, JointPositionsFollowTheWheels) {
  const auto before = robot().joint_states.next();
  const double truth = robot().left.truth.next()->wheel_angle;
  robot().drive(0.6);
  ASSERT_TRUE(waitForOdom([](const Pose& pose) { return pose.x > 0.8; }));
  ASSERT_NO_FATAL_FAILURE(stopAndMeasure());
  const auto after = robot().joint_states.next();
  ASSERT_EQ(after->name.at(0), "left_wheel_joint");
  const double turned = after->position.at(0) - before->position.at(0);
  EXPECT_GT(turned, 8.0) << "more than a turn";
  EXPECT_NEAR(turned, robot().left.truth.next()->wheel_angle - truth, 0.02 * turned);
}

TEST_F(Driving, DiagnosticsTellSpeedAndWhetherItIsReached) {
  robot().drive(0.5);
  const auto value = [](const diagnostic_msgs::DiagnosticArray& array, const std::string& key) -> std::string {
    for (const auto& status : array.status) {
      if (status.name != "nord_driver: drive left") continue;
      for (const auto& item : status.values) {
        if (item.key == key) return item.value;
      }
    }
    return "";
  };
  ASSERT_TRUE(robot().diagnostics.waitNext([&](const auto& array) {
    return value(array, "at speed") == "True" && std::abs(std::atof(value(array, "velocity (rad/s)").c_str())) > 4.0;
  }));
  const auto told = robot().diagnostics.waitNext([&](const auto& array) { return value(array, "at speed") != ""; });
  ASSERT_TRUE(told);
  EXPECT_NEAR(std::atof(value(*told, "speed deviation (rad/s)").c_str()), 0.0, 0.2);
  EXPECT_THAT(value(*told, "protected by"), HasSubstr("PROFIBUS watchdog"));
}

// What the shipped analyzers expect is what the node reports, in the naming of REP-107.
TEST_F(Driving, TheAnalyzersExpectTheTasksThereAre) {
  XmlRpc::XmlRpcValue analyzers;
  ASSERT_TRUE(ros::param::get("/analyzers_file/analyzers", analyzers));
  int expected = 0;
  for (auto& analyzer : analyzers) {
    XmlRpc::XmlRpcValue names = analyzer.second["expected"];
    for (int i = 0; i < names.size(); ++i, ++expected) {
      const std::string name = names[i];
      EXPECT_TRUE(robot().diagnostics.waitFrom(0, [&](const auto& array) {
        for (const auto& status : array.status) {
          if (status.name == name && !status.hardware_id.empty()) return true;
        }
        return false;
      })) << name;
    }
  }
  EXPECT_EQ(expected, 4);
}

dynamic_reconfigure::Config reconfigure(const dynamic_reconfigure::Config& wanted) {
  dynamic_reconfigure::Reconfigure service;
  service.request.config = wanted;
  EXPECT_TRUE(carryOut("nord_driver/set_parameters", service));
  return service.response.config;
}

dynamic_reconfigure::Config number(const std::string& name, double value) {
  dynamic_reconfigure::Config config;
  config.doubles.resize(1);
  config.doubles[0].name = name;
  config.doubles[0].value = value;
  return config;
}

dynamic_reconfigure::Config flag(const std::string& name, bool value) {
  dynamic_reconfigure::Config config;
  config.bools.resize(1);
  config.bools[0].name = name;
  config.bools[0].value = value;
  return config;
}

class Reconfigured : public Driving {
 protected:
  void TearDown() override {
    robot().drive(0.0);
    EXPECT_TRUE(robot().waitForStandstill());
    reconfigure(number("wheel_separation_multiplier", 1.0));
    reconfigure(number("publish_rate", 50.0));
    reconfigure(flag("enable_odom_tf", true));
    Driving::TearDown();
  }
  /// The greatest wheel speed commanded for a turn of 0.8 rad/s.
  double wheelSpeedOfATurn() {
    const std::size_t from = robot().right.status.mark();
    robot().drive(0.0, 0.8);
    EXPECT_TRUE(limited_.waitNext([](const auto& limited) { return limited.twist.angular.z > 0.799; }));
    EXPECT_TRUE(robot().right.status.next());
    EXPECT_TRUE(robot().right.status.next());
    double most = 0.0;
    for (const auto& status : robot().right.status.since(from)) most = std::max(most, status->velocity_command);
    return most;
  }
};

// Multipliers are taken over when the base stands: under way they would be a step of the wheels' speeds.
TEST_F(Reconfigured, MultipliersCountFromTheNextStandstillOn) {
  const double one = 0.8 * kWheelSeparation / 2.0 / kWheelRadius;
  EXPECT_NEAR(wheelSpeedOfATurn(), one, 0.01);
  reconfigure(number("wheel_separation_multiplier", 1.5));
  EXPECT_NEAR(wheelSpeedOfATurn(), one, 0.01) << "it turns";
  robot().drive(0.0);
  ASSERT_TRUE(robot().waitForStandstill());
  EXPECT_NEAR(wheelSpeedOfATurn(), 1.5 * one, 0.01);
}

TEST_F(Reconfigured, WhatIsNoNumberIsNotTaken) {
  const auto answer = reconfigure(number("wheel_separation_multiplier", std::numeric_limits<double>::quiet_NaN()));
  for (const auto& parameter : answer.doubles) EXPECT_TRUE(std::isfinite(parameter.value)) << parameter.name;
  EXPECT_NEAR(wheelSpeedOfATurn(), 0.8 * kWheelSeparation / 2.0 / kWheelRadius, 0.01);
}

// Counted in messages of another topic, which keeps its rate.
TEST_F(Reconfigured, RateAndTfChangeAtOnce) {
  Topic<tf2_msgs::TFMessage> tf(node_, "/tf");
  ASSERT_TRUE(tf.next());
  const auto countIn = [&](auto& topic, int statuses) {
    const std::size_t from = topic.mark(), status_from = robot().left.status.mark();
    EXPECT_TRUE(
        eventually([&] { return robot().left.status.mark() >= status_from + static_cast<std::size_t>(statuses); }));
    return topic.mark() - from;
  };
  EXPECT_GT(countIn(robot().odom, 50), 30u);
  reconfigure(number("publish_rate", 5.0));
  EXPECT_LT(countIn(robot().odom, 50), 15u);
  reconfigure(number("publish_rate", 1e-200));  // a period that no clock can hold
  EXPECT_LT(countIn(robot().odom, 50), 3u);
  reconfigure(number("publish_rate", 0.0));
  EXPECT_EQ(countIn(robot().odom, 50), 0u);
  reconfigure(flag("enable_odom_tf", false));
  reconfigure(number("publish_rate", 50.0));
  ASSERT_TRUE(robot().odom.next());
  EXPECT_EQ(countIn(tf, 25), 0u);
  reconfigure(flag("enable_odom_tf", true));
  EXPECT_TRUE(tf.next());
}

// As diff_drive_controller: the values of the configuration, latched for whoever looks.
TEST_F(Reconfigured, TheFiveParametersAreThere) {
  Topic<dynamic_reconfigure::Config> updates(node_, "nord_driver/parameter_updates");
  const auto told = updates.waitFrom(0, [](const auto&) { return true; });
  ASSERT_TRUE(told);
  std::vector<std::string> names;
  for (const auto& parameter : told->doubles) names.push_back(parameter.name);
  for (const auto& parameter : told->bools) names.push_back(parameter.name);
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("left_wheel_radius_multiplier", "right_wheel_radius_multiplier",
                                                     "wheel_separation_multiplier", "publish_rate", "enable_odom_tf"));
}

}  // namespace
}  // namespace nord_driver::test

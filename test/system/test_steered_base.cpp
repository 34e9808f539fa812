// A base with two steered axles, the whole driver below ROS on a simulated bus: it steers before it drives, drives where
// it says, and knows where it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "system/steered_robot.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;
constexpr double kTolerance = 0.05;  // rad, the default
constexpr DriveIndex kFront = SteeredRobot::kFront, kFrontSteering = SteeredRobot::kFrontSteering,
                     kRear = SteeredRobot::kRear, kRearSteering = SteeredRobot::kRearSteering;

class SteeredBase : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUp());
    const cycle::Completion answer = robot_.ask(cycle::RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.segment().referee().report()); }
  double distanceToOdometry() {
    const robot::Pose2d& told = robot_.snapshot().base.pose;
    const sim::Pose& is = robot_.body().pose();
    return std::hypot(told.x - is.x, told.y - is.y);
  }

  SteeredRobot robot_;
};

// Enabling moves nothing: neither a wheel nor a steering axis.
TEST_F(SteeredBase, EnablingMovesNothing) {
  robot_.run(seconds{2});
  for (DriveIndex i = 0; i < SteeredRobot::kDrives; ++i) {
    EXPECT_EQ(0x047F, robot_.controlWord(i)) << i;
    EXPECT_NEAR(0.0, robot_.unit(i).shaftAngle(), 0.1) << i;
  }
}

TEST_F(SteeredBase, DrivesStraightOn) {
  robot_.go(0.4, 0.0, 0.0, seconds{3});
  EXPECT_NEAR(0.4, robot_.body().linear(), 0.01);
  EXPECT_NEAR(0.0, robot_.body().pose().y, 1e-3);
  EXPECT_NEAR(0.0, robot_.body().angular(), 1e-3);
}

// REP-103: to the left is positive, and left of the robot.
TEST_F(SteeredBase, GoesSidewaysToTheLeft) {
  robot_.go(0.0, 0.0, 0.3, seconds{5});
  EXPECT_NEAR(0.3, robot_.body().lateral(), 0.01);
  EXPECT_GT(robot_.body().pose().y, 0.3);
  EXPECT_NEAR(0.0, robot_.body().pose().x, 0.02);
  EXPECT_LT(distanceToOdometry(), 0.02);
}

// A turn to the left on the spot, the wheels at a quarter of a turn.
TEST_F(SteeredBase, TurnsOnTheSpot) {
  robot_.go(0.0, 0.5, 0.0, seconds{5});
  EXPECT_NEAR(0.5, robot_.body().angular(), 0.02);
  EXPECT_NEAR(0.0, robot_.body().pose().x, 0.01);
  EXPECT_NEAR(0.0, robot_.body().pose().y, 0.01);
  EXPECT_NEAR(kPi / 2.0, std::abs(robot_.angle(kFrontSteering)), 0.01);
}

// At standstill the wheels are steered first: no wheel turns while one of them is out of the tolerance.
TEST_F(SteeredBase, WaitsForTheAnglesBeforeItDrivesOff) {
  const Instant start = robot_.transport().now();
  while (true) {
    ASSERT_LT(robot_.transport().now() - start, seconds{5});
    robot_.say(0.0, 0.0, 0.3);
    robot_.step();
    if (robot_.setpoint(kFront) != 0 || robot_.setpoint(kRear) != 0) break;
    EXPECT_LT(std::abs(robot_.unit(kFront).shaftSpeed()), 0.1);
    EXPECT_LT(std::abs(robot_.unit(kRear).shaftSpeed()), 0.1);
  }
  EXPECT_NEAR(kPi / 2.0, std::abs(robot_.angle(kFrontSteering)), kTolerance);
  EXPECT_NEAR(kPi / 2.0, std::abs(robot_.angle(kRearSteering)), kTolerance);
  EXPECT_GT(robot_.transport().now() - start, seconds{1}) << "a quarter of a turn at 1.57 rad/s";
}

TEST_F(SteeredBase, SaysWhatItWaitsFor) {
  robot_.go(0.0, 0.0, 0.3, milliseconds{300});
  EXPECT_EQ("the base waits until its wheels are steered", robot_.snapshot().base.waits.str());
  robot_.go(0.0, 0.0, 0.3, seconds{4});
  EXPECT_EQ("", robot_.snapshot().base.waits.str());
}

// From straight on into a curve under way: no wheel is ever farther from its angle than the tolerance and what it
// travels in a cycle, and the base does not stop for it.
TEST_F(SteeredBase, TheCurveComesUnderWay) {
  robot_.go(0.3, 0.0, 0.0, seconds{3});
  for (int i = 0; i < 400; ++i) {
    robot_.say(0.3, 0.4, 0.0);
    robot_.step();
    EXPECT_GT(robot_.body().linear(), 0.2);
    const robot::Twist2d& command = robot_.snapshot().base.command;
    const double asked = std::atan2(command.angular_z * 0.5, command.linear_x);
    EXPECT_NEAR(asked, robot_.angle(kFrontSteering), kTolerance + 0.02);
    EXPECT_NEAR(-asked, robot_.angle(kRearSteering), kTolerance + 0.02);
  }
  EXPECT_NEAR(0.4, robot_.body().angular(), 0.02);
}

// A steering axis that hardly follows any more: the base gets slower, to a stop, and stays enabled.
TEST_F(SteeredBase, ASteeringAxisThatDoesNotFollowHoldsTheBase) {
  robot_.go(0.3, 0.0, 0.0, seconds{3});
  robot_.unit(kRearSteering).parameters().preset(105, 0, 0, 1);  // 0.1 Hz: it hardly follows any more
  for (int i = 0; i < 400; ++i) {
    robot_.say(0.3, 0.6, 0.0);
    robot_.step();
  }
  EXPECT_NEAR(0.0, robot_.body().linear(), 0.02);
  EXPECT_EQ("the base waits until its wheels are steered", robot_.snapshot().base.waits.str());
  EXPECT_TRUE(robot_.snapshot().base.enabled);
}

// A circle of a metre's radius by the clock, with motors that slip: the robot comes back where it began, within 2 cm of
// what it believes.
TEST_F(SteeredBase, ACircleEndsWhereItBegan) {
  const double turned_at_start = robot_.snapshot().base.pose.heading;
  double turned = 0.0, last = turned_at_start;
  for (int i = 0; i < 6000 && turned < 2.0 * kPi; ++i) {
    robot_.say(0.3, 0.3, 0.0);
    robot_.step();
    const double now = robot_.snapshot().base.pose.heading;
    turned += std::remainder(now - last, 2.0 * kPi);
    last = now;
  }
  for (int i = 0; i < 300; ++i) {
    robot_.say(0.0, 0.0, 0.0);
    robot_.step();
  }
  EXPECT_TRUE(robot_.standsStill());
  EXPECT_LT(distanceToOdometry(), 0.02);
  EXPECT_NEAR(2.0 * kPi, robot_.body().pose().theta, 0.15);
  RecordProperty("apart_mm", static_cast<int>(1000.0 * distanceToOdometry()));
}

// Forward and back again: the wheels turn backward, they are not turned about.
TEST_F(SteeredBase, BacksWithoutTurningItsWheelsAbout) {
  robot_.go(0.3, 0.0, 0.0, seconds{2});
  for (int i = 0; i < 300; ++i) {
    robot_.say(-0.3, 0.05, 0.0);
    robot_.step();
    EXPECT_LT(std::abs(robot_.angle(kFrontSteering)), 0.3);
  }
  EXPECT_NEAR(-0.3, robot_.body().linear(), 0.01);
}

// The command ends while the wheels are steered at standstill: so does the steering.
TEST_F(SteeredBase, SteeringEndsWithTheCommand) {
  robot_.go(0.0, 0.0, 0.3, milliseconds{500});
  robot_.run(seconds{3});
  EXPECT_TRUE(robot_.standsStill());
  EXPECT_LT(std::abs(robot_.angle(kFrontSteering)), 1.45);
  EXPECT_GT(std::abs(robot_.angle(kFrontSteering)), 0.3);
  EXPECT_NEAR(0.0, robot_.body().pose().y, 1e-3);
}

// Joint states tell the drive's own, absolute angle.
TEST_F(SteeredBase, TellsTheAnglesOfItsJoints) {
  robot_.go(0.3, 0.3, 0.0, seconds{4});
  EXPECT_NEAR(std::atan(0.5), robot_.drive(kFrontSteering).joint_position, 0.01);
  EXPECT_NEAR(robot_.angle(kFrontSteering), robot_.drive(kFrontSteering).joint_position, 0.005);
  EXPECT_NEAR(robot_.angle(kRearSteering), robot_.drive(kRearSteering).joint_position, 0.005);
}

// Motors that hardly slip: what is left between the truth and odometry is how it adds up speeds and angles. With a slip of
// 2 Hz at rated torque it is 2 cm, for P543 = 1 is the output frequency, without slip.
TEST(SteeredBaseWithoutSlip, KnowsWhereItIsAfterACircle) {
  SteeredRobot::Options options;
  options.slip = 0.001;
  SteeredRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  double turned = 0.0, last = 0.0;
  for (int i = 0; i < 6000 && turned < 2.0 * kPi - 0.003; ++i) {
    const double part = std::max(0.05, std::min(1.0, 1.5 * (2.0 * kPi - turned)));
    robot.say(0.3 * part, 0.3 * part, 0.0);
    robot.step();
    const double now = robot.snapshot().base.pose.heading;
    turned += std::remainder(now - last, 2.0 * kPi);
    last = now;
  }
  for (int i = 0; i < 300; ++i) {
    robot.say(0.0, 0.0, 0.0);
    robot.step();
  }
  const robot::Pose2d& told = robot.snapshot().base.pose;
  const sim::Pose& is = robot.body().pose();
  EXPECT_LT(std::hypot(told.x - is.x, told.y - is.y), 0.001);
  EXPECT_NEAR(0.0, std::remainder(told.heading - is.theta, 2.0 * kPi), 0.001);
}

// A narrow range: the curve is widened, turning on the spot is not driven, and both are said.
TEST(SteeredBaseInANarrowRange, WidensTheCurveAndSaysSo) {
  SteeredRobot::Options options;
  options.steering_range = 0.5;
  SteeredRobot robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.go(0.3, 2.0, 0.0, seconds{6});
  EXPECT_NEAR(0.3, robot.body().linear(), 0.02);
  EXPECT_NEAR(0.3 * std::tan(0.5) / 0.5, robot.body().angular(), 0.02);
  EXPECT_THAT(robot.snapshot().base.waits.str(), HasSubstr("beyond the steering range"));
  robot.go(0.0, 0.5, 0.0, seconds{3});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_THAT(robot.snapshot().base.waits.str(), HasSubstr("no angle in the steering range: the base stands"));
}

}  // namespace
}  // namespace nord_driver::test

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

template <typename Bus>
class SteeredBase : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(robot_.bringUp());
    const cycle::Completion answer = robot_.ask(cycle::RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  void TearDown() override { EXPECT_EQ("no rule broken", robot_.report()); }
  double distanceToOdometry() {
    const robot::Pose2d& told = robot_.snapshot().base.pose;
    const sim::Pose& is = robot_.body().pose();
    return std::hypot(told.x - is.x, told.y - is.y);
  }

  SteeredRobot<Bus> robot_;
};
TYPED_TEST_SUITE(SteeredBase, EveryLift, BusName);

// Enabling moves nothing: neither a wheel nor a steering axis.
TYPED_TEST(SteeredBase, EnablingMovesNothing) {
  auto& robot = this->robot_;
  robot.run(seconds{2});
  for (DriveIndex i = 0; i < kSteeredDrives; ++i) {
    EXPECT_EQ(0x047F, robot.controlWord(i)) << i;
    EXPECT_NEAR(0.0, robot.unit(i).shaftAngle(), 0.1) << i;
  }
}

TYPED_TEST(SteeredBase, DrivesStraightOn) {
  auto& robot = this->robot_;
  robot.go(0.4, 0.0, 0.0, seconds{3});
  EXPECT_NEAR(0.4, robot.body().linear(), 0.01);
  EXPECT_NEAR(0.0, robot.body().pose().y, 1e-3);
  EXPECT_NEAR(0.0, robot.body().angular(), 1e-3);
}

// REP-103: to the left is positive, and left of the robot.
TYPED_TEST(SteeredBase, GoesSidewaysToTheLeft) {
  auto& robot = this->robot_;
  robot.go(0.0, 0.0, 0.3, seconds{5});
  EXPECT_NEAR(0.3, robot.body().lateral(), 0.01);
  EXPECT_GT(robot.body().pose().y, 0.3);
  EXPECT_NEAR(0.0, robot.body().pose().x, 0.02);
  EXPECT_LT(this->distanceToOdometry(), 0.02);
}

// A turn to the left on the spot, the wheels at a quarter of a turn.
TYPED_TEST(SteeredBase, TurnsOnTheSpot) {
  auto& robot = this->robot_;
  robot.go(0.0, 0.5, 0.0, seconds{5});
  EXPECT_NEAR(0.5, robot.body().angular(), 0.02);
  EXPECT_NEAR(0.0, robot.body().pose().x, 0.01);
  EXPECT_NEAR(0.0, robot.body().pose().y, 0.01);
  EXPECT_NEAR(kPi / 2.0, std::abs(robot.angle(kFrontSteering)), 0.01);
}

// At standstill the wheels are steered first: no wheel turns while one of them is out of the tolerance.
TYPED_TEST(SteeredBase, WaitsForTheAnglesBeforeItDrivesOff) {
  auto& robot = this->robot_;
  const Instant start = robot.transport().now();
  while (true) {
    ASSERT_LT(robot.transport().now() - start, seconds{5});
    robot.say(0.0, 0.0, 0.3);
    robot.step();
    if (robot.setpoint(kFront) != 0 || robot.setpoint(kRear) != 0) break;
    EXPECT_LT(std::abs(robot.unit(kFront).shaftSpeed()), 0.1);
    EXPECT_LT(std::abs(robot.unit(kRear).shaftSpeed()), 0.1);
  }
  EXPECT_NEAR(kPi / 2.0, std::abs(robot.angle(kFrontSteering)), kTolerance);
  EXPECT_NEAR(kPi / 2.0, std::abs(robot.angle(kRearSteering)), kTolerance);
  EXPECT_GT(robot.transport().now() - start, seconds{1}) << "a quarter of a turn at 1.57 rad/s";
}

TYPED_TEST(SteeredBase, SaysWhatItWaitsFor) {
  auto& robot = this->robot_;
  robot.go(0.0, 0.0, 0.3, milliseconds{300});
  EXPECT_EQ("the base waits until its wheels are steered", robot.snapshot().base.waits.str());
  robot.go(0.0, 0.0, 0.3, seconds{4});
  EXPECT_EQ("", robot.snapshot().base.waits.str());
}

// From straight on into a curve under way: no wheel is ever farther from its angle than the tolerance and what it
// travels in a cycle, and the base does not stop for it.
TYPED_TEST(SteeredBase, TheCurveComesUnderWay) {
  auto& robot = this->robot_;
  robot.go(0.3, 0.0, 0.0, seconds{3});
  for (int i = 0; i < 400; ++i) {
    robot.say(0.3, 0.4, 0.0);
    robot.step();
    EXPECT_GT(robot.body().linear(), 0.2);
    const robot::Twist2d& command = robot.snapshot().base.command;
    const double asked = std::atan2(command.angular_z * 0.5, command.linear_x);
    EXPECT_NEAR(asked, robot.angle(kFrontSteering), kTolerance + 0.02);
    EXPECT_NEAR(-asked, robot.angle(kRearSteering), kTolerance + 0.02);
  }
  EXPECT_NEAR(0.4, robot.body().angular(), 0.02);
}

// A steering axis that hardly follows any more: the base gets slower, to a stop, and stays enabled.
TYPED_TEST(SteeredBase, ASteeringAxisThatDoesNotFollowHoldsTheBase) {
  auto& robot = this->robot_;
  robot.go(0.3, 0.0, 0.0, seconds{3});
  robot.unit(kRearSteering).parameters().preset(105, 0, 0, 1);  // 0.1 Hz: it hardly follows any more
  for (int i = 0; i < 400; ++i) {
    robot.say(0.3, 0.6, 0.0);
    robot.step();
  }
  EXPECT_NEAR(0.0, robot.body().linear(), 0.02);
  EXPECT_EQ("the base waits until its wheels are steered", robot.snapshot().base.waits.str());
  EXPECT_TRUE(robot.snapshot().base.enabled);
}

// A circle of a metre's radius by the clock, with motors that slip: the robot comes back where it began, within 2 cm of
// what it believes.
TYPED_TEST(SteeredBase, ACircleEndsWhereItBegan) {
  auto& robot = this->robot_;
  const double turned_at_start = robot.snapshot().base.pose.heading;
  double turned = 0.0, last = turned_at_start;
  for (int i = 0; i < 6000 && turned < 2.0 * kPi; ++i) {
    robot.say(0.3, 0.3, 0.0);
    robot.step();
    const double now = robot.snapshot().base.pose.heading;
    turned += std::remainder(now - last, 2.0 * kPi);
    last = now;
  }
  for (int i = 0; i < 300; ++i) {
    robot.say(0.0, 0.0, 0.0);
    robot.step();
  }
  EXPECT_TRUE(robot.standsStill());
  EXPECT_LT(this->distanceToOdometry(), 0.02);
  EXPECT_NEAR(2.0 * kPi, robot.body().pose().theta, 0.15);
  this->RecordProperty("apart_mm", static_cast<int>(1000.0 * this->distanceToOdometry()));
}

// Forward and back again: the wheels turn backward, they are not turned about.
TYPED_TEST(SteeredBase, BacksWithoutTurningItsWheelsAbout) {
  auto& robot = this->robot_;
  robot.go(0.3, 0.0, 0.0, seconds{2});
  for (int i = 0; i < 300; ++i) {
    robot.say(-0.3, 0.05, 0.0);
    robot.step();
    EXPECT_LT(std::abs(robot.angle(kFrontSteering)), 0.3);
  }
  EXPECT_NEAR(-0.3, robot.body().linear(), 0.01);
}

// The command ends while the wheels are steered at standstill: so does the steering.
TYPED_TEST(SteeredBase, SteeringEndsWithTheCommand) {
  auto& robot = this->robot_;
  robot.go(0.0, 0.0, 0.3, milliseconds{500});
  robot.run(seconds{3});
  EXPECT_TRUE(robot.standsStill());
  EXPECT_LT(std::abs(robot.angle(kFrontSteering)), 1.45);
  EXPECT_GT(std::abs(robot.angle(kFrontSteering)), 0.3);
  EXPECT_NEAR(0.0, robot.body().pose().y, 1e-3);
}

// Joint states tell the drive's own, absolute angle.
TYPED_TEST(SteeredBase, TellsTheAnglesOfItsJoints) {
  auto& robot = this->robot_;
  robot.go(0.3, 0.3, 0.0, seconds{4});
  EXPECT_NEAR(std::atan(0.5), robot.drive(kFrontSteering).joint_position, 0.01);
  EXPECT_NEAR(robot.angle(kFrontSteering), robot.drive(kFrontSteering).joint_position, 0.005);
  EXPECT_NEAR(robot.angle(kRearSteering), robot.drive(kRearSteering).joint_position, 0.005);
}

// Without acceleration limits the base is commanded to stand at once, and rolls on down P103: 1.5 s from 0.4 m/s.
template <typename Bus>
class SteeredBaseOnSlowRamps : public ::testing::Test {};
TYPED_TEST_SUITE(SteeredBaseOnSlowRamps, EveryLift, BusName);

TYPED_TEST(SteeredBaseOnSlowRamps, SteersNoWheelWhileItRolls) {
  SteeredOptions options;
  options.limits = false;
  options.wheel_ramp = 3.0;
  SteeredRobot<TypeParam> robot{options};
  ASSERT_TRUE(robot.bringUpAndEnable());
  robot.go(0.4, 0.0, 0.0, seconds{4});
  ASSERT_NEAR(0.4, robot.body().linear(), 0.01);
  int rolled = 0;
  std::string waits;
  while (std::abs(robot.body().linear()) > 0.02 && rolled < 1000) {
    robot.say(0.0, 0.0, 0.3);
    robot.step();
    ++rolled;
    ASSERT_NEAR(0.0, robot.angle(kFrontSteering), kTolerance) << "at " << robot.body().linear() << " m/s";
    ASSERT_NEAR(0.0, robot.angle(kRearSteering), kTolerance);
    waits = robot.snapshot().base.waits.str();
  }
  EXPECT_GT(rolled, 20);
  EXPECT_EQ("the base waits until its wheels are steered", waits);
  robot.go(0.0, 0.0, 0.3, seconds{6});
  EXPECT_NEAR(kPi / 2.0, std::abs(robot.angle(kFrontSteering)), kTolerance);
  EXPECT_NE(0, robot.setpoint(kFront)) << "it drives off";
  EXPECT_EQ("no rule broken", robot.report());
}

template <typename Bus>
class SteeredBaseWithoutSlip : public ::testing::Test {};
TYPED_TEST_SUITE(SteeredBaseWithoutSlip, EveryLift, BusName);
template <typename Bus>
class SteeredBaseInANarrowRange : public ::testing::Test {};
TYPED_TEST_SUITE(SteeredBaseInANarrowRange, EveryLift, BusName);

// Motors that hardly slip: what is left between the truth and odometry is how it adds up speeds and angles. With a slip of
// 2 Hz at rated torque it is 2 cm, for P543 = 1 is the output frequency, without slip. CANopen nodes that send on a change are up
// to a cycle late, by the moment of the start: 0.1 to 1.7 mm.
TYPED_TEST(SteeredBaseWithoutSlip, KnowsWhereItIsAfterACircle) {
  SteeredOptions options;
  options.slip = 0.001;
  options.sync = true;
  SteeredRobot<TypeParam> robot{options};
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
TYPED_TEST(SteeredBaseInANarrowRange, WidensTheCurveAndSaysSo) {
  SteeredOptions options;
  options.steering_range = 0.5;
  SteeredRobot<TypeParam> robot{options};
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

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cycle/steered_bench.h"

namespace nord_driver::cycle {
namespace {

using std::chrono::milliseconds;
using namespace steered_bench;

TEST(SteeredMotion, DrivesStraightAlongTheLimits) {
  Base base;
  base.command(0.5);
  EXPECT_NEAR(0.1, base.poll().wheels[0], 1e-9);  // 1 m/s^2 for 10 ms on a wheel of 0.1 m
  EXPECT_NEAR(0.2, base.poll().wheels[1], 1e-9);
  base.run(1.0);
  EXPECT_NEAR(5.0, base.setpoint.wheels[0], 1e-9);
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), base.setpoint.angles);
  EXPECT_EQ(SteeredWait::kNothing, base.motion.waitsFor());
}

// At standstill the wheels are steered first: none turns before both stand within the tolerance.
TEST(SteeredMotion, SteersFirstAndThenDrivesOff) {
  Base base;
  base.command(0.0, 0.0, 0.4);
  int cycles = 0;
  for (; base.poll().wheels[0] == 0.0 && cycles < 1000; ++cycles) {
    EXPECT_EQ(0.0, base.setpoint.wheels[1]);
    EXPECT_NEAR(kQuarter, std::abs(base.setpoint.angles[0]), 1e-9);
  }
  EXPECT_GE(std::abs(base.drives.angles[0]), kQuarter - kTolerance);
  EXPECT_NEAR((kQuarter - kTolerance) / base.steering_rate / toSeconds(kCycle), cycles, 2.0);
  base.run(2.0);
  EXPECT_NEAR(0.4, base.motion.limited().linear_y, 1e-9);
  EXPECT_NEAR(4.0, std::abs(base.setpoint.wheels[1]), 1e-6);
}

TEST(SteeredMotion, SaysThatItWaitsForTheAngles) {
  Base base;
  base.command(0.0, 0.0, 0.4);
  base.poll();
  EXPECT_EQ(SteeredWait::kAngles, base.motion.waitsFor());
}

// One axle that does not move holds the whole base.
TEST(SteeredMotion, OneAxleThatIsOffHoldsTheBase) {
  Base base;
  base.drives.angles = {0.0, 0.4};
  base.steering_rate = 0.0;
  base.command(0.5);
  base.run(3.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_EQ(SteeredWait::kAngles, base.motion.waitsFor());
}

// Under way the path changes as fast as the wheels follow; the base neither stops nor leaves the tolerance.
TEST(SteeredMotion, TheCurveComesAsFastAsTheWheelsFollow) {
  Base base;
  base.steering_rate = 0.2;
  base.command(0.5);
  base.run(1.0);
  base.command(0.5, 0.5);
  for (int i = 0; i < 600; ++i) {
    base.poll();
    EXPECT_LE(base.off(), kTolerance + 1e-9);
    EXPECT_GT(base.motion.limited().linear_x, 0.3);
  }
  EXPECT_NEAR(0.5, base.motion.limited().angular_z, 1e-9);
  EXPECT_NEAR(0.5, base.motion.limited().linear_x, 1e-9);
  EXPECT_NEAR(std::atan(0.5), base.drives.angles[0], 1e-9);
  EXPECT_NEAR(-std::atan(0.5), base.drives.angles[1], 1e-9);
}

// A wheel that leaves its angle while the base drives: it gets slower along the limits, to a stop, and goes on when the
// wheel is back.
TEST(SteeredMotion, GetsSlowerWhileAWheelIsOutOfTolerance) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.steering_rate = 0.0;
  base.drives.angles[1] = 2.0 * kTolerance;
  base.poll();
  EXPECT_NEAR(0.5 - 0.01, base.motion.limited().linear_x, 1e-9);
  EXPECT_EQ(SteeredWait::kAngles, base.motion.waitsFor());
  base.poll();
  EXPECT_NEAR(0.5 - 0.02, base.motion.limited().linear_x, 1e-9);
  base.run(1.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_EQ(0.0, base.setpoint.angles[1]) << "it is still to go back";
  base.steering_rate = 1.0;
  base.run(1.0);
  EXPECT_NEAR(0.5, base.motion.limited().linear_x, 1e-9);
}

// A steering axis that stops following in a curve that is still coming: held for a moment, then slower to a stop.
TEST(SteeredMotion, DoesNotHoldOnForEver) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.steering_rate = 0.0;
  base.command(0.5, 0.5);
  base.run(0.3);
  EXPECT_GT(base.motion.limited().linear_x, 0.45);
  base.run(2.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
}

// Straight on and then sideways at once is a way through the curves between; straight on and nearly back is not: it
// stops, and turns its wheels the other way round.
TEST(SteeredMotion, StopsToGoBack) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.command(-0.5, 0.05);
  bool stood = false;
  for (int i = 0; i < 300; ++i) {
    base.poll();
    stood = stood || base.setpoint.wheels == robot::WheelSpeeds{0.0, 0.0};
    EXPECT_LT(std::abs(base.setpoint.angles[0]), 0.2) << "backward wheels need no turn about";
  }
  EXPECT_TRUE(stood);
  EXPECT_NEAR(-0.5, base.motion.limited().linear_x, 1e-9);
}

// Beyond the steering range: the tightest curve there is, and told.
TEST(SteeredMotion, WidensACurveBeyondTheSteeringRange) {
  Base base{0.5};
  base.command(0.4, 4.0);
  base.run(4.0);
  EXPECT_NEAR(0.5, base.drives.angles[0], 1e-6);
  EXPECT_NEAR(-0.5, base.drives.angles[1], 1e-6);
  EXPECT_NEAR(0.4, base.motion.limited().linear_x, 1e-9);
  EXPECT_NEAR(0.4 * std::tan(0.5) / 0.5, base.motion.limited().angular_z, 1e-6);
  EXPECT_EQ(SteeredWait::kWiderCurve, base.motion.waitsFor());
  base.command(0.0, 1.0);
  base.run(4.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_EQ(SteeredWait::kNoAngle, base.motion.waitsFor());
}

// 100 % of a drive is 1 m/s: the base is slowed as a whole, and turns on the same circle.
TEST(SteeredMotion, IsScaledAsAWholeIntoWhatTheWheelsCan) {
  Base base;
  base.command(3.0, 3.0);
  base.run(6.0);
  EXPECT_NEAR(kFullSpeed, std::abs(base.setpoint.wheels[0]), 1e-6);
  EXPECT_NEAR(base.motion.limited().linear_x, base.motion.limited().angular_z, 1e-9);
  base.full_speed = 0.0;
  base.poll();
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels) << "P105 of a drive is not known any more";
}

// The wheels' joints have a limit in the URDF, too.
TEST(SteeredMotion, KeepsTheLimitsOfTheJoints) {
  BaseConfig limited = config(kQuarter);
  limited.joint_velocity_limits = {std::numeric_limits<double>::infinity(), 3.0};
  Base base;
  base.motion = SteeredMotion{limited, kTimeout};
  base.command(3.0);
  base.run(2.0);
  EXPECT_NEAR(3.0, base.setpoint.wheels[0], 1e-9);
  EXPECT_NEAR(3.0, base.setpoint.wheels[1], 1e-9);
}

// A command that has grown old brakes along the limit, the wheels as they stand.
TEST(SteeredMotion, BrakesInTheCurveWhenTheCommandGrowsOld) {
  Base base;
  base.command(0.5, 0.5);
  base.run(2.0);
  const robot::SteeringAngles before = base.setpoint.angles;
  base.keeps_commanding = false;
  base.newest.received = base.now;
  base.run(0.49);
  EXPECT_NEAR(0.5, base.motion.limited().linear_x, 1e-9);
  base.poll();
  base.poll();
  EXPECT_LT(base.motion.limited().linear_x, 0.5);
  base.run(1.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_LT(robot::largestDifference(before, base.setpoint.angles), 1e-9);
}

// Nothing goes on by itself: wheels that are steered at standstill stay where they are when the command grows old, or
// becomes zero.
TEST(SteeredMotion, SteeringEndsWithTheCommand) {
  for (const bool grows_old : {true, false}) {
    Base base;
    base.command(0.0, 0.0, 0.4);
    base.run(0.5);
    ASSERT_LT(std::abs(base.drives.angles[0]), 1.0);
    if (!grows_old) base.command(0.0);
    if (grows_old) base.newest.received = base.now - kTimeout, base.keeps_commanding = false;
    const robot::SteeringAngles there = base.drives.angles;
    base.run(2.0);
    EXPECT_EQ(there, base.setpoint.angles);
    EXPECT_EQ(there, base.drives.angles);
  }
}

// Zero does not straighten the wheels.
TEST(SteeredMotion, ZeroKeepsTheAngles) {
  Base base;
  base.command(0.5, 0.5);
  base.run(2.0);
  const robot::SteeringAngles before = base.setpoint.angles;
  base.command(0.0);
  base.run(2.0);
  EXPECT_LT(robot::largestDifference(before, base.setpoint.angles), 1e-9);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
}

// While it is not enabled the wheels' own angles are its setpoint: enabling it moves nothing.
TEST(SteeredMotion, EnablingMovesNothing) {
  Base base;
  base.driving = false;
  base.drives.angles = {0.3, -0.2};
  base.command(0.5);
  base.poll();
  EXPECT_EQ((robot::SteeringAngles{0.3, -0.2}), base.setpoint.angles);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  base.driving = true;
  base.follow = false;
  base.run(1.0);
  EXPECT_EQ((robot::SteeringAngles{0.3, -0.2}), base.setpoint.angles);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
}

// An angle that is not known is no angle: the wheels stand.
TEST(SteeredMotion, WithoutAnAngleThereIsNoMotion) {
  Base base;
  base.command(0.5);
  base.run(1.0);
  base.drives.angles[1] = std::numeric_limits<double>::quiet_NaN();
  base.poll();
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_EQ(SteeredWait::kNoPosition, base.motion.waitsFor());
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.0}), base.setpoint.angles);
  // Counted anew meanwhile, by a reference run: the wheels are not sent back to where they were.
  base.drives.angles = {0.0, 0.4};
  base.command(0.0);
  base.poll();
  EXPECT_EQ((robot::SteeringAngles{0.0, 0.4}), base.setpoint.angles);
}

// P104 > 0: the base drives as a whole or rests as a whole.
TEST(SteeredMotion, DrivesAsAWholeOrRestsAsAWhole) {
  Base base;
  base.drives.minimum.wheels = {2.0, 2.0};
  base.command(0.1);
  base.run(1.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  EXPECT_TRUE(base.motion.belowMinimum());
  base.command(0.5);
  for (int i = 0; i < 300; ++i) {
    for (const double wheel : base.poll().wheels) EXPECT_TRUE(wheel == 0.0 || wheel >= 2.0) << wheel;
  }
  EXPECT_NEAR(5.0, base.setpoint.wheels[0], 1e-9);
  base.command(0.0);
  for (int i = 0; i < 300; ++i) {
    for (const double wheel : base.poll().wheels) EXPECT_TRUE(wheel == 0.0 || wheel >= 2.0) << wheel;
  }
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
  base.drives.minimum.coming_to_rest = true;
  base.command(0.5);
  base.run(1.0);
  EXPECT_EQ((robot::WheelSpeeds{0.0, 0.0}), base.setpoint.wheels);
}

// A circle by the wheels' measured speeds and angles ends where it began.
TEST(SteeredMotion, OdometryOfACircle) {
  Base base;
  const robot::SteeringAngles angles{std::atan(0.5), -std::atan(0.5)};
  const double speed = 0.5 / std::cos(angles[0]) / 0.1;  // half a metre per second at the middle, radius 1 m
  const int cycles = static_cast<int>(std::round(2.0 * 3.14159265358979 / 0.5 / 0.001));
  for (int i = 0; i <= cycles / 2; ++i) base.motion.handleMeasured({speed, speed}, angles, milliseconds{1});
  EXPECT_NEAR(2.0, base.motion.odometry().pose().y, 1e-3);
  for (int i = 0; i < cycles / 2; ++i) base.motion.handleMeasured({speed, speed}, angles, milliseconds{1});
  EXPECT_NEAR(0.0, base.motion.odometry().pose().x, 1e-3);
  EXPECT_NEAR(0.0, base.motion.odometry().pose().y, 1e-3);
  base.motion.handleGap();
  base.motion.handleMeasured({speed, speed}, angles, std::chrono::hours{1});
  EXPECT_NEAR(0.0, base.motion.odometry().pose().x, 1e-3) << "what happened in a gap was not seen";
  base.motion.resetOdometry();
  EXPECT_EQ(0.0, base.motion.odometry().pose().x);
}

// Whatever is commanded, one after the other: the base gets neither faster nor onto another path while a wheel is out of
// tolerance, no limit is passed, no wheel leaves its range; and the last command is driven in the end, or said to be
// none.
RC_GTEST_PROP(SteeredMotionProperty, NeverDrivesOffItsWheelsAndNeverGetsStuck, ()) {
  const double range = *rc::gen::elementOf(std::vector<double>{0.6, 1.2, kQuarter, 3.0});
  Base base{range};
  base.steering_rate = *rc::gen::elementOf(std::vector<double>{0.2, 1.0, 5.0});
  const auto number = [] { return *rc::gen::inRange(-10, 11) / 10.0; };
  const robot::SteeredKinematics kinematics{config(9.0).steered->axles};
  const int commands = *rc::gen::inRange(1, 8);
  for (int i = 0; i < commands; ++i) {
    base.command(number(), number(), number());
    const int cycles = i + 1 == commands ? 2000 : *rc::gen::inRange(1, 300);
    for (int j = 0; j < cycles; ++j) {
      const double before = base.speed();
      const robot::Twist2d twist = base.motion.limited();
      const robot::SteeringAngles stood = base.drives.angles;
      base.poll();
      const robot::Twist2d& now = base.motion.limited();
      const bool other_path = std::abs(now.linear_x * twist.angular_z - now.angular_z * twist.linear_x) > 1e-9 ||
                              std::abs(now.linear_y * twist.angular_z - now.angular_z * twist.linear_y) > 1e-9 ||
                              std::abs(now.linear_x * twist.linear_y - now.linear_y * twist.linear_x) > 1e-9;
      if (base.speed() > before + 1e-9 || other_path) {
        const auto asked = kinematics.solve(base.motion.limited(), stood, stood).angles;
        RC_ASSERT(robot::largestDifference(asked, stood) <= kTolerance + 1e-6);
      }
      const double most = kAcceleration * toSeconds(kCycle) + 1e-9;
      RC_ASSERT(std::abs(base.motion.limited().linear_x - twist.linear_x) <= most);
      RC_ASSERT(std::abs(base.motion.limited().linear_y - twist.linear_y) <= most);
      RC_ASSERT(std::abs(base.motion.limited().angular_z - twist.angular_z) <= most);
      for (const double angle : base.setpoint.angles) RC_ASSERT(std::abs(angle) <= range);
      for (const double wheel : base.setpoint.wheels) RC_ASSERT(std::abs(wheel) <= kFullSpeed + 1e-9);
    }
  }
  const robot::Twist2d possible = robot::SteeredKinematics{config(range).steered->axles}.possible(base.newest.twist);
  RC_ASSERT(std::abs(base.motion.limited().angular_z * possible.linear_x -
                     base.motion.limited().linear_x * possible.angular_z) < 1e-6);
  RC_ASSERT((base.speed() > 0.0) == (possible != robot::Twist2d{}));
}

}  // namespace
}  // namespace nord_driver::cycle

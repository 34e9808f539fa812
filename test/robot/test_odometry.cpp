#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "robot/generators.h"
#include "robot/odometry.h"

namespace nord_driver::robot {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Duration kNoTime{0};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string problemOfWindow(std::size_t size) {
  try {
    Odometry{size};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

// A metre straight on is a metre along the heading.
TEST(Odometry, StraightLine) {
  Odometry odometry{10};
  odometry.reset({1.0, 2.0, kPi / 2.0});
  odometry.moveAlongArc(1.0, 0.0);
  EXPECT_NEAR(1.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(3.0, odometry.pose().y, 1e-12);
  EXPECT_NEAR(kPi / 2.0, odometry.pose().heading, 1e-12);
}

// A quarter circle of radius 1 m to the left ends at (1, 1), in one step: the arc is exact, not a chord.
TEST(Odometry, QuarterCircleInOneStep) {
  Odometry odometry{10};
  odometry.moveAlongArc(kPi / 2.0, kPi / 2.0);
  EXPECT_NEAR(1.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(1.0, odometry.pose().y, 1e-12);
  EXPECT_NEAR(kPi / 2.0, odometry.pose().heading, 1e-12);
}

// To the left the way goes along +y, whatever the heading.
TEST(Odometry, Sideways) {
  Odometry odometry{10};
  odometry.moveAlongArc(0.0, 0.0, 1.0);
  EXPECT_NEAR(0.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(1.0, odometry.pose().y, 1e-12);
  odometry.reset({0.0, 0.0, kPi / 2.0});
  odometry.moveAlongArc(0.0, 0.0, 1.0);
  EXPECT_NEAR(-1.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(0.0, odometry.pose().y, 1e-12);
}

// To the left while turning left by a quarter: the circle about a point 1 m behind the base.
TEST(Odometry, SidewaysQuarterCircleInOneStep) {
  Odometry odometry{10};
  odometry.moveAlongArc(0.0, kPi / 2.0, kPi / 2.0);
  EXPECT_NEAR(-1.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(1.0, odometry.pose().y, 1e-12);
}

// Backwards along an arc that turns left leaves the base to the left behind it.
TEST(Odometry, QuarterCircleBackwards) {
  Odometry odometry{10};
  odometry.moveAlongArc(-kPi / 2.0, kPi / 2.0);
  EXPECT_NEAR(-1.0, odometry.pose().x, 1e-12);
  EXPECT_NEAR(-1.0, odometry.pose().y, 1e-12);
}

// Between a straight line and the slightest arc there is no step.
TEST(Odometry, TinyAngleIsSmooth) {
  for (const double angle : {1e-6, 1e-7, 1e-8, 1e-9, 1e-12}) {
    Odometry odometry{10};
    odometry.moveAlongArc(1.0, angle);
    EXPECT_NEAR(1.0, odometry.pose().x, 1e-11) << angle;
    EXPECT_NEAR(angle / 2.0, odometry.pose().y, 1e-15) << angle;
  }
}

// The heading stays in (-pi, pi], so that consumers see no turn counter.
TEST(Odometry, HeadingIsNormalized) {
  Odometry odometry{10};
  for (int i = 0; i < 7; ++i) odometry.moveAlongArc(0.0, 1.0);
  EXPECT_NEAR(7.0 - 2.0 * kPi, odometry.pose().heading, 1e-12);
  odometry.reset({0.0, 0.0, -kPi});
  EXPECT_DOUBLE_EQ(kPi, odometry.pose().heading);
}

// The way of a cycle is the mean of the velocities at its ends times its measured duration.
TEST(Odometry, IntegratesByTheTrapezoidRule) {
  Odometry odometry{10};
  odometry.update({1.0, 0.0}, seconds(0.01));
  EXPECT_EQ(0.0, odometry.pose().x);
  odometry.update({2.0, 0.0}, seconds(0.02));
  EXPECT_NEAR(0.03, odometry.pose().x, 1e-12);
}

// A cycle that takes twice as long counts twice in the mean velocity.
TEST(Odometry, VelocityIsTheMeanOverTheWindow) {
  Odometry odometry{2};
  EXPECT_EQ((Twist2d{}), odometry.velocity());
  odometry.update({1.0, 0.5}, seconds(0.01));
  EXPECT_EQ((Twist2d{}), odometry.velocity());
  odometry.update({1.0, 0.5}, seconds(0.01));
  EXPECT_NEAR(1.0, odometry.velocity().linear_x, 1e-12);
  EXPECT_NEAR(0.5, odometry.velocity().angular_z, 1e-12);
  odometry.update({3.0, 0.5}, seconds(0.02));
  EXPECT_NEAR((1.0 * 0.01 + 2.0 * 0.02) / 0.03, odometry.velocity().linear_x, 1e-12);
  // The first step falls out of the window of two.
  odometry.update({3.0, 0.5}, seconds(0.01));
  EXPECT_NEAR((2.0 * 0.02 + 3.0 * 0.01) / 0.03, odometry.velocity().linear_x, 1e-12);
}

// Sideways motion is integrated and averaged like the rest.
TEST(Odometry, SidewaysVelocity) {
  Odometry odometry{10};
  odometry.update({0.0, 0.0, 1.0}, seconds(0.01));
  odometry.update({0.0, 0.0, 2.0}, seconds(0.02));
  EXPECT_NEAR(0.03, odometry.pose().y, 1e-12);
  EXPECT_NEAR(1.5, odometry.velocity().linear_y, 1e-12);
  odometry.update({0.0, 0.0, kNan}, seconds(0.02));
  odometry.moveAlongArc(0.0, 0.0, kNan);
  EXPECT_NEAR(0.03, odometry.pose().y, 1e-12);
}

// Drives that come back after a minute continue the pose without a jump, and the gap is no velocity.
TEST(Odometry, RebaseDoesNotJump) {
  Odometry odometry{10};
  odometry.update({1.0, 0.0}, seconds(0.01));
  odometry.update({1.0, 0.0}, seconds(1.0));
  odometry.rebase();
  EXPECT_EQ((Twist2d{}), odometry.velocity());
  odometry.update({0.5, 1.0}, seconds(60.0));
  EXPECT_NEAR(1.0, odometry.pose().x, 1e-12);
  EXPECT_EQ(0.0, odometry.pose().heading);
  EXPECT_EQ((Twist2d{}), odometry.velocity());
  odometry.update({0.5, 0.0}, seconds(0.0));
  odometry.update({0.5, 0.0}, seconds(1.0));
  EXPECT_NEAR(1.5, odometry.pose().x, 1e-12);
}

// reset puts the base where it is told, at rest.
TEST(Odometry, ResetStartsAnew) {
  Odometry odometry{10};
  odometry.update({1.0, 1.0}, seconds(0.01));
  odometry.update({1.0, 1.0}, seconds(1.0));
  odometry.reset();
  EXPECT_EQ(0.0, odometry.pose().x);
  EXPECT_EQ(0.0, odometry.pose().y);
  EXPECT_EQ(0.0, odometry.pose().heading);
  EXPECT_EQ((Twist2d{}), odometry.velocity());
}

// NaN, infinity and time running backwards never reach the pose.
TEST(Odometry, IgnoresNonsense) {
  Odometry odometry{10};
  odometry.update({1.0, 0.0}, seconds(0.01));
  odometry.update({kNan, 0.0}, seconds(0.01));
  odometry.update({1.0, std::numeric_limits<double>::infinity()}, seconds(0.01));
  odometry.update({1.0, 0.0}, seconds(-1.0));
  odometry.moveAlongArc(kNan, 0.0);
  EXPECT_EQ(0.0, odometry.pose().x);
  EXPECT_EQ(0.0, odometry.pose().heading);
  EXPECT_EQ((Twist2d{}), odometry.velocity());
}

// A window that cannot be is refused by its parameter's name.
TEST(Odometry, RefusesAnEmptyWindow) {
  EXPECT_EQ("", problemOfWindow(1));
  EXPECT_THAT(problemOfWindow(0), testing::HasSubstr("velocity_rolling_window_size is 0"));
  EXPECT_THAT(problemOfWindow(Odometry::kMaxWindow + 1), testing::HasSubstr("velocity_rolling_window_size"));
}

// A closed path closes: a polygon of n equal sides and turns, and the same with rounded corners, driven at any slant.
RC_GTEST_PROP(OdometryProperty, ClosedPathsClose, ()) {
  const int corners = *rc::gen::inRange(3, 40);
  const double side = *number(-10.0, 10.0);
  const double slant = *number(-10.0, 10.0);
  const double rounding = *number(0.0, 3.0);
  const int turns = *rc::gen::element(-1, 1, 2);
  Odometry odometry{10};
  odometry.reset({*number(-5.0, 5.0), *number(-5.0, 5.0), *number(-3.0, 3.0)});
  const Pose2d start = odometry.pose();
  for (int i = 0; i < corners; ++i) {
    odometry.moveAlongArc(side, 0.0, slant);
    odometry.moveAlongArc(rounding, 2.0 * kPi * turns / corners, slant);
  }
  RC_ASSERT(std::abs(odometry.pose().x - start.x) < 1e-9);
  RC_ASSERT(std::abs(odometry.pose().y - start.y) < 1e-9);
  RC_ASSERT(std::abs(std::remainder(odometry.pose().heading - start.heading, 2.0 * kPi)) < 1e-9);
}

// An arc in one piece ends where the same arc in pieces ends.
RC_GTEST_PROP(OdometryProperty, ArcsAddUp, ()) {
  const double forward = *number(-10.0, 10.0);
  const double left = *number(-10.0, 10.0);
  const double angle = *number(-6.0, 6.0);
  const int pieces = *rc::gen::inRange(1, 100);
  Odometry whole{1};
  whole.moveAlongArc(forward, angle, left);
  Odometry cut{1};
  for (int i = 0; i < pieces; ++i) cut.moveAlongArc(forward / pieces, angle / pieces, left / pieces);
  RC_ASSERT(std::abs(whole.pose().x - cut.pose().x) < 1e-9);
  RC_ASSERT(std::abs(whole.pose().y - cut.pose().y) < 1e-9);
}

// Driving any way and then the same way back, step by step, ends at the start.
RC_GTEST_PROP(OdometryProperty, ThereAndBackAgain, ()) {
  const auto ways = *rc::gen::container<std::vector<Twist2d>>(twistWithin(1.0, 3.0, 1.0));
  Odometry odometry{10};
  for (const Twist2d& way : ways) odometry.moveAlongArc(way.linear_x, way.angular_z, way.linear_y);
  for (auto way = ways.rbegin(); way != ways.rend(); ++way) {
    odometry.moveAlongArc(-way->linear_x, -way->angular_z, -way->linear_y);
  }
  RC_ASSERT(std::abs(odometry.pose().x) < 1e-9);
  RC_ASSERT(std::abs(odometry.pose().y) < 1e-9);
  RC_ASSERT(std::abs(odometry.pose().heading) < 1e-9);
}

/// One axis of a smooth motion: a level and a swing about it.
struct Swing {
  double level = *number(-1.0, 1.0);
  double size = *number(0.0, 0.5);
  double rate = *number(0.1, 3.0);  // rad/s
  double at(double time) const { return level + size * std::sin(rate * time); }
};

// Against an independent integration: the motion's differential equations in a fixed frame, in steps of 50 us by the
// midpoint rule, while the odometry sees samples with cycles of 4 to 16 ms.
RC_GTEST_PROP(OdometryProperty, AgreesWithAFineIntegration, ()) {
  const Swing forward;
  const Swing left;
  const Swing turn;
  constexpr double kFine = 50e-6;
  Odometry odometry{10};
  double x = 0.0, y = 0.0, heading = 0.0, time = 0.0;
  odometry.update({forward.at(0.0), turn.at(0.0), left.at(0.0)}, kNoTime);
  for (int cycle = 0; cycle < 300; ++cycle) {
    const int steps = 80 + (cycle * 37) % 241;
    for (int i = 0; i < steps; ++i) {
      const double middle = time + kFine / 2.0;
      const double seen = heading + turn.at(time) * kFine / 2.0;
      x += (forward.at(middle) * std::cos(seen) - left.at(middle) * std::sin(seen)) * kFine;
      y += (forward.at(middle) * std::sin(seen) + left.at(middle) * std::cos(seen)) * kFine;
      heading += turn.at(middle) * kFine;
      time += kFine;
    }
    odometry.update({forward.at(time), turn.at(time), left.at(time)}, seconds(steps * kFine));
  }
  RC_ASSERT(std::abs(odometry.pose().x - x) < 1e-3);
  RC_ASSERT(std::abs(odometry.pose().y - y) < 1e-3);
  RC_ASSERT(std::abs(std::remainder(odometry.pose().heading - heading, 2.0 * kPi)) < 1e-3);
}

}  // namespace
}  // namespace nord_driver::robot

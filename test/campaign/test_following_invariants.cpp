// The invariants of what follows what, on moments made by hand: each holds where it must, and can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "campaign/following_invariants.h"
#include "campaign/two_wheels_moment.h"

namespace nord_driver::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSpeedPerHertz = 7.854 / 50.0;  // rad/s at the joint

/// Their ramps are 25 Hz/s.
class FollowingInvariants : public TwoWheelsMoment {
 protected:
  /// The wheels go to `hertz` along their ramp meanwhile, and stay there.
  std::string ramp(Invariant& invariant, double hertz, Duration span) {
    for (const Instant end = moment_.now + span; moment_.now < end;) {
      for (DriveTruth& drive : moment_.drives) {
        const double step = std::clamp(hertz - drive.along, -0.25, 0.25);
        drive.along += step;
      }
      std::string wrong = cycle(invariant);
      if (!wrong.empty()) return wrong;
    }
    return "";
  }
};

TEST_F(FollowingInvariants, AWheelFollowsAlongItsRamp) {
  FollowsItsCommand invariant;
  EXPECT_EQ("", cycle(invariant));
  want(20.0);
  EXPECT_EQ("", ramp(invariant, 20.0, seconds{2}));
  want(-20.0);
  EXPECT_EQ("", ramp(invariant, -20.0, seconds{2}));
}

TEST_F(FollowingInvariants, AWheelThatRestsDoesNotFollow) {
  FollowsItsCommand invariant;
  EXPECT_EQ("", cycle(invariant));
  want(20.0);
  EXPECT_EQ("", ramp(invariant, 0.0, milliseconds{50}));
  EXPECT_THAT(ramp(invariant, 0.0, milliseconds{50}),
              HasSubstr("drive 0 turns its joint with 0 Hz, commanded are 20 Hz"));
}

TEST_F(FollowingInvariants, AWheelThatTurnsTheWrongWayDoesNotFollow) {
  FollowsItsCommand invariant;
  EXPECT_EQ("", cycle(invariant));
  want(20.0);
  EXPECT_THAT(ramp(invariant, -20.0, milliseconds{50}), HasSubstr("commanded are 20 Hz"));
}

// The setpoint goes 10 Hz a second, along its own ramp: 1 s later it is where a ramp of 25 Hz/s is after 0.4 s.
TEST_F(FollowingInvariants, AWheelThatIsToldARampFollowsThat) {
  moment_.setpoint_ramps.assign(2, {10.0, 10.0, {}});
  FollowsItsCommand invariant;
  EXPECT_EQ("", cycle(invariant));
  want(20.0);
  for (DriveTruth& drive : moment_.drives) drive.rise = drive.ramp = 25.0;
  EXPECT_THAT(ramp(invariant, 20.0, seconds{1}), HasSubstr("commanded are 20 Hz: it is between"));
  FollowsItsCommand slower;
  want(0.0);
  for (DriveTruth& drive : moment_.drives) drive.along = 0.0;
  EXPECT_EQ("", cycle(slower));
  want(20.0);
  for (int i = 0; i < 200; ++i) {
    for (DriveTruth& drive : moment_.drives) drive.along = drive.told = std::min(20.0, 0.1 * (i + 1));
    ASSERT_EQ("", cycle(slower)) << i;
  }
}

// A driver that was held up on its way down, and is told to go up again, goes on from where it was.
TEST_F(FollowingInvariants, ARampIsNotCaughtUpWithBehindAStall) {
  moment_.setpoint_ramps.assign(2, {10.0, 10.0, {}});
  FollowsItsCommand invariant;
  const auto turn = [&](double hertz) {
    for (DriveTruth& drive : moment_.drives) drive.along = drive.told = hertz;
    return cycle(invariant);
  };
  want(20.0);
  for (int i = 0; i <= 200; ++i) ASSERT_EQ("", turn(0.1 * i)) << i;
  want(10.0);
  for (int i = 0; i < 10; ++i) ASSERT_EQ("", turn(20.0 - 0.1 * i)) << i;
  moment_.driver_ran = false;
  for (int i = 0; i < 50; ++i) ASSERT_EQ("", turn(19.0)) << i;
  moment_.driver_ran = true;
  want(20.0);
  for (int i = 0; i < 10; ++i) ASSERT_EQ("", turn(19.0 + 0.1 * i)) << i;
  for (int i = 0; i < 20; ++i) ASSERT_EQ("", turn(20.0)) << i;
  // Once it runs again it has its ramp: one that stays is told of.
  want(0.0);
  std::string told;
  for (int i = 0; i < 200 && told.empty(); ++i) told = turn(20.0);
  EXPECT_THAT(told, HasSubstr("commanded are 0 Hz"));
}

// On its way from one command to the other a wheel of a base may be anywhere between the two for as long as that takes.
TEST_F(FollowingInvariants, AWheelOfABaseThatLimitsItsAccelerationHasItsTime) {
  moment_.setpoint_ramps.assign(2, {SetpointRamp::kAtOnce, 30.0, seconds{2}});
  FollowsItsCommand invariant;
  EXPECT_EQ("", cycle(invariant));
  want(20.0);
  EXPECT_EQ("", ramp(invariant, 5.0, seconds{2}));
  EXPECT_EQ("", ramp(invariant, 20.0, seconds{1}));
  EXPECT_THAT(ramp(invariant, 15.0, seconds{1}), HasSubstr("commanded are 20 Hz"));
}

TEST_F(FollowingInvariants, ASetpointStaysWithinItsRamp) {
  moment_.setpoint_ramps.assign(2, {10.0, 10.0, {}});
  SetpointWithinRamp invariant;
  const auto tell = [&](double hertz) {
    for (DriveTruth& drive : moment_.drives) drive.told = hertz;
    return cycle(invariant);
  };
  EXPECT_EQ("", tell(0.0));
  for (int i = 0; i < 100; ++i) ASSERT_EQ("", tell(0.1 * i));
  // Words may have been under way for 50 ms.
  EXPECT_EQ("", tell(10.5));
  EXPECT_THAT(tell(9.0), HasSubstr("drive 0 is told 9 Hz 0.01 s after 10.5 Hz: its ramp is 10 Hz/s"));
}

TEST_F(FollowingInvariants, WhoIsStoppedIsToldZeroAtOnceAndNothingElse) {
  moment_.setpoint_ramps.assign(2, {10.0, 10.0, {}});
  const auto jumps = [&](double hertz, bool enabled) {
    SetpointWithinRamp invariant;
    moment_.snapshot = &snapshot_;
    snapshot_.base.enabled = true;
    for (DriveTruth& drive : moment_.drives) drive.told = 20.0;
    EXPECT_EQ("", cycle(invariant));
    EXPECT_EQ("", cycle(invariant));
    snapshot_.base.enabled = enabled;
    for (DriveTruth& drive : moment_.drives) drive.told = hertz;
    return cycle(invariant);
  };
  EXPECT_EQ("", jumps(0.0, false));
  EXPECT_NE("", jumps(0.0, true));
  EXPECT_NE("", jumps(1.0, false));
}

// It rests by OFF1 below its slowest speed: whether it follows cannot be told then, and its setpoint comes and goes at once.
TEST_F(FollowingInvariants, WhoCannotTurnSlowlyIsToldZeroAtOnce) {
  moment_.setpoint_ramps.assign(2, {10.0, 10.0, {}});
  for (DriveTruth& drive : moment_.drives) drive.slowest = 3.0;
  FollowsItsCommand follows;
  want(20.0);
  EXPECT_EQ("", ramp(follows, 0.0, seconds{1}));
  SetpointWithinRamp within;
  for (const double hertz : {0.0, 3.5, 0.0, 3.5}) {
    for (DriveTruth& drive : moment_.drives) drive.told = hertz;
    EXPECT_EQ("", cycle(within));
  }
  for (DriveTruth& drive : moment_.drives) drive.told = 5.5;
  EXPECT_THAT(cycle(within), HasSubstr("is told 5.5 Hz"));
}

// From before it was enabled, it is not obeyed; and what is on its way down by its time-outs is no wheel that follows.
TEST_F(FollowingInvariants, OnlyWhoIsEnabledByACommandFollows) {
  FollowsItsCommand invariant;
  moment_.renewed = {false, false};
  want(20.0);
  EXPECT_EQ("", ramp(invariant, 0.0, seconds{1}));
  moment_.renewed = {true, true};
  moment_.drives[1].state = sim::InverterState::kFault;
  EXPECT_EQ("", ramp(invariant, 0.0, seconds{1}));
  moment_.drives[1].state = sim::InverterState::kOperationEnabled;
  moment_.groups[0].confirmed = false;
  EXPECT_EQ("", ramp(invariant, 0.0, seconds{1}));
}

TEST_F(FollowingInvariants, TheVelocityToldIsThatOfTheWheel) {
  MotionToldAsItIs invariant;
  EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[1].velocity = 0.1;
  EXPECT_THAT(cycle(invariant), HasSubstr("joint 1 is told with 0.1 rad/s"));
  snapshot_.drives[1].velocity = 0.0;
  moment_.drives[1].along = 10.0;
  for (int i = 0; i < 6; ++i) EXPECT_EQ("", cycle(invariant)) << "it is told a little later";
  EXPECT_THAT(ramp(invariant, 10.0, milliseconds{50}), HasSubstr("joint 1 is told with 0 rad/s"));
}

TEST_F(FollowingInvariants, TheVelocityToldMayBeThatOfTheShaft) {
  for (DriveTruth& drive : moment_.drives) drive.shaft_along = 20.0;
  for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.velocity = 20.0 * kSpeedPerHertz;
  MotionToldAsItIs of_shaft;
  EXPECT_EQ("", cycle(of_shaft));
  moment_.drives[1].shaft_along.reset();
  MotionToldAsItIs of_field;
  EXPECT_THAT(cycle(of_field), HasSubstr("joint 1 is told with 3.1416 rad/s"));
}

TEST_F(FollowingInvariants, TheWayToldIsThatOfTheWheel) {
  MotionToldAsItIs invariant;
  EXPECT_EQ("", cycle(invariant));
  moment_.drives[0].along = moment_.drives[1].along = 10.0;
  for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.velocity = 10.0 * kSpeedPerHertz;
  std::string wrong;
  for (int i = 0; i < 100 && wrong.empty(); ++i) {
    for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.joint_position += 0.1 * kSpeedPerHertz;
    wrong = cycle(invariant);
  }
  EXPECT_EQ("", wrong);
  for (int i = 0; i < 100 && wrong.empty(); ++i) wrong = cycle(invariant);
  EXPECT_THAT(wrong, HasSubstr("joint 0 is told to have turned 1.57"));
}

TEST_F(FollowingInvariants, ThePoseIsThatOfTheWheels) {
  PoseAsTheWheels invariant;
  for (int i = 0; i < 5; ++i) EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[0].joint_position = snapshot_.drives[1].joint_position = 0.05;
  snapshot_.base.pose.x = 0.005;
  EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[1].joint_position = 0.10;
  snapshot_.base.pose.x = 0.0075;
  EXPECT_THAT(cycle(invariant), HasSubstr("the pose goes 0.0025 m and 0 rad, the wheels 0.0025 m and 0.01 rad"));
  snapshot_.base.pose.heading = 2.0 * kPi;
  snapshot_.drives[0].joint_position = 0.20;
  EXPECT_THAT(cycle(invariant), HasSubstr("the pose goes"));
}

// Who stood in for the first drive may have told its P105 for that of the drive.
TEST_F(FollowingInvariants, ADriveThatIsTakenForAnotherIsNotJudged) {
  MotionToldAsItIs motion;
  FollowsItsCommand follows;
  EXPECT_EQ("", cycle(motion));
  EXPECT_EQ("", cycle(follows));
  moment_.stand_in_believed = true;
  snapshot_.drives[0].velocity = 1.0;
  want(20.0);
  EXPECT_EQ("", cycle(motion));
  for (int i = 0; i < 20; ++i) EXPECT_EQ("", cycle(follows));
  moment_.stand_in_believed = false;
  EXPECT_THAT(cycle(motion), HasSubstr("joint 0 is told with 1 rad/s"));
}

TEST_F(FollowingInvariants, TheVelocityOfAWheelWhoseP105IsNotKnownIsNotJudged) {
  MotionToldAsItIs invariant;
  moment_.reads_scale = true;
  snapshot_.drives[1].parameter_set = 2;
  snapshot_.drives[1].velocity = 1.0;
  EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[1].device.max_frequency[0] = 50.0;
  EXPECT_EQ("", cycle(invariant)) << "that of another set";
  snapshot_.drives[1].device.max_frequency[1] = 50.0;
  EXPECT_THAT(cycle(invariant), HasSubstr("joint 1 is told with 1 rad/s"));
}

TEST_F(FollowingInvariants, ThePoseOfAWheelWhoseP105IsNotKnownIsNotJudged) {
  PoseAsTheWheels invariant;
  moment_.reads_scale = true;
  for (cycle::DriveSnapshot& drive : snapshot_.drives) drive.parameter_set = 2;
  snapshot_.drives[0].device.max_frequency[1] = 50.0;
  for (int i = 0; i < 6; ++i) EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[0].joint_position = 0.05;
  EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[1].device.max_frequency[1] = 50.0;
  for (int i = 0; i < 6; ++i) EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[0].joint_position = 0.10;
  EXPECT_THAT(cycle(invariant), HasSubstr("the pose goes 0 m"));
}

TEST_F(FollowingInvariants, ThePoseOfADriveThatIsSilentIsNotJudged) {
  PoseAsTheWheels invariant;
  for (int i = 0; i < 5; ++i) EXPECT_EQ("", cycle(invariant));
  snapshot_.drives[0].online = false;
  snapshot_.drives[1].joint_position = 0.05;
  EXPECT_EQ("", cycle(invariant));
}

}  // namespace
}  // namespace nord_driver::test

// The velocity of a drive that belongs to no base: along its limits to what is commanded, and along them to rest.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cycle/cycle_bench.h"
#include "cycle/joint_motion.h"

namespace nord_driver::cycle {
namespace {

constexpr double kFull = 157.07963267948966;  // rad/s at the joint, 50 Hz
constexpr Duration kStep = std::chrono::milliseconds{10};

robot::SpeedLimits limits(double velocity, double acceleration, double jerk = 0.0) {
  robot::SpeedLimits limits;
  limits.has_velocity_limits = velocity > 0.0;
  limits.max_velocity = velocity;
  limits.has_acceleration_limits = acceleration > 0.0;
  limits.max_acceleration = acceleration;
  limits.has_jerk_limits = jerk > 0.0;
  limits.max_jerk = jerk;
  return limits;
}

const JointBounds kFree{kFull, 0.0, false};

TEST(JointMotion, WithoutLimitsItIsTheCommand) {
  JointMotion motion{{}};
  EXPECT_EQ(37.3, motion.pollVelocity(37.3, true, kFree, kStep));
  EXPECT_EQ(-0.1, motion.pollVelocity(-0.1, true, kFree, kStep));
  EXPECT_EQ(0.0, motion.pollVelocity(0.0, true, kFree, kStep));
}

TEST(JointMotion, GoesToItsTargetAlongTheLimits) {
  JointMotion motion{limits(5.0, 10.0)};
  EXPECT_DOUBLE_EQ(0.1, motion.pollVelocity(8.0, true, kFree, kStep));
  for (int i = 0; i < 100; ++i) motion.pollVelocity(8.0, true, kFree, kStep);
  EXPECT_EQ(5.0, motion.pollVelocity(8.0, true, kFree, kStep)) << "max_velocity";
  EXPECT_FALSE(motion.isSaturated()) << "what is configured is no saturation";
  EXPECT_DOUBLE_EQ(4.9, motion.pollVelocity(0.0, true, kFree, kStep));
  for (int i = 0; i < 49; ++i) motion.pollVelocity(0.0, true, kFree, kStep);
  EXPECT_EQ(0.0, motion.pollVelocity(0.0, true, kFree, kStep)) << "exactly";
}

// Within the jerk limit it would go on gaining speed for half a second.
TEST(JointMotion, AStopSlowsDownFromItsFirstStepOn) {
  JointMotion motion{limits(0.0, 10.0, 20.0)};
  double before = 0.0;
  for (int i = 0; i < 60; ++i) before = motion.pollVelocity(80.0, true, kFree, kStep);
  EXPECT_GT(motion.pollVelocity(0.0, true, kFree, kStep), before) << "a command of zero keeps the jerk limit";
  for (int i = 0; i < 200; ++i) before = motion.pollVelocity(80.0, true, kFree, kStep);
  JointBounds stop = kFree;
  stop.stops = true;
  for (int i = 0; i < 5; ++i) {
    const double now = motion.pollVelocity(0.0, true, stop, kStep);
    EXPECT_LT(now, before) << i;
    before = now;
  }
}

TEST(JointMotion, ADriveThatIsNotDrivingBeginsAnew) {
  JointMotion motion{limits(0.0, 10.0)};
  for (int i = 0; i < 10; ++i) motion.pollVelocity(8.0, true, kFree, kStep);
  EXPECT_EQ(0.0, motion.pollVelocity(8.0, false, kFree, kStep));
  EXPECT_DOUBLE_EQ(0.1, motion.pollVelocity(8.0, true, kFree, kStep));
}

// Braking from beyond 100 % would begin with a time in which nothing gets slower.
TEST(JointMotion, TheRampEndsAtFullSpeed) {
  JointMotion motion{limits(0.0, 1000.0)};
  for (int i = 0; i < 100; ++i) motion.pollVelocity(2.0 * kFull, true, kFree, kStep);
  EXPECT_EQ(kFull, motion.pollVelocity(2.0 * kFull, true, kFree, kStep));
  EXPECT_TRUE(motion.isSaturated());
  EXPECT_DOUBLE_EQ(kFull - 10.0, motion.pollVelocity(0.0, true, kFree, kStep));
  EXPECT_FALSE(motion.isSaturated());
}

// P104: on the way it is not touched, so that the motor does not turn faster than the ramp says.
TEST(JointMotion, OnItsWayItStandsWhileItWouldBeTooSlow) {
  JointMotion motion{limits(0.0, 100.0)};
  const JointBounds slow{kFull, 4.5, false};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep));
  EXPECT_DOUBLE_EQ(5.0, motion.pollVelocity(10.0, true, slow, kStep));
  EXPECT_EQ(0.0, motion.pollVelocity(0.0, true, slow, kStep)) << "down from 5 it has arrived";
  EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep)) << "and begins anew";
  EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, {kFull, 4.5, true}, kStep));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep)) << "OFF1 was on its way";
  EXPECT_DOUBLE_EQ(5.0, motion.pollVelocity(10.0, true, slow, kStep));
}

// At P104 itself the motor turns as commanded.
TEST(JointMotion, AtItsLeastSpeedItGoesOut) {
  JointMotion motion{limits(0.0, 100.0)};
  const JointBounds slow{kFull, 2.0, false};
  EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep));
  EXPECT_EQ(2.0, motion.pollVelocity(10.0, true, slow, kStep));
}

// The motor would turn at P104, faster than it may, where the command itself is slower than its limit.
TEST(JointMotion, AVelocityLimitBelowItsLeastSpeedLetsItStand) {
  robot::SpeedLimits forward = limits(5.0, 100.0);
  forward.min_velocity = -2.0;
  const JointBounds slow{kFull, 4.5, false};
  for (const double target : {-1.0, -2.0, -4.5, -10.0, -2.0 * kFull}) {
    JointMotion motion{forward};
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(0.0, motion.pollVelocity(target, true, slow, kStep)) << target << ", " << i;
      EXPECT_TRUE(motion.isSaturated()) << target;
    }
    EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep)) << "from standstill, " << target;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(0.0, motion.pollVelocity(10.0, true, slow, kStep)) << target;
    EXPECT_DOUBLE_EQ(5.0, motion.pollVelocity(10.0, true, slow, kStep));
    EXPECT_FALSE(motion.isSaturated()) << "what is configured is no saturation";
    EXPECT_EQ(5.0, motion.pollVelocity(10.0, true, slow, kStep));
    EXPECT_EQ(0.0, motion.pollVelocity(target, true, slow, kStep)) << "reversed, it has arrived below P104";
  }
}

TEST(JointMotion, AVelocityLimitAtItsLeastSpeedIsDriven) {
  for (const double limit : {4.5, 4.5 * (1.0 - 1e-15), 4.5 * (1.0 + 1e-15)}) {
    for (const double target : {4.5, 10.0, 7.3, -9.7}) {
      JointMotion motion{limits(limit, 100.0)};
      double velocity = 0.0;
      for (int i = 0; i < 20; ++i) velocity = motion.pollVelocity(target, true, {kFull, 4.5, false}, kStep);
      EXPECT_NEAR(std::copysign(4.5, target), velocity, 1e-12) << limit - 4.5 << ", " << target;
      EXPECT_FALSE(motion.isSaturated());
    }
  }
}

// `min_velocity: 0` is a direction that is not asked for: no saturation, as without a P104.
TEST(JointMotion, ADirectionThatIsLimitedToZeroIsLeftAtRest) {
  robot::SpeedLimits forward = limits(50.0, 100.0);
  forward.min_velocity = 0.0;
  for (const double least : {0.0, 4.5}) {
    JointMotion motion{forward};
    const JointBounds slow{kFull, least, false};
    for (int i = 0; i < 20; ++i) motion.pollVelocity(10.0, true, slow, kStep);
    for (int i = 0; i < (least > 0.0 ? 6 : 10); ++i) motion.pollVelocity(-10.0, true, slow, kStep);
    EXPECT_EQ(0.0, motion.pollVelocity(-10.0, true, slow, kStep));
    EXPECT_FALSE(motion.isSaturated());
    double velocity = 0.0;
    for (int i = 0; i < 5; ++i) velocity = motion.pollVelocity(10.0, true, slow, kStep);
    EXPECT_DOUBLE_EQ(5.0, velocity) << "from standstill";
  }
}

// One that others follow: slower than the highest P104 of them all it stands.
TEST(JointMotion, ATargetThatIsTooSlowForAFollowerIsNone) {
  JointMotion motion{limits(0.0, 100.0)};
  const JointBounds led{kFull, 4.5, false, false, 4.5};
  EXPECT_EQ(0.0, motion.pollVelocity(-4.4, true, led, kStep));
  EXPECT_TRUE(motion.isSaturated());
  EXPECT_EQ(0.0, motion.pollVelocity(0.0, true, led, kStep));
  EXPECT_FALSE(motion.isSaturated());
  for (int i = 0; i < 4; ++i) EXPECT_EQ(0.0, motion.pollVelocity(-4.5, true, led, kStep));
  EXPECT_DOUBLE_EQ(-4.5, motion.pollVelocity(-4.5, true, led, kStep));
  EXPECT_FALSE(motion.isSaturated());
}

// The ramp would run on alone into the direction that there is not, and come back from there.
TEST(JointMotion, ATargetInADirectionThatItDoesNotHaveIsNone) {
  for (const double only : {1.0, -1.0}) {
    JointMotion motion{limits(0.0, 100.0)};
    JointBounds bounds = kFree;
    bounds.only_direction = only;
    EXPECT_EQ(only, motion.pollVelocity(5.0 * only, true, bounds, kStep));
    EXPECT_FALSE(motion.isSaturated());
    for (int i = 0; i < 20; ++i) EXPECT_EQ(0.0, motion.pollVelocity(-5.0 * only, true, bounds, kStep));
    EXPECT_TRUE(motion.isSaturated());
    EXPECT_EQ(only, motion.pollVelocity(5.0 * only, true, bounds, kStep)) << "at once";
  }
}

TEST(JointMotion, JerkIsLimitedToo) {
  JointMotion motion{limits(0.0, 10.0, 100.0)};
  double last = 0.0, acceleration = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double velocity = motion.pollVelocity(5.0, true, kFree, kStep);
    const double next = (velocity - last) / 0.01;
    EXPECT_LE(std::abs(next), 10.0 + 1e-9);
    EXPECT_LE(std::abs(next - acceleration), 1.0 + 1e-6);
    last = velocity;
    acceleration = next;
  }
  EXPECT_EQ(5.0, last);
}

CycleConfig liftWith(const robot::SpeedLimits& limits, const drive::StopWays& ways = {}) {
  CycleConfig config = CycleBench::config(std::nullopt, 0.0, ways);
  config.drives[CycleBench::kLift].limits = limits;
  return config;
}

/// The lift of the bench: 8192 is half of its 157 rad/s, and its limit takes one second to full speed.
class SingleDriveLimits : public ::testing::Test, protected CycleBench {
 protected:
  SingleDriveLimits() : CycleBench(liftWith(limits(kFull / 2, kFull))) {}

  void begin() {
    run(80);
    const Completion answer = ask(RequestKind::kEnable, kLift);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  void hold(double velocity, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandLift(velocity);
      step();
    }
  }
  bool runs() const { return (controlWord(kLift) & 0x7F) == 0x7F; }
};

TEST_F(SingleDriveLimits, RampUpToMaxVelocity) {
  begin();
  hold(kFull, 25);
  EXPECT_NEAR(0x1000, setpoint(kLift), 2);
  hold(kFull, 50);
  EXPECT_EQ(0x2000, setpoint(kLift));
  hold(-kFull, 25);
  EXPECT_NEAR(0x1000, setpoint(kLift), 2) << "along the deceleration limit";
}

TEST_F(SingleDriveLimits, AnOldCommandIsLeftAlongTheDecelerationLimit) {
  begin();
  hold(kFull, 60);
  run(52);  // cmd_vel_timeout is 0.5 s
  EXPECT_GT(setpoint(kLift), 0x1E00);
  EXPECT_LT(setpoint(kLift), 0x2000) << "two cycles to the first smaller setpoint";
  run(24);
  EXPECT_NEAR(0x1000, setpoint(kLift), 0x200);
  run(30);
  EXPECT_EQ(0, setpoint(kLift));
  EXPECT_TRUE(runs()) << "the time-out stays enabled";
}

TEST_F(SingleDriveLimits, DisablingRampsDownBeforeOff1) {
  begin();
  hold(kFull, 60);
  Request disable;
  disable.kind = RequestKind::kDisable;
  disable.drive = kLift;
  disable.id = 77;
  disable.patience = std::chrono::seconds{3};
  ports.submit(disable);
  hold(kFull, 25);  // what is still commanded no longer counts
  EXPECT_TRUE(runs());
  EXPECT_NEAR(0x1000, setpoint(kLift), 0x200);
  hold(kFull, 27);
  EXPECT_EQ(0, setpoint(kLift));
  run(100);
  EXPECT_EQ(0x047E, controlWord(kLift));
  EXPECT_TRUE(completions[77].success) << completions[77].message.c_str();
}

TEST_F(SingleDriveLimits, AQuickStopDoesNotWaitForTheRamp) {
  begin();
  hold(kFull, 60);
  Request stop;
  stop.kind = RequestKind::kQuickStop;
  stop.drive = kLift;
  stop.id = 78;
  stop.patience = std::chrono::seconds{3};
  ports.submit(stop);
  run(2);
  EXPECT_EQ(0x047B, controlWord(kLift));
}

// 5 Hz are 15.7 rad/s: faster than the limit, whatever is commanded.
TEST(SingleDriveMinimum, ALimitBelowP104LetsTheDriveRest) {
  for (const double limit : {10.0, 20.0}) {
    CycleConfig config = liftWith(limits(limit, 10.0 * kFull));
    config.drives[CycleBench::kLift].drive.allow_minimum_frequency = true;
    CycleBench bench{config};
    bench.transport.of_drive[CycleBench::kLift][104] = 50;  // 0.1 Hz
    bench.transport.inverters[CycleBench::kLift].minimum = 1638;
    bench.run(80);
    ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
    for (const double velocity : {8.0, -8.0, 18.0, -157.0}) {
      for (int i = 0; i < 200; ++i) {
        bench.commandLift(velocity);
        bench.step();
        ASSERT_TRUE(limit > 15.0 || bench.transport.inverters[CycleBench::kLift].frequency() == 0) << velocity;
      }
      EXPECT_EQ(limit < 15.0 || std::abs(velocity) < 15.0, bench.snapshot().drives[CycleBench::kLift].saturated);
      EXPECT_EQ(limit < 15.0, bench.controlWord(CycleBench::kLift) == 0x047E) << limit << ", " << velocity;
    }
  }
}

TEST_F(SingleDriveLimits, BeyondFullSpeedIsToldOfADriveWithoutVelocityLimit) {
  CycleBench other{liftWith(limits(0.0, 100.0 * kFull))};
  other.run(80);
  ASSERT_TRUE(other.ask(RequestKind::kEnable, kLift).success);
  for (int i = 0; i < 10; ++i) {
    other.commandLift(2.0 * kFull);
    other.step();
  }
  EXPECT_EQ(0x4000, other.setpoint(kLift));
  EXPECT_TRUE(other.snapshot().drives[kLift].saturated);
}

}  // namespace
}  // namespace nord_driver::cycle

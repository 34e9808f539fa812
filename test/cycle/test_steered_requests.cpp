// What is asked of a steered base, and what it tells: reference runs of its axes, angles they do not take, stops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/steered_cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The base, and a lift beside it that positions, too.
CycleConfig withLift() {
  CycleConfig config = SteeredBench::config();
  DriveSetup lift = config.drives[2];
  lift.name = "lift";
  config.drives.push_back(lift);
  return config;
}

class SteeredRequests : public ::testing::Test, protected SteeredBench {
 protected:
  static constexpr DriveIndex kFront = 2, kLiftBeside = 4;

  explicit SteeredRequests(const CycleConfig& config = withLift()) : SteeredBench{config} {
    if (transport.inverters.size() <= kLiftBeside) return;
    transport.of_drive[kLiftBeside] = transport.of_drive[kFront];
    transport.inverters[kLiftBeside].ramp = 0;
    transport.interrupted[kLiftBeside] = true;  // read anew
    run(200);
  }
  bool enable() {
    const bool enabled = ask(RequestKind::kEnable).success;
    events();
    return enabled;
  }
  void drive(double linear, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandBase(linear);
      step();
    }
  }
  bool isAskedForItsRun(DriveIndex drive) const { return (controlWord(drive) & 0x0100) != 0; }
  int sentAngle(DriveIndex drive) const { return transport.outputs[drive].setpoints[1]; }
};

// On its way through it an axis turns its wheel to where the base does not go.
TEST_F(SteeredRequests, AReferenceRunNeedsTheBaseEnabledAtStandstill) {
  constexpr const char* kWhy =
      "drive front_steering steers the base, and the base is not enabled at standstill: no reference run";
  const auto expectRefused = [&](const char* when) {
    const std::uint32_t home = submit(RequestKind::kHome, kFront);
    commandBase(0.0);
    run(2);
    EXPECT_FALSE(completions[home].success) << when;
    EXPECT_EQ(kWhy, completions[home].message.str()) << when;
    EXPECT_FALSE(isAskedForItsRun(kFront)) << when;
  };
  expectRefused("not enabled");
  ASSERT_TRUE(enable());
  drive(0.5, 50);
  expectRefused("it drove until now");
  drive(0.0, 100);
  const std::uint32_t home = submit(RequestKind::kHome, kFront);
  run(3);
  EXPECT_EQ(0u, completions.count(home)) << completions[home].message.c_str();
  EXPECT_TRUE(isAskedForItsRun(kFront));
}

TEST_F(SteeredRequests, NoReferenceRunBeginsWhileAWheelTurns) {
  ASSERT_TRUE(enable());
  for (const DriveIndex wheel : {0, 1}) transport.inverters[wheel].minimum = 500;
  run(20);
  ASSERT_EQ(robot::Twist2d{}, snapshot().base.command);
  EXPECT_THAT(ask(RequestKind::kHome, kFront).message.str(), HasSubstr("the base is not enabled at standstill"));
  EXPECT_FALSE(isAskedForItsRun(kFront));
}

TEST_F(SteeredRequests, AReferenceRunOfADriveBesideTheBaseIsNotItsMatter) {
  const Completion enabled = ask(RequestKind::kEnable, kLiftBeside);
  ASSERT_TRUE(enabled.success) << enabled.message.c_str();
  ASSERT_FALSE(snapshot().base.enabled);
  const std::uint32_t home = submit(RequestKind::kHome, kLiftBeside);
  run(3);
  EXPECT_EQ(0u, completions.count(home)) << completions[home].message.c_str();
  EXPECT_TRUE(isAskedForItsRun(kLiftBeside));
}

TEST_F(SteeredRequests, ResettingTheOdometryMakesItsPoseZero) {
  ASSERT_TRUE(enable());
  drive(0.5, 100);
  drive(0.0, 50);
  ASSERT_GT(snapshot().base.pose.x, 0.1);
  EXPECT_TRUE(ask(RequestKind::kResetOdometry).success);
  EXPECT_EQ(0.0, snapshot().base.pose.x);
}

// Ramped down to setpoint 0 it is switched off, and nothing that would have to end it first.
TEST_F(SteeredRequests, IsDisabledOnceItsSetpointIsZero) {
  ASSERT_TRUE(enable());
  drive(0.5, 100);
  const std::uint32_t disable = submit(RequestKind::kDisable, kAllDrives);
  run(50);
  ASSERT_EQ(1u, completions.count(disable));
  EXPECT_TRUE(completions[disable].success) << completions[disable].message.c_str();
  for (const DriveIndex i : {0, 1, 2, 3}) EXPECT_EQ(0x047E, controlWord(i)) << i;
}

// Its wheels have stood for most of the time nobody looked.
TEST_F(SteeredRequests, AHeldUpCycleIsNoWayOfIt) {
  ASSERT_TRUE(enable());
  drive(0.5, 100);
  const double before = snapshot().base.pose.x;
  transport.time += std::chrono::seconds{30};
  run(10);
  EXPECT_NEAR(before, snapshot().base.pose.x, 0.1);
}

// A wheel that turns as it is told is not saturated; nor is what steers it where the wheels are too slow for the command.
TEST_F(SteeredRequests, OnlyWheelsAreBeyondTheirSpeed) {
  ASSERT_TRUE(enable());
  drive(0.5, 50);
  for (const DriveIndex i : {0, 1, 2, 3}) EXPECT_FALSE(snapshot().drives[i].saturated) << i;
  drive(100.0, 50);
  for (const DriveIndex wheel : {0, 1}) EXPECT_TRUE(snapshot().drives[wheel].saturated) << wheel;
  for (const DriveIndex steering : {2, 3}) EXPECT_FALSE(snapshot().drives[steering].saturated) << steering;
}

// Down their own ramp (P103), which is longer than a second, they roll: steered meanwhile they would be dragged sideways.
TEST_F(SteeredRequests, ItIsNotSteeredWhileItsWheelsComeDownALongRamp) {
  ASSERT_TRUE(enable());
  drive(1.0, 100);
  for (const DriveIndex wheel : {0, 1}) transport.inverters[wheel].ramp = 2;
  int rolling = 0;
  for (int i = 0; i < 600; ++i) {
    driveSideways(1);
    if (transport.inverters[0].frequency() <= 200) break;
    ASSERT_EQ(0, sentAngle(kFront)) << i;
    ++rolling;
  }
  EXPECT_GT(rolling, 300);
  driveSideways(300);
  EXPECT_NE(0, sentAngle(kFront));
}

// On a slope they get no slower, or next to nothing: it steers all the same, as far as that goes.
TEST_F(SteeredRequests, ItIsSteeredWhereItsWheelsGetNoSlower) {
  ASSERT_TRUE(enable());
  drive(0.0, 20);
  const auto roll = [this](int speed) {
    for (const DriveIndex wheel : {0, 1}) transport.inverters[wheel].minimum = static_cast<std::int16_t>(speed);
  };
  roll(500);
  drive(0.0, 5);
  driveSideways(50);
  EXPECT_EQ(0, sentAngle(kFront)) << "they may get slower";
  for (int i = 0; i < 150; ++i) {
    roll(500 - i / 20);
    driveSideways(1);
  }
  EXPECT_NE(0, sentAngle(kFront)) << "5 of 16384 in a second are no ramp";
}

// Each wait counts by itself.
TEST_F(SteeredRequests, AWaitThatEndedIsNotCountedOn) {
  ASSERT_TRUE(enable());
  driveSideways(400);
  drive(0.0, 100);
  ASSERT_TRUE(snapshot().base.waits.empty()) << snapshot().base.waits.c_str();
  driveSideways(400);
  EXPECT_EQ("the base waits until its wheels are steered", snapshot().base.waits.str());
  EXPECT_THAT(events(), IsEmpty());
  driveSideways(101);
  EXPECT_THAT(events(), ElementsAre("warning: the base waits until its wheels are steered"));
}

class SteeredAxisOfANarrowJoint : public SteeredRequests {
 protected:
  SteeredAxisOfANarrowJoint() : SteeredRequests{narrow()} {}
  static CycleConfig narrow() {
    CycleConfig config = SteeredBench::config();
    config.drives[kFront].position->axis.upper = 0.3;
    config.drives[kFront].position->axis.lower = -0.3;
    config.drives[kFront].drive.position = config.drives[kFront].position->axis;
    return config;
  }
};

// That does not pass by itself: it is told at once.
TEST_F(SteeredAxisOfANarrowJoint, AnAngleAnAxisDoesNotTakeIsToldAtOnce) {
  ASSERT_TRUE(enable());
  driveSideways(1);
  const auto told = events();
  ASSERT_EQ(1u, told.size());
  EXPECT_THAT(told[0], HasSubstr("warning: drive front_steering does not take the steering angle "));
  EXPECT_THAT(told[0], HasSubstr("1.571: it is "));
  EXPECT_THAT(told[0], HasSubstr("the joint's "));
  EXPECT_THAT(snapshot().base.waits.str(), HasSubstr("drive front_steering does not take"));
}

class SteeredBaseThatStopsQuickly : public SteeredRequests {
 protected:
  SteeredBaseThatStopsQuickly() : SteeredRequests{quick()} {}
  static CycleConfig quick() {
    CycleConfig config = SteeredBench::config();
    config.stop_ways.command_timeout = drive::StopWay::kQuickStop;
    return config;
  }
};

TEST_F(SteeredBaseThatStopsQuickly, ACommandThatIsTooOldStopsItAsChosen) {
  ASSERT_TRUE(enable());
  drive(0.5, 100);
  EXPECT_TRUE(snapshot().base.enabled);
  run(60);
  EXPECT_FALSE(snapshot().base.enabled);
  EXPECT_EQ(drive::StopCause::kCommandTimeout, snapshot().base.stop_cause);
}

}  // namespace
}  // namespace nord_driver::cycle

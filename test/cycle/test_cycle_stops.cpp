// What the cycle itself sees to when something stops: the age of the commands, and where the next start begins.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

drive::StopWays quickStopWhenTooOld() {
  drive::StopWays ways;
  ways.command_timeout = drive::StopWay::kQuickStop;
  return ways;
}

// The way chosen for a command that is too old is that of the base and of a drive alone, each by its own commands.
TEST(CycleStops, ACommandThatIsTooOldStopsItsGroupAsChosen) {
  CycleBench bench{std::nullopt, 0.0, quickStopWhenTooOld()};
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  bench.commandLift(10.0);
  bench.run(20);
  bench.commandBase(0.5);
  bench.run(30);
  EXPECT_EQ(0x047F, bench.controlWord(CycleBench::kLift)) << "not too old yet";
  bench.run(3);
  EXPECT_FALSE(bench.snapshot().drives[CycleBench::kLift].enabled);
  EXPECT_EQ(drive::StopCause::kCommandTimeout, bench.snapshot().drives[CycleBench::kLift].stop_cause);
  EXPECT_EQ(0x047F, bench.controlWord(CycleBench::kLeft)) << "its command is younger";
  bench.run(20);
  EXPECT_EQ(drive::StopCause::kCommandTimeout, bench.snapshot().base.stop_cause);
  EXPECT_FALSE(bench.snapshot().drives[CycleBench::kLeft].enabled);
  EXPECT_FALSE(bench.snapshot().drives[CycleBench::kRight].enabled);
}

// Ramped down and switched off by OFF1, or stopped because it was asked to be: the first is told, the second needs no telling.
TEST(CycleStops, EachDriveTellsWhyItsGroupStoppedIt) {
  drive::StopWays ways;
  ways.command_timeout = drive::StopWay::kOff1;
  CycleBench bench{std::nullopt, 0.0, ways};
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  bench.commandLift(10.0);
  bench.run(200);
  EXPECT_FALSE(bench.snapshot().drives[CycleBench::kLift].enabled);
  EXPECT_EQ(drive::StopCause::kCommandTimeout, bench.snapshot().drives[CycleBench::kLift].stop_cause);
  EXPECT_TRUE(bench.snapshot().drives[CycleBench::kLift].stopped);
  for (const drive::StopWay way : {drive::StopWay::kQuickStop, drive::StopWay::kCoast, drive::StopWay::kOff1}) {
    ways.disable = way;
    CycleBench asked{std::nullopt, 0.0, ways};
    asked.run(30);
    ASSERT_TRUE(asked.ask(RequestKind::kEnable).success);
    ASSERT_TRUE(asked.ask(RequestKind::kDisable).success);
    EXPECT_EQ(drive::StopCause::kNone, asked.snapshot().drives[CycleBench::kLeft].stop_cause);
    EXPECT_FALSE(asked.snapshot().drives[CycleBench::kLeft].stopped);
  }
}

// A connection that changed its state unasked stops the base in the next cycle, though its drive answers all the while.
TEST(CycleStops, AnInterruptedConnectionStopsTheBase) {
  CycleBench bench;
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 20; ++i) {
    bench.commandBase(0.5);
    bench.step();
  }
  ASSERT_GT(bench.setpoint(CycleBench::kLeft), 0);
  bench.transport.interrupted[CycleBench::kRight] = true;
  bench.commandBase(0.5);
  bench.step();
  bench.commandBase(0.5);
  bench.step();
  EXPECT_EQ(0x047E, bench.controlWord(CycleBench::kRight));
  EXPECT_EQ(0, bench.setpoint(CycleBench::kLeft));
  EXPECT_EQ(drive::StopCause::kInterrupted, bench.snapshot().base.stop_cause);
  bench.commandBase(0.5);
  bench.run(100);
  EXPECT_FALSE(bench.snapshot().base.enabled);
  EXPECT_EQ(0x047E, bench.controlWord(CycleBench::kLeft));
}

// A base that was stopped stands: enabled again it begins there, not where its ramp would be by now.
TEST(CycleStops, ABaseThatIsEnabledSoonAfterAStopBeginsFromStandstill) {
  CycleBench bench{std::nullopt, 0.5};
  bench.run(30);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 200; ++i) {
    bench.commandBase(1.0);
    bench.step();
  }
  ASSERT_GT(bench.setpoint(CycleBench::kLeft), 1000);
  bench.commandBase(0.0);
  ASSERT_TRUE(bench.ask(RequestKind::kQuickStop).success);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
  for (int i = 0; i < 10; ++i) {
    bench.commandBase(0.0);
    bench.step();
    ASSERT_EQ(0x047F, bench.controlWord(CycleBench::kLeft));
    ASSERT_EQ(0, bench.setpoint(CycleBench::kLeft));
  }
}

/// The lift with 20 rad/s^2 and 40 rad/s^3.
CycleConfig liftWithJerkLimit() {
  CycleConfig config = CycleBench::config();
  robot::SpeedLimits& limits = config.drives[CycleBench::kLift].limits;
  limits.has_acceleration_limits = limits.has_jerk_limits = true;
  limits.max_acceleration = 20.0;
  limits.max_jerk = 40.0;
  return config;
}

// Within the jerk limit it would go on gaining speed: nobody asks for that any more.
TEST(CycleStops, ADriveWhoseCommandGrewOldSlowsDownFromTheFirstStepOn) {
  CycleBench bench{liftWithJerkLimit()};
  bench.run(80);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.commandLift(100.0);
  bench.run(50);
  const int before = bench.setpoint(CycleBench::kLift);
  bench.step();
  ASSERT_GT(bench.setpoint(CycleBench::kLift), before) << "it still gets faster";
  const int fastest = bench.setpoint(CycleBench::kLift);
  bench.run(3);
  EXPECT_LT(bench.setpoint(CycleBench::kLift), fastest);
}

TEST(CycleStops, ADriveThatIsCommandedToStandKeepsItsJerkLimit) {
  CycleBench bench{liftWithJerkLimit()};
  bench.run(80);
  ASSERT_TRUE(bench.ask(RequestKind::kEnable, CycleBench::kLift).success);
  bench.commandLift(100.0);
  bench.run(30);
  const int before = bench.setpoint(CycleBench::kLift);
  bench.commandLift(0.0);
  bench.step();
  EXPECT_GT(bench.setpoint(CycleBench::kLift), before);
}

}  // namespace
}  // namespace nord_driver::cycle

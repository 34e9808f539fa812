// acknowledge_at_start: bus_timeouts. Only E10.x that was read, only what stood when the drive was met, once, at rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::uint16_t kMasterLost = 102, kMotorHot = 21;
constexpr DriveIndex kLeft = CycleBench::kLeft, kRight = CycleBench::kRight, kLift = CycleBench::kLift;
constexpr Word kAcknowledgeBit = 0x0080;

class StartAcknowledgeTest : public ::testing::Test {
 protected:
  static CycleConfig config(bool wanted) {
    CycleConfig config = CycleBench::config();
    config.acknowledge_bus_timeouts = wanted;
    return config;
  }
  void start(bool wanted = true, bool auto_enable = false) { bench_.emplace(config(wanted), auto_enable); }
  void startFaulted(DriveIndex drive, std::uint16_t number, bool auto_enable = false) {
    start(true, auto_enable);
    trip(drive, number);
  }
  void trip(DriveIndex drive, std::uint16_t number) {
    bench_->transport.inverters[drive].fault = true;
    bench_->transport.of_drive[drive][700] = number;
  }
  bool faulted(DriveIndex drive) const { return bench_->transport.inverters[drive].fault; }
  bool latched(DriveIndex drive) { return bench_->snapshot().drives[drive].fault_latched; }
  /// The rising edges of the acknowledge bit a drive is sent meanwhile.
  int edges(DriveIndex drive, int cycles) {
    int count = 0;
    bool before = false;
    for (int i = 0; i < cycles; ++i) {
      bench_->step();
      const bool now = (bench_->controlWord(drive) & kAcknowledgeBit) != 0;
      count += now && !before ? 1 : 0;
      before = now;
    }
    return count;
  }

  std::optional<CycleBench> bench_;
};

TEST_F(StartAcknowledgeTest, TakesABusTimeOutAwayAndSaysSo) {
  startFaulted(kLeft, kMasterLost);
  trip(kRight, 100);
  EXPECT_EQ(1, edges(kLeft, 500));
  EXPECT_FALSE(faulted(kLeft));
  EXPECT_FALSE(latched(kLeft));
  EXPECT_FALSE(faulted(kRight));
  EXPECT_THAT(bench_->events(), testing::UnorderedElementsAre(
                                    "info: drive left: E10.2, which stood before this node started, is acknowledged "
                                    "(acknowledge_at_start)",
                                    "info: drive right: E10.0, which stood before this node started, is "
                                    "acknowledged (acknowledge_at_start)"));
  for (const DriveIndex drive : {kLeft, kRight, kLift}) EXPECT_EQ(0x047E, bench_->controlWord(drive));
}

TEST_F(StartAcknowledgeTest, DoesNothingUnlessItIsWanted) {
  start(false);
  trip(kLeft, kMasterLost);
  EXPECT_EQ(0, edges(kLeft, 500));
  EXPECT_TRUE(faulted(kLeft));
}

TEST_F(StartAcknowledgeTest, LeavesEveryOtherFault) {
  for (const std::uint16_t number : {kMotorHot, std::uint16_t{99}, std::uint16_t{110}, std::uint16_t{40}}) {
    startFaulted(kLeft, number);
    EXPECT_EQ(0, edges(kLeft, 1500)) << number;
    EXPECT_TRUE(latched(kLeft)) << number;
  }
}

TEST_F(StartAcknowledgeTest, LeavesAFaultWhoseNumberCannotBeRead) {
  start();
  bench_->transport.inverters[kLeft].fault = true;  // P700 is refused
  EXPECT_EQ(0, edges(kLeft, 900));
  EXPECT_THAT(bench_->events(), IsEmpty());
  EXPECT_EQ(0, edges(kLeft, 200));
  EXPECT_THAT(bench_->events(),
              ElementsAre("warning: drive left: its fault is not acknowledged at start: its number (P700) "
                          "could not be read"));
  bench_->transport.of_drive[kLeft][700] = kMasterLost;
  EXPECT_EQ(0, edges(kLeft, 500)) << "too late";
}

// Of the second one somebody has to know.
TEST_F(StartAcknowledgeTest, ActsOnlyOncePerDrive) {
  startFaulted(kLeft, kMasterLost);
  EXPECT_EQ(1, edges(kLeft, 500));
  trip(kLeft, kMasterLost);
  EXPECT_EQ(0, edges(kLeft, 1000));
  EXPECT_TRUE(latched(kLeft));
}

TEST_F(StartAcknowledgeTest, LeavesATimeOutOfADriveThatWasMetWithoutOne) {
  start();
  bench_->run(300);
  trip(kLeft, kMasterLost);
  EXPECT_EQ(0, edges(kLeft, 1000));
  EXPECT_TRUE(latched(kLeft));
}

TEST_F(StartAcknowledgeTest, ACauseThatStandsIsSaidAndNotTriedAgain) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.inverters[kLeft].cause = true;
  EXPECT_EQ(1, edges(kLeft, 1000));
  EXPECT_TRUE(faulted(kLeft));
  EXPECT_THAT(bench_->events(),
              ElementsAre(HasSubstr("warning: drive left: E10.2, which stood before this node started, "
                                    "could not be acknowledged: ")));
}

// A commander that talks already: nothing is done before it has said zero for cmd_vel_timeout.
TEST_F(StartAcknowledgeTest, WaitsUntilNoCommandMoves) {
  startFaulted(kLeft, kMasterLost);
  for (int i = 0; i < 300; ++i) {
    bench_->commandBase(0.2);
    bench_->step();
    ASSERT_EQ(0, bench_->controlWord(kLeft) & kAcknowledgeBit) << i;
  }
  EXPECT_EQ(1, edges(kLeft, 300));
  EXPECT_FALSE(latched(kLeft));
}

TEST_F(StartAcknowledgeTest, GivesUpUnderACommanderThatNeverRests) {
  startFaulted(kLeft, kMasterLost);
  for (int i = 0; i < 6200; ++i) {
    bench_->commandBase(0.2);
    bench_->step();
  }
  EXPECT_THAT(bench_->events(),
              ElementsAre("warning: drive left: its fault is not acknowledged at start: commands to move "
                          "came all the time"));
  EXPECT_EQ(0, edges(kLeft, 500));
}

// The other wheel is turned by its terminals: an acknowledged drive beside it would be a base half alive.
TEST_F(StartAcknowledgeTest, WaitsForTheOtherDrivesOfTheBaseToRest) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.inverters[kRight].terminals = true;
  EXPECT_EQ(0, edges(kLeft, 500));
  bench_->transport.inverters[kRight].terminals = false;
  EXPECT_EQ(1, edges(kLeft, 500));
}

TEST_F(StartAcknowledgeTest, WaitsForTheOtherDrivesOfTheBaseToBeThere) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.inverters[kRight].silent = true;
  EXPECT_EQ(0, edges(kLeft, 7000)) << "however long that takes";
  bench_->transport.inverters[kRight].silent = false;
  EXPECT_EQ(1, edges(kLeft, 300));
}

TEST_F(StartAcknowledgeTest, ADriveAloneWaitsForNobody) {
  startFaulted(kLift, kMasterLost);
  bench_->transport.inverters[kRight].silent = true;
  EXPECT_EQ(1, edges(kLift, 300));
}

// Whoever acknowledges it himself has it in hand.
TEST_F(StartAcknowledgeTest, AUsersAcknowledgingIsTheEndOfIt) {
  startFaulted(kLeft, kMasterLost);
  bench_->run(5);
  ASSERT_TRUE(bench_->ask(RequestKind::kAcknowledge).success);
  trip(kLeft, kMasterLost);
  EXPECT_EQ(0, edges(kLeft, 1000));
}

// Met when nobody has commanded anything for long: what follows is up to the number alone.
TEST_F(StartAcknowledgeTest, LeavesEveryOtherFaultOfADriveThatComesLater) {
  start();
  bench_->transport.inverters[kLift].silent = true;
  bench_->run(200);
  trip(kLift, kMotorHot);
  bench_->transport.inverters[kLift].silent = false;
  EXPECT_EQ(0, edges(kLift, 500));
  EXPECT_TRUE(latched(kLift));
}

// Its mains were switched off and on: the time in which its number has to be read begins anew.
TEST_F(StartAcknowledgeTest, ADriveThatWasAwayIsMetAnew) {
  start();
  bench_->transport.inverters[kLift].fault = true;  // P700 is refused
  bench_->run(500);
  bench_->transport.inverters[kLift].silent = true;
  bench_->run(800);
  bench_->transport.inverters[kLift].silent = false;
  bench_->run(500);
  EXPECT_THAT(bench_->events(), Not(Contains(HasSubstr("its fault is not acknowledged"))));
  bench_->transport.of_drive[kLift][700] = kMasterLost;
  EXPECT_EQ(1, edges(kLift, 600));
}

TEST_F(StartAcknowledgeTest, WaitsTenSecondsForTheNumber) {
  start();
  bench_->transport.inverters[kLift].fault = true;  // P700 is refused
  while (!latched(kLift)) bench_->step();
  const Instant met = bench_->snapshot().time;
  const auto givenUp = [this] {
    for (const std::string& event : bench_->events()) {
      if (event.find("its number (P700) could not be read") != std::string::npos) return true;
    }
    return false;
  };
  for (int i = 0; i < 2000 && !givenUp(); ++i) bench_->step();
  EXPECT_EQ(StartAcknowledge::kNumberAwaited, bench_->snapshot().time - met);
}

// How long they were awaited does not count for how long they may turn.
TEST_F(StartAcknowledgeTest, OnceAllAreThereTheyHaveTheTimeToComeToRest) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.inverters[kRight].silent = true;
  EXPECT_EQ(0, edges(kLeft, 7000));
  bench_->transport.inverters[kRight].terminals = true;
  bench_->transport.inverters[kRight].silent = false;
  EXPECT_EQ(0, edges(kLeft, 5900));
  EXPECT_THAT(bench_->events(), Not(Contains(HasSubstr("its fault is not acknowledged"))));
  bench_->transport.inverters[kRight].terminals = false;
  EXPECT_EQ(1, edges(kLeft, 500));
}

TEST_F(StartAcknowledgeTest, GivesUpBesideADriveThatDoesNotComeToRest) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.inverters[kRight].terminals = true;
  EXPECT_EQ(0, edges(kLeft, 6300));
  EXPECT_THAT(bench_->events(),
              Contains("warning: drive left: its fault is not acknowledged at start: a drive was not at "
                       "rest"));
  bench_->transport.inverters[kRight].terminals = false;
  EXPECT_EQ(0, edges(kLeft, 500));
}

// In revolutions per minute every actual value is 0 until P105 is known, whatever the wheels do.
TEST_F(StartAcknowledgeTest, WaitsUntilTheSpeedsOfTheBaseCanBeTold) {
  for (const DriveIndex unread : {kLeft, kRight}) {
    startFaulted(kLeft, kMasterLost);
    int& refusals = bench_->transport.not_now[{unread, 1105}];
    refusals = 2;
    for (int i = 0; refusals > 0 && i < 2000; ++i) ASSERT_EQ(0, edges(kLeft, 1)) << unread << ", " << i;
    EXPECT_EQ(1, edges(kLeft, 500)) << unread;
  }
}

TEST_F(StartAcknowledgeTest, GivesUpBesideADriveWhoseP105IsNeverKnown) {
  startFaulted(kLeft, kMasterLost);
  bench_->transport.parameters.erase(105);
  bench_->transport.of_drive[kLeft][105] = 500;
  EXPECT_EQ(0, edges(kLeft, 6300));
  EXPECT_THAT(bench_->events(), Contains("warning: drive left: its fault is not acknowledged at start: the maximum "
                                         "frequency (P105) of drive right is not known"));
}

TEST_F(StartAcknowledgeTest, ATypedP105IsAsGoodAsOneThatWasRead) {
  CycleConfig typed = config(true);
  for (DriveSetup& drive : typed.drives) drive.typed_max_frequency = 50.0;
  bench_.emplace(typed);
  trip(kLeft, kMasterLost);
  bench_->transport.parameters.erase(105);
  EXPECT_EQ(1, edges(kLeft, 500));
}

// Whichever of the base it is: turning, or enabled by its terminals and only just standing.
TEST_F(StartAcknowledgeTest, WaitsForEachDriveOfTheBase) {
  for (const DriveIndex faulty : {kLeft, kRight}) {
    for (const bool turns : {true, false}) {
      startFaulted(faulty, kMasterLost);
      drive::FakeInverter& beside = bench_->transport.inverters[faulty == kLeft ? kRight : kLeft];
      beside.terminals = true;
      if (!turns) beside.ramp = 0;
      EXPECT_EQ(0, edges(faulty, 500)) << faulty << turns;
      beside.terminals = false;
      beside.ramp = 0x400;
      EXPECT_EQ(1, edges(faulty, 500)) << faulty << turns;
    }
    startFaulted(faulty, kMasterLost);
    bench_->transport.inverters[faulty == kLeft ? kRight : kLeft].silent = true;
    EXPECT_EQ(0, edges(faulty, 7000)) << faulty;
    bench_->transport.inverters[faulty == kLeft ? kRight : kLeft].silent = false;
    EXPECT_EQ(1, edges(faulty, 300)) << faulty;
  }
}

/// The lift follows `leader`.
CycleConfig followed(DriveIndex leader, bool base) {
  CycleConfig config = CycleBench::config();
  config.acknowledge_bus_timeouts = true;
  config.drives[kLift].follows = config.drives[leader].name;
  config.drives[kLift].leader = leader;
  if (!base) config.base.reset();
  return config;
}

// It is enabled and stopped with its leader, and turns at the same load.
TEST_F(StartAcknowledgeTest, WaitsForFollowers) {
  struct Case {
    DriveIndex faulty, beside;
    bool base;
  };
  for (const Case& c : {Case{kLeft, kLift, true}, Case{kRight, kLift, true}, Case{kLift, kRight, true},
                        Case{kLeft, kLift, false}, Case{kLift, kLeft, false}}) {
    bench_.emplace(followed(kLeft, c.base));
    trip(c.faulty, kMasterLost);
    bench_->transport.inverters[c.beside].terminals = true;
    EXPECT_EQ(0, edges(c.faulty, 500)) << c.faulty << c.beside << c.base;
    bench_->transport.inverters[c.beside].terminals = false;
    EXPECT_EQ(1, edges(c.faulty, 500)) << c.faulty << c.beside << c.base;
    bench_.emplace(followed(kLeft, c.base));
    trip(c.faulty, kMasterLost);
    bench_->transport.inverters[c.beside].silent = true;
    EXPECT_EQ(0, edges(c.faulty, 7000)) << c.faulty << c.beside << c.base;
    bench_->transport.inverters[c.beside].silent = false;
    EXPECT_EQ(1, edges(c.faulty, 300)) << c.faulty << c.beside << c.base;
  }
}

TEST_F(StartAcknowledgeTest, WaitsForNoDriveOfAnotherGroup) {
  bench_.emplace(followed(kLeft, false));
  trip(kLeft, kMasterLost);
  bench_->transport.inverters[kRight].terminals = true;
  EXPECT_EQ(1, edges(kLeft, 500));
}

// One that is being acknowledged is at rest: neither waits for the other.
TEST_F(StartAcknowledgeTest, TheDrivesOfABaseAreAcknowledgedTogether) {
  startFaulted(kLeft, kMasterLost);
  trip(kRight, kMasterLost);
  bool together = false;
  for (int i = 0; i < 500; ++i) {
    bench_->step();
    together = together || (bench_->controlWord(kLeft) & bench_->controlWord(kRight) & kAcknowledgeBit) != 0;
  }
  EXPECT_TRUE(together);
}

// A fault that has gone by itself is taken away at once, and who acknowledges in the next moment changes nothing of it.
TEST_F(StartAcknowledgeTest, WhatIsDoneAtOnceIsSaidAtOnce) {
  const auto begin = [this] {
    startFaulted(kLift, kMasterLost);
    bench_->run(20);
    bench_->transport.inverters[kLift].fault = false;
  };
  begin();
  int cycles = 0;
  for (; cycles < 300 && latched(kLift); ++cycles) bench_->step();
  ASSERT_LT(cycles, 300);
  begin();
  bench_->run(cycles);
  bench_->submit(RequestKind::kAcknowledge, kLift);
  bench_->run(50);
  EXPECT_THAT(bench_->events(), ElementsAre("info: drive lift: E10.2, which stood before this node started, is "
                                            "acknowledged (acknowledge_at_start)"));
}

TEST_F(StartAcknowledgeTest, AutoEnableGoesOnAfterwards) {
  startFaulted(kLeft, kMasterLost, true);
  trip(kRight, kMasterLost);
  bench_->run(800);
  EXPECT_TRUE(bench_->snapshot().base.enabled);
  EXPECT_THAT(bench_->events(), Contains("info: the base is enabled"));
}

TEST_F(StartAcknowledgeTest, AutoEnableEndsAtAnyOtherFault) {
  startFaulted(kLeft, kMasterLost, true);
  trip(kRight, kMotorHot);
  bench_->run(800);
  EXPECT_FALSE(bench_->snapshot().base.enabled);
  EXPECT_FALSE(latched(kLeft)) << "a time-out is one, whatever the other drive has";
  ASSERT_TRUE(bench_->ask(RequestKind::kAcknowledge).success);
  bench_->run(800);
  EXPECT_FALSE(bench_->snapshot().base.enabled) << "whoever acknowledges it enables";
}

TEST_F(StartAcknowledgeTest, AutoEnableEndsWhereTheNumberCannotBeRead) {
  start(true, true);
  bench_->transport.inverters[kLeft].fault = true;
  bench_->run(1500);
  ASSERT_TRUE(bench_->ask(RequestKind::kAcknowledge).success);
  bench_->run(800);
  EXPECT_FALSE(bench_->snapshot().base.enabled);
}

}  // namespace
}  // namespace nord_driver::cycle

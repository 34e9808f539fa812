// The targets of a drive that positions on their way through the whole cycle: what goes out, and what is told of the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cycle/positioning_lift.h"

namespace nord_driver::cycle {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TargetsInCycle : public ::testing::Test, protected PositioningLift {
 protected:
  explicit TargetsInCycle(const CycleConfig& config = PositioningLift::config()) : PositioningLift{config} {}
  void SetUp() override { transport.parameters[613] = 900; }
};

TEST_F(TargetsInCycle, ATargetGoesOutInItsWords) {
  ASSERT_TRUE(bringUpAndEnable());
  EXPECT_EQ(500, sentTarget()) << "where it stands";
  ports.commandPosition(0, 0.7);
  step();
  EXPECT_EQ(700, sentTarget());
  EXPECT_EQ(0.7, lift().position_target);
  EXPECT_TRUE(lift().position_refused.empty());
  ports.commandIncrement(0, 0.125);
  step();
  EXPECT_EQ(825, sentTarget());
  EXPECT_THAT(events(), IsEmpty());
}

// A target does not grow old: the drive goes on to it, however long ago it came. A velocity, which it would not follow, has no
// say in that.
TEST_F(TargetsInCycle, NoVelocityCommandIsMissed) {
  CycleConfig config = PositioningLift::config();
  config.stop_ways.command_timeout = drive::StopWay::kQuickStop;
  PositioningLift bench{config};
  ASSERT_TRUE(bench.bringUpAndEnable());
  bench.ports.commandDrive(0, {1.0, bench.transport.time, true});
  bench.ports.commandPosition(0, 0.7);
  bench.run(200);
  EXPECT_TRUE(bench.lift().enabled) << bench.lift().text.c_str();
  EXPECT_EQ(700, bench.sentTarget());
}

TEST_F(TargetsInCycle, ARefusedTargetIsAWarning) {
  run(80);
  events();
  ports.commandPosition(0, 0.7);
  step();
  EXPECT_THAT(events(), ElementsAre("warning: drive lift: the target 0.7 is not taken: the drive is not enabled, and a "
                                    "target is not kept for later"));
  ASSERT_TRUE(ask(RequestKind::kEnable, 0).success);
  EXPECT_EQ(500, sentTarget());
}

// --- an element of the array -----------------------------------------------------------------------------------------

TEST_F(TargetsInCycle, AnElementIsReadAndGoneTo) {
  ASSERT_TRUE(bringUpAndEnable());
  ports.commandElement(0, 3);
  run(10);
  EXPECT_EQ(900, sentTarget());
  EXPECT_EQ(0.9, lift().position_target);
  EXPECT_TRUE(lift().position_refused.empty());
  transport.parameters[613] = 800;  // taught another position
  ports.commandElement(0, 3);
  run(10);
  EXPECT_EQ(800, sentTarget()) << "read anew with each choice";
  EXPECT_THAT(events(), IsEmpty());
}

TEST_F(TargetsInCycle, AnElementOfADriveThatIsNotEnabledIsNotTaken) {
  run(80);
  events();
  ports.commandElement(0, 3);
  run(10);
  EXPECT_THAT(events(),
              ElementsAre("warning: drive lift: the drive is not enabled, and a target is not kept for later; "
                          "element 3 of its array is not taken"));
  ASSERT_TRUE(ask(RequestKind::kEnable, 0).success);
  run(10);
  EXPECT_EQ(500, sentTarget()) << "nor later";
}

TEST_F(TargetsInCycle, AnElementItDoesNotHaveIsRefusedUnread) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  run(10);
  transport.submitted.clear();
  ports.commandElement(0, 64);
  run(10);
  EXPECT_THAT(events(), ElementsAre("warning: drive lift: of its array elements 1 to 63 are used (position/elements); "
                                    "element 64 of its array is not taken"));
  for (const auto& asked : transport.submitted) EXPECT_NE(613, asked.request.number);
}

TEST_F(TargetsInCycle, AnElementThatCannotBeReadIsNotTaken) {
  transport.parameters.erase(613);
  ASSERT_TRUE(bringUpAndEnable());
  ports.commandElement(0, 3);
  run(10);
  const auto told = events();
  ASSERT_EQ(1u, told.size());
  EXPECT_THAT(told[0], HasSubstr("warning: drive lift refuses P613"));
  EXPECT_THAT(told[0], HasSubstr("; element 3 of its array is not taken"));
  EXPECT_EQ(500, sentTarget());
}

// What was taken away by a stop does not come back with an answer.
TEST_F(TargetsInCycle, AStopEndsTheWaitForAnElement) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  run(3);
  submit(RequestKind::kQuickStop, 0);
  run(10);
  EXPECT_THAT(events(), ElementsAre("warning: drive lift was stopped before P613[-03] was read; element 3 of its array "
                                    "is not taken"));
  transport.answerAll();
  ASSERT_TRUE(ask(RequestKind::kEnable, 0).success);
  run(10);
  EXPECT_EQ(500, sentTarget());
}

// An axis that starts long after it was told to surprises whoever stands beside it.
TEST_F(TargetsInCycle, AnElementIsAwaitedForTwoSeconds) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  run(200);
  EXPECT_THAT(events(), IsEmpty());
  step();
  EXPECT_THAT(events(),
              ElementsAre("warning: drive lift: P613[-03] was not read in time; element 3 of its array is not "
                          "taken"));
  run(300);
  EXPECT_THAT(events(), IsEmpty()) << "told once";
  transport.answerAll();
  run(10);
  EXPECT_EQ(500, sentTarget()) << "too late";
}

/// Whose parameters are answered in every fifth cycle only.
class ElementsOfASlowChannel : public TargetsInCycle {
 protected:
  /// Returns how often an element was asked for.
  int stepAndCount() {
    const auto others = transport.submitted.size();
    step();
    int asked = 0;
    for (auto i = others; i < transport.submitted.size(); ++i) asked += transport.submitted[i].request.number == 613;
    if (++cycles_ % 5 == 0) {
      while (!transport.submitted.empty()) transport.answerFirst();
    }
    return asked;
  }

 private:
  int cycles_ = 0;
};

// As a topic that is published in every cycle does.
TEST_F(ElementsOfASlowChannel, AnElementChosenInEachCycleIsReadOnceInFiveAndGoneTo) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  int asked = 0;
  for (int i = 0; i < 20; ++i) {
    ports.commandElement(0, 3);
    asked += stepAndCount();
  }
  EXPECT_EQ(900, sentTarget());
  EXPECT_LE(asked, 5);
  transport.parameters[613] = 800;  // taught another position
  for (int i = 0; i < 20; ++i) {
    ports.commandElement(0, 3);
    stepAndCount();
  }
  EXPECT_EQ(800, sentTarget());
  EXPECT_THAT(events(), IsEmpty());
}

TEST_F(ElementsOfASlowChannel, AnotherElementChosenMeanwhileIsTheOneGoneTo) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  stepAndCount();
  ports.commandElement(0, 4);
  for (int i = 0; i < 4; ++i) stepAndCount();
  transport.parameters[613] = 700;  // of element 4
  for (int i = 0; i < 3; ++i) {
    stepAndCount();
    EXPECT_EQ(500, sentTarget()) << "what was read of element 3 is not wanted any more";
  }
  for (int i = 0; i < 5; ++i) stepAndCount();
  EXPECT_EQ(700, sentTarget());
  EXPECT_THAT(events(), IsEmpty());
}

// The time it is awaited for begins with the first choice.
TEST_F(TargetsInCycle, AnElementChosenAgainAndAgainIsNotAwaitedForever) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  for (int i = 0; i < 200; ++i) {
    ports.commandElement(0, 3);
    step();
  }
  EXPECT_THAT(events(), IsEmpty());
  run(1);
  EXPECT_THAT(events(), ElementsAre(HasSubstr("P613[-03] was not read in time")));
}

class TargetsOfASlowCycle : public TargetsInCycle {
 protected:
  TargetsOfASlowCycle() : TargetsInCycle{atOneHertz()} {}
  static CycleConfig atOneHertz() {
    CycleConfig config = PositioningLift::config();
    config.cycle_rate = 1.0;
    return config;
  }
  void slowSteps(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      step();
      transport.time += std::chrono::seconds{1} - kCycle;
    }
  }
};

// A parameter channel takes several cycles for an answer: longer than the 2 s that are enough at other rates.
TEST_F(TargetsOfASlowCycle, AnElementIsAwaitedForTenCycles) {
  ASSERT_TRUE(bringUpAndEnable());
  slowSteps(3);
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  slowSteps(6);
  EXPECT_THAT(events(), IsEmpty());
  transport.answerAll();
  slowSteps(2);
  EXPECT_EQ(900, sentTarget());
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  slowSteps(10);
  EXPECT_THAT(events(), IsEmpty());
  slowSteps(1);
  EXPECT_THAT(events(), ElementsAre(HasSubstr("P613[-03] was not read in time")));
}

TEST_F(TargetsInCycle, ANewTargetEndsTheWaitForAnElement) {
  ASSERT_TRUE(bringUpAndEnable());
  transport.hold_answers = true;
  ports.commandElement(0, 3);
  run(3);
  ports.commandPosition(0, 0.6);
  run(3);
  transport.answerAll();
  run(10);
  EXPECT_EQ(600, sentTarget());
  EXPECT_THAT(events(), IsEmpty());
}

class ElementsByBits : public TargetsInCycle {
 protected:
  ElementsByBits() : TargetsInCycle{byBits()} { transport.parameters[480] = 55; }
  /// Bits 8 and 9 of the control word choose elements 1 to 3; P480 says so of the first only.
  static CycleConfig byBits() {
    CycleConfig config = PositioningLift::config();
    PositionSetup& position = *config.drives[0].position;
    position.axis.by_element = true;
    position.array = PositionBit{PositionBit::Carrier::kControlBit, 8, 55};
    position.elements = 3;
    config.drives[0].drive.position = position.axis;
    return config;
  }
};

TEST_F(ElementsByBits, TheBitsOfTheElementGoOutOnceItIsRead) {
  ASSERT_TRUE(bringUpAndEnable());
  EXPECT_FALSE(isHigh(8));
  transport.hold_answers = true;
  ports.commandElement(0, 1);
  run(5);
  EXPECT_FALSE(isHigh(8)) << "where it would go is not known";
  transport.answerAll();
  run(5);
  EXPECT_TRUE(isHigh(8));
  EXPECT_FALSE(isHigh(9));
  EXPECT_EQ(0.9, lift().position_target);
}

TEST_F(ElementsByBits, AnElementWhoseBitsMeanSomethingElseIsNotTaken) {
  ASSERT_TRUE(bringUpAndEnable());
  ports.commandElement(0, 2);
  run(10);
  EXPECT_FALSE(isHigh(9));
  EXPECT_THAT(lift().position_refused.str(), HasSubstr("set it to 56 (bit 1 of the position array)"));
  EXPECT_THAT(lift().position_refused.str(), HasSubstr("; element 2 of its array is not taken"));
}

class TargetsDuringHoming : public TargetsInCycle {
 protected:
  TargetsDuringHoming() : TargetsInCycle{withHome()} { transport.parameters[480] = 22; }
  static CycleConfig withHome() {
    CycleConfig config = PositioningLift::config();
    config.drives[0].position->home = PositionBit{};
    return config;
  }
};

TEST_F(TargetsDuringHoming, NoElementIsGoneToDuringAReferenceRun) {
  ASSERT_TRUE(bringUpAndEnable());
  submit(RequestKind::kHome, 0);
  run(3);
  EXPECT_TRUE(isHigh(8)) << "the run is asked for";
  ports.commandElement(0, 3);
  run(10);
  EXPECT_THAT(events(), ElementsAre("warning: drive lift: a reference run is under way; element 3 of its array is not "
                                    "taken"));
}

}  // namespace
}  // namespace nord_driver::cycle

// The rules of the campaign with real processes, on records made by hand: each holds where it must, and can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "process_campaign/process_rules.h"
#include "process_campaign/process_scenario.h"

namespace nord_driver::test {
namespace {

using ::testing::HasSubstr;

constexpr ProcessBounds kBounds{2.0, 1.0, 0.1};

/// Both wheels enabled from 1 s to 4 s, by a call that took 0.5 s, and turning from 2 s on; a point each 20 ms, 6 s.
class ProcessRules : public ::testing::Test {
 protected:
  ProcessRules() {
    MadeCall enabling{"enable", 0.6, 1.1, true, "enabled"};
    record_.enablings.push_back(enabling);
    record_.commanded.push_back({2.0, 4.0});
    record_.stops.push_back(4.0);
    for (auto& wheel : record_.wheels) {
      for (int i = 0; i < 300; ++i) {
        TruthPoint point;
        point.time = 0.02 * i;
        point.enabled = point.time >= 1.0 && point.time < 4.0;
        const bool turns = point.time >= 2.0 && point.time < 4.0;
        point.frequency = turns ? 20.0 : 0.0;
        point.setpoint = turns ? 6554 : 0;
        wheel.push_back(point);
      }
    }
  }
  void change(int wheel, double from, double until, void (*how)(TruthPoint&)) {
    for (TruthPoint& point : record_.wheels[wheel]) {
      if (point.time >= from && point.time < until) how(point);
    }
  }
  ProcessRecord record_;
};

TEST_F(ProcessRules, HoldForARobotThatIsEnabledDrivesAndStops) {
  EXPECT_FALSE(enabledUnasked(record_, kBounds));
  EXPECT_FALSE(turnsUncommanded(record_, kBounds));
  EXPECT_FALSE(turnsAlone(record_, kBounds));
  EXPECT_FALSE(unanswered(record_.enablings, 1.0));
}

TEST_F(ProcessRules, NobodyIsEnabledOutsideACallOfEnable) {
  change(1, 4.5, 4.6, [](TruthPoint& point) { point.enabled = true; });
  EXPECT_THAT(enabledUnasked(record_, kBounds).value_or(""), HasSubstr("right became \"operation enabled\" at 4.5 s"));
  record_.enablings.push_back({"enable", 4.3, 4.41, false, "refused"});
  EXPECT_FALSE(enabledUnasked(record_, kBounds)) << "seen a little later";
  record_.enablings.back().end = 4.3;
  EXPECT_TRUE(enabledUnasked(record_, kBounds));
  record_.enablings.back().end.reset();
  EXPECT_FALSE(enabledUnasked(record_, kBounds)) << "it has no end";
}

TEST_F(ProcessRules, NobodyTurnsOnWhenTheCommandHasEnded) {
  change(0, 4.0, 5.99, [](TruthPoint& point) { point.frequency = -20.0; });
  EXPECT_FALSE(turnsUncommanded(record_, kBounds));
  record_.commanded.back().until = 3.5;
  EXPECT_THAT(turnsUncommanded(record_, kBounds).value_or(""), HasSubstr("left has -20 Hz at 5.52 s, 2.02 s after"));
}

TEST_F(ProcessRules, NobodyTurnsOnWhenAWheelWasLost) {
  record_.stops.clear();
  record_.commanded.back().until = 6.0;
  change(0, 2.0, 6.0, [](TruthPoint& point) { point.frequency = 20.0; });
  EXPECT_FALSE(turnsUncommanded(record_, kBounds)) << "until 6 s these are 2 s";
  change(1, 2.5, 6.0, [](TruthPoint& point) { point.enabled = false; });
  EXPECT_THAT(turnsUncommanded(record_, kBounds).value_or(""), HasSubstr("left has 20 Hz at 4.52 s"));
}

TEST_F(ProcessRules, NobodyTurnsWhoWasNeverEnabled) {
  record_.enablings[0].success = false;
  record_.enablings[0].message = "no";
  EXPECT_THAT(turnsUncommanded(record_, kBounds).value_or(""), HasSubstr("and was never enabled and commanded"));
}

TEST_F(ProcessRules, NoWheelTurnsAlone) {
  change(1, 2.5, 3.5, [](TruthPoint& point) { point.enabled = false; });
  EXPECT_FALSE(turnsAlone(record_, kBounds));
  change(1, 2.5, 3.6, [](TruthPoint& point) { point.enabled = false; });
  EXPECT_THAT(turnsAlone(record_, kBounds).value_or(""), HasSubstr("left is told to turn at 3.52 s, 1.02 s after"));
  change(0, 2.5, 6.0, [](TruthPoint& point) { point.setpoint = 0; });
  EXPECT_FALSE(turnsAlone(record_, kBounds));
}

TEST_F(ProcessRules, EveryCallEndsInTimeAndARefusalSaysWhy) {
  EXPECT_THAT(unanswered(record_.enablings, 0.4).value_or(""),
              HasSubstr("enable, called at 0.6 s, took 0.5 s of 0.4 s"));
  record_.enablings[0].success = false;
  record_.enablings[0].message.clear();
  EXPECT_THAT(unanswered(record_.enablings, 1.0).value_or(""), HasSubstr("without a sentence"));
  record_.enablings[0].not_carried_out = "its connection was lost";
  EXPECT_THAT(unanswered(record_.enablings, 1.0).value_or(""),
              HasSubstr("brought no answer until 1.1 s: its connection was lost"));
  record_.enablings[0].end.reset();
  EXPECT_THAT(unanswered(record_.enablings, 1.0).value_or(""), HasSubstr("has not ended"));
}

TEST(ProcessScenarios, AreTheSameForTheSameSeed) {
  EXPECT_EQ(toText(makeProcessScenario(7)), toText(makeProcessScenario(7)));
  EXPECT_NE(toText(makeProcessScenario(7)), toText(makeProcessScenario(8)));
}

// Everything is drawn, in order of time, within the scenario; what strikes one place does so one after the other.
TEST(ProcessScenarios, DrawEverythingThereIs) {
  std::set<std::string> seen;
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    const ProcessScenario scenario = makeProcessScenario(seed, 2.0);
    double before = 0.0, driver_free = -1.0;
    for (const ProcessEvent& event : scenario.events) {
      seen.insert(toString(event.act));
      EXPECT_GE(event.at, before) << toText(scenario);
      EXPECT_LE(event.at, scenario.length) << toText(scenario);
      before = event.at;
      const bool driver =
          event.act == ProcessAct::kHold || event.act == ProcessAct::kKill || event.act == ProcessAct::kEnd;
      if (!driver) continue;
      EXPECT_GT(event.at, driver_free) << toText(scenario);
      driver_free = event.at + event.span;
    }
  }
  EXPECT_EQ(18u, seen.size());
}

TEST(ProcessScenarios, AreToldInOneLine) {
  ProcessEvent event;
  event.at = 0.4;
  event.span = 0.75;
  event.act = ProcessAct::kUnplug;
  EXPECT_EQ("0.40+0.75 unplug left 0 0", toText(event));
}

}  // namespace
}  // namespace nord_driver::test

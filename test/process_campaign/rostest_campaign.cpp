// The fault campaign with real processes: seeded scenarios on driver and simulator as users run them. What a scenario is
// judged by stands in process_rules.h; then everything must be back in service, and the referee of the bus content.
//
// NORD_PROCESS_SCENARIOS: how many (6); NORD_PROCESS_FIRST: the first seed (1).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

#include "process_campaign/process_player.h"
#include "process_campaign/process_scenario.h"

namespace nord_driver::test {
namespace {

std::uint32_t numberOf(const char* name, std::uint32_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::stoul(text));
}

/// What the referee knows the driver cannot know: that a drive that is not heard hears, that a connection timed out while the
/// host stood still, that a module which asks whether its address is free was off before.
bool knowsLess(const ProcessScenario& scenario) {
  return std::any_of(scenario.events.begin(), scenario.events.end(), [](const ProcessEvent& event) {
    return event.act == ProcessAct::kHold || event.act == ProcessAct::kMute || event.act == ProcessAct::kUnplug;
  });
}

class ProcessCampaign : public RobotTest {
 protected:
  void play(std::uint32_t seed) {
    const ProcessScenario scenario = makeProcessScenario(seed, timeFactor());
    SCOPED_TRACE("NORD_PROCESS_FIRST=" + std::to_string(seed) + " NORD_PROCESS_SCENARIOS=1: " + toText(scenario));
    std::cout << toText(scenario) << std::endl;
    const std::string rules_before = robot().referee().message;
    ProcessPlayer player{robot(), driver_, scenario};
    const auto broken = player.play();
    EXPECT_FALSE(broken) << *broken;
    ASSERT_NO_FATAL_FAILURE(expectBackInService());
    if (!knowsLess(scenario)) {
      EXPECT_EQ(rules_before, robot().referee().message);
    }
  }
  /// After each scenario, not for all of them together.
  void judgeWire() override {}

 private:
  void expectBackInService() {
    ASSERT_TRUE(robot().waitForDrivesOnline());
    ASSERT_TRUE(robot().waitForStandstill());
    Answer answer;
    ASSERT_TRUE(eventually([&] { return (answer = robot().trigger("acknowledge_faults")).success; })) << answer;
    robot().drive(0.0);
    ASSERT_NO_FATAL_FAILURE(enableAndDrive(0.3));
    robot().silence();
    answer = robot().enable(false);
    EXPECT_TRUE(answer.success) << answer;
    EXPECT_TRUE(robot().waitForRest());
  }
};

TEST_F(ProcessCampaign, HoldsItsRules) {
  ASSERT_NO_FATAL_FAILURE(startDriver());
  const std::uint32_t first = numberOf("NORD_PROCESS_FIRST", 1);
  const std::uint32_t count = numberOf("NORD_PROCESS_SCENARIOS", 6);
  ASSERT_GT(count, 0u);
  for (std::uint32_t seed = first; seed < first + count; ++seed) ASSERT_NO_FATAL_FAILURE(play(seed));
  RecordProperty("scenarios", static_cast<int>(count));
  std::cout << "campaign with real processes: " << count << " scenarios\n";
}

}  // namespace
}  // namespace nord_driver::test

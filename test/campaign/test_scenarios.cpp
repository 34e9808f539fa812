// Scenarios as data: made from a seed, always the same; printed and read again; what is left of them still means
// something.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "campaign/campaign.h"
#include "campaign/generator.h"

namespace nord_driver::test {
namespace {

TEST(Scenarios, AreMadeOfTheirSeed) {
  for (const CampaignBus& bus : campaignBuses()) {
    EXPECT_EQ(toText(makeScenario(bus, 7)), toText(makeScenario(bus, 7)));
    EXPECT_NE(toText(makeScenario(bus, 7)), toText(makeScenario(bus, 8)));
  }
}

TEST(Scenarios, AreReadAsTheyWerePrinted) {
  for (const CampaignBus& bus : campaignBuses()) {
    for (std::uint32_t seed = 1; seed <= 50; ++seed) {
      const std::string text = toText(makeScenario(bus, seed));
      const auto read = scenarioFrom(text);
      ASSERT_TRUE(read) << text;
      EXPECT_EQ(text, toText(*read));
    }
  }
}

TEST(Scenarios, WhatIsNoneIsNotRead) {
  const std::string head = "bus=profibus seed=1 wheels=2 singles=0 one_module=0 length=100";
  EXPECT_TRUE(scenarioFrom(head));
  EXPECT_TRUE(scenarioFrom(head + "; 10+0 enable 1 1 0"));
  EXPECT_FALSE(scenarioFrom(""));
  EXPECT_FALSE(scenarioFrom("bus=profibus seed=x wheels=2 singles=0 one_module=0 length=100"));
  EXPECT_FALSE(scenarioFrom(head + "; 10 enable 1 1 0"));
  EXPECT_FALSE(scenarioFrom(head + "; 10+0 enable 2 1 0")) << "there is no drive 2";
  EXPECT_FALSE(scenarioFrom("bus=profibus seed=1 wheels=2 singles=0 axes=x one_module=0 length=100"));
  const auto with_axis = scenarioFrom("bus=profibus seed=1 wheels=2 singles=0 axes=1 one_module=0 length=100");
  ASSERT_TRUE(with_axis);
  EXPECT_EQ(2u, with_axis->layout.firstAxis());
  EXPECT_EQ(3u, with_axis->layout.drives());
  EXPECT_EQ(0u, with_axis->layout.variant);
  EXPECT_FALSE(scenarioFrom("bus=profibus seed=1 wheels=2 singles=0 one_module=0 variant=x length=100"));
  EXPECT_EQ(3u,
            scenarioFrom("bus=profibus seed=1 wheels=2 singles=0 one_module=0 variant=3 length=100")->layout.variant);
}

// Each kind of exchange with each way of stops, each pace and each bound of speeds, in both profiles; a bus that is half as fast is ready later.
TEST(Scenarios, HaveEveryVariant) {
  for (const CampaignBus& bus : campaignBuses()) {
    std::set<unsigned> variants;
    std::set<double> rates;
    unsigned of_other_profile = 0;
    for (std::uint32_t seed = 1; seed <= 512; ++seed) {
      const Scenario scenario = makeScenario(bus, seed);
      const Layout& layout = scenario.layout;
      variants.insert(layout.exchange() + 4 * layout.ways() + 16 * layout.pace() + 64 * layout.bounds());
      rates.insert(layout.cycleRate());
      const unsigned ready_at = layout.axes != 0 ? bus.axes_ready_at : bus.ready_at;
      EXPECT_GT(scenario.length, layout.pace() == 1 ? 2 * ready_at : ready_at);
      of_other_profile += layout.otherProfile() ? 1 : 0;
      EXPECT_EQ(layout.pace() == 3 || layout.limitsJerk(), layout.limitsAcceleration());
    }
    EXPECT_EQ(256u, variants.size()) << bus.name;
    EXPECT_GT(of_other_profile, 64u) << bus.name;
    EXPECT_EQ((std::set<double>{50.0, 80.0, 100.0, 200.0}), rates) << bus.name;
  }
}

// Every act, and every size from one drive to eight.
TEST(Scenarios, HaveEverythingThatMayHappen) {
  for (const CampaignBus& bus : campaignBuses()) {
    std::set<std::string> acts;
    std::set<std::size_t> sizes;
    unsigned with_axes = 0, only_axes = 0;
    for (std::uint32_t seed = 1; seed <= 500; ++seed) {
      const Scenario scenario = makeScenario(bus, seed);
      sizes.insert(scenario.layout.drives());
      with_axes += scenario.layout.axes != 0 ? 1 : 0;
      only_axes += scenario.layout.axes == scenario.layout.drives() ? 1 : 0;
      for (const Event& event : scenario.events) {
        ASSERT_NE(nullptr, findAct(bus, event.act)) << event.act;
        ASSERT_LT(event.drive, scenario.layout.drives());
        acts.insert(event.act);
      }
    }
    for (const auto* all : {&userActs(), &driveActs(), &bus.acts()}) {
      for (const Act& act : *all) EXPECT_EQ(1u, acts.count(act.name)) << bus.name << ' ' << act.name;
    }
    EXPECT_GT(with_axes, 100u) << bus.name << ", velocity and position";
    EXPECT_LT(only_axes, with_axes) << bus.name;
    EXPECT_EQ(1u, *sizes.begin()) << bus.name;
    EXPECT_EQ(8u, *sizes.rbegin()) << bus.name;
  }
}

}  // namespace
}  // namespace nord_driver::test

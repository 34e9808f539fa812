// The fault campaign: generated scenarios on every bus, each invariant held after each cycle.
//
// NORD_CAMPAIGN_SCENARIOS: how many in all (2000); NORD_CAMPAIGN_BUS: on this one only; NORD_CAMPAIGN_FIRST: the first
// seed (1); NORD_CAMPAIGN_REPLAY: no campaign, but this scenario, as it was printed, or made of "bus:seed".
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "campaign/campaign.h"
#include "campaign/generator.h"
#include "campaign/shrink.h"

namespace nord_driver::test {
namespace {

constexpr unsigned kScenarios = 2000;  // some 7 minutes of one processor; scripts/prove.sh plays 20 000
constexpr std::size_t kShown = 3;      // violations of a bus that are shrunk and printed

std::string setting(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

unsigned numberOf(const char* name, unsigned otherwise) {
  const std::string text = setting(name);
  return text.empty() ? otherwise : static_cast<unsigned>(std::stoul(text));
}

const CampaignBus* busOf(const std::vector<CampaignBus>& buses, const std::string& name) {
  for (const CampaignBus& bus : buses) {
    if (name == bus.name) return &bus;
  }
  return nullptr;
}

void replay(const std::vector<CampaignBus>& buses, const std::string& text) {
  const std::size_t colon = text.find(':');
  const bool by_seed = text.find('=') == std::string::npos && colon != std::string::npos;
  const std::optional<Scenario> read = by_seed ? std::nullopt : scenarioFrom(text);
  const CampaignBus* const bus = busOf(buses, by_seed ? text.substr(0, colon) : read ? read->bus : "");
  ASSERT_NE(nullptr, bus) << "no scenario and no bus:seed: " << text;
  const Scenario scenario =
      by_seed ? makeScenario(*bus, static_cast<std::uint32_t>(std::stoul(text.substr(colon + 1)))) : *read;
  std::cout << toText(scenario) << '\n';
  const Outcome outcome = Player{scenario, *bus}.play();
  std::cout << outcome.enabled << " enabled, " << outcome.stopped << " stopped, " << outcome.answers << " answers, "
            << outcome.arrived << " axes arrived\n";
  EXPECT_FALSE(outcome.violation) << textOf({scenario, *outcome.violation});
}

TEST(FaultCampaign, HoldsEveryInvariant) {
  const std::vector<CampaignBus> buses = campaignBuses();
  const std::string text = setting("NORD_CAMPAIGN_REPLAY");
  if (!text.empty()) return replay(buses, text);

  const std::string only = setting("NORD_CAMPAIGN_BUS");
  ASSERT_TRUE(only.empty() || busOf(buses, only) != nullptr) << only;
  const unsigned all = numberOf("NORD_CAMPAIGN_SCENARIOS", kScenarios);
  std::vector<CampaignReport> reports;
  for (const CampaignBus& bus : buses) {
    if (!only.empty() && only != bus.name) continue;
    const unsigned count = only.empty() ? (all + 3) / 4 : all;
    reports.push_back(runCampaign(bus, numberOf("NORD_CAMPAIGN_FIRST", 1), count));
    const CampaignReport& report = reports.back();
    for (std::size_t i = 0; i < report.found.size(); ++i) {
      if (i >= kShown) {
        ADD_FAILURE() << report.bus << ':' << report.found[i].scenario.seed << ' '
                      << report.found[i].violation.invariant << ": " << report.found[i].violation.what;
        continue;
      }
      const Shrunk shrunk = shrink(report.found[i].scenario, report.found[i].violation, bus);
      ADD_FAILURE() << report.bus << ':' << report.found[i].scenario.seed << ' '
                    << textOf({shrunk.scenario, shrunk.violation});
    }
    // A campaign whose robots never drive, or are never stopped, shows nothing.
    EXPECT_GT(report.enabled, count) << report.bus;
    EXPECT_GT(report.stops, count / 4) << report.bus;
    EXPECT_GT(report.arrived, count / 4) << report.bus;
  }
  std::cout << tableOf(reports);
}

}  // namespace
}  // namespace nord_driver::test

// A campaign that finds nothing shows something only if it finds what is there: faults of a driver, planted between it
// and its bus. Each is found by the invariant it offends, and shrunk to what it needs.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "campaign/campaign.h"
#include "campaign/planted_transport.h"
#include "campaign/shrink.h"

namespace nord_driver::test {
namespace {

using Plant = PlantedTransport::Plant;
using Outputs = PlantedTransport::Outputs;

constexpr Word kRun = 0x047F, kSets = 0x3FFF;

bool runs(const profile::ProcessOutput& output) {
  return (output.control_word & kSets) == kRun;
}

TransportWrap wrapped(Plant (*make)()) {
  return
      [make](std::unique_ptr<Transport> inner) { return std::make_unique<PlantedTransport>(std::move(inner), make()); };
}

/// Two wheels drive, and stop: commands end, wheel 1 trips later, then everything is disabled.
Scenario driving(const char* bus, const std::string& events) {
  return *scenarioFrom(std::string{"bus="} + bus + " seed=1 wheels=2 singles=0 one_module=0 length=9000; " + events);
}

struct PlantedFault {
  const char* name;
  const char* invariant;
  const char* events;  ///< what brings it to light, after "enable" at 1500 (DeviceNet 4500)
  Plant (*make)();
};

void PrintTo(const PlantedFault& fault, std::ostream* out) {
  *out << fault.name;
}

const PlantedFault kFaults[] = {
    // The last setpoint is repeated after a stop.
    {"LastSetpointRepeated", "TurnsOnlyAsCommanded", "5400+600 drive 0 40 10; 5400+0 late_answers 1 1 0",
     [] {
       const auto last = std::make_shared<Outputs>();
       Plant plant;
       plant.outputs = [last](Outputs& outputs) {
         last->resize(outputs.size());
         for (std::size_t i = 0; i < outputs.size(); ++i) {
           if (runs(outputs[i]) && outputs[i].setpoints[0] != 0) (*last)[i] = outputs[i];
           if ((*last)[i].control_word != 0) outputs[i] = (*last)[i];
         }
       };
       return plant;
     }},
    // The driver that begins anew over turning wheels goes on with what they were told last.
    {"BeginsWhereTheOtherEnded", "TurnsOnlyAsCommanded", "5400+600 drive 0 40 10; 5900+0 respawn 0 20 0",
     [] {
       const auto last = std::make_shared<std::pair<Outputs, bool>>();
       Plant plant;
       plant.outputs = [last](Outputs& outputs) {
         last->first.resize(outputs.size());
         for (std::size_t i = 0; i < outputs.size(); ++i) {
           profile::ProcessOutput& before = last->first[i];
           if (runs(outputs[i]) && outputs[i].setpoints[0] != 0) before = outputs[i];
           // Its first word: it learns the parameter set in force.
           if (outputs[i].control_word == 0 && before.control_word != 0) last->second = true;
           if (last->second) outputs[i] = before;
         }
       };
       return plant;
     }},
    // Who has been enabled once is enabled again, however it was stopped.
    {"EnabledAgain", "NothingEnabledUnasked", "5400+0 trip 1 125 0; 5900+0 disable 0 1 0",
     [] {
       const auto cycles = std::make_shared<std::pair<bool, unsigned>>(false, 0);
       Plant plant;
       plant.outputs = [cycles](Outputs& outputs) {
         bool all_rest = true;
         for (const auto& output : outputs) {
           cycles->first = cycles->first || runs(output);
           all_rest = all_rest && !runs(output);
         }
         cycles->second = cycles->first && all_rest ? cycles->second + 1 : 0;
         if (cycles->second < 100 || cycles->second % 100 < 20) return;  // "shut down" comes between
         for (auto& output : outputs) output.control_word |= 0x0001;
       };
       return plant;
     }},
    // A wheel goes on when the other one has stopped.
    {"OtherWheelGoesOn", "NeverOneWheelAlone", "5400+3000 drive 0 40 10; 6000+0 trip 1 125 0",
     [] {
       const auto last = std::make_shared<profile::ProcessOutput>();
       Plant plant;
       plant.outputs = [last](Outputs& outputs) {
         if (runs(outputs[0]) && outputs[0].setpoints[0] != 0) *last = outputs[0];
         if (last->control_word != 0) outputs[0] = *last;
       };
       return plant;
     }},
    // Whose question was it?
    {"AnswersMixedUp", "AnswersAreTrue", "5000+2000 clients 0 3 0",
     [] {
       Plant plant;
       plant.result = [](profile::ParameterResult& result) {
         if (result.outcome == profile::ParameterOutcome::kDone && result.raw >= 100 && result.raw < 400) ++result.raw;
         return true;
       };
       return plant;
     }},
    // Results are lost between driver and transport. Whoever asked is told so when his patience ends; the driver itself
    // waits for ever.
    {"AnswerLost", "BackInService", "5000+2000 clients 0 3 0",
     [] {
       const auto results = std::make_shared<unsigned>(0);
       Plant plant;
       plant.result = [results](profile::ParameterResult&) { return ++*results < 60; };
       return plant;
     }},
};

CampaignBus busOf(const char* name) {
  CampaignBus bus{};
  for (const CampaignBus& each : campaignBuses()) {
    if (std::string{each.name} == name) bus = each;
  }
  return bus;
}

Scenario scenarioOf(const char* bus, const PlantedFault& fault) {
  return driving(bus, "4800+0 enable 0 1 0; " + std::string{fault.events} + "; 6300+100 late_answers 1 1 0");
}

class PlantedFaults : public ::testing::TestWithParam<std::tuple<const char*, PlantedFault>> {};

TEST_P(PlantedFaults, AreFound) {
  const auto& [name, fault] = GetParam();
  const CampaignBus bus = busOf(name);
  const Scenario scenario = scenarioOf(name, fault);
  const Outcome without = Player{scenario, bus}.play();
  ASSERT_FALSE(without.violation) << textOf({scenario, *without.violation});
  const Outcome outcome = Player{scenario, bus, wrapped(fault.make)}.play();
  ASSERT_TRUE(outcome.violation) << toText(scenario);
  EXPECT_EQ(fault.invariant, outcome.violation->invariant) << textOf({scenario, *outcome.violation});
}

// "OtherWheelGoesOn" needs an enabling, a command and a fault of one wheel; the rest is left out.
TEST(PlantedFaults, AreShrunkToWhatTheyNeed) {
  const PlantedFault& fault = kFaults[3];
  const CampaignBus bus = busOf("profibus");
  const Scenario scenario = scenarioOf(bus.name, fault);
  const Outcome outcome = Player{scenario, bus, wrapped(fault.make)}.play();
  ASSERT_TRUE(outcome.violation);
  const Shrunk shrunk = shrink(scenario, *outcome.violation, bus, wrapped(fault.make));
  EXPECT_EQ(3u, shrunk.scenario.events.size()) << toText(shrunk.scenario);
  const auto again = scenarioFrom(toText(shrunk.scenario));
  ASSERT_TRUE(again);
  const Outcome replayed = Player{*again, bus, wrapped(fault.make)}.play();
  ASSERT_TRUE(replayed.violation) << toText(*again);
  EXPECT_EQ(shrunk.violation.what, replayed.violation->what);
  EXPECT_EQ(shrunk.violation.at, replayed.violation->at);
}

std::string nameOf(const ::testing::TestParamInfo<std::tuple<const char*, PlantedFault>>& info) {
  return std::string{std::get<1>(info.param).name} + "On" + std::get<0>(info.param);
}

INSTANTIATE_TEST_SUITE_P(Campaign, PlantedFaults,
                         ::testing::Combine(::testing::Values("profibus", "canopen", "devicenet", "interbus"),
                                            ::testing::ValuesIn(kFaults)),
                         nameOf);

}  // namespace
}  // namespace nord_driver::test

// A campaign that finds nothing shows something only if it finds what is there: faults of a driver, planted between it
// and its bus. Each is found by the invariant it offends, and shrunk to what it needs.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "campaign/campaign.h"
#include "campaign/planted_transport.h"
#include "campaign/shrink.h"

namespace nord_driver::test {
namespace {

using Plant = PlantedTransport::Plant;
using Outputs = PlantedTransport::Outputs;
using Inputs = PlantedTransport::Inputs;

constexpr Word kRun = 0x047F, kSets = 0x3FFF;

bool runs(const profile::ProcessOutput& output) {
  return (output.control_word & kSets) == kRun;
}

TransportWrap wrapped(Plant (*make)()) {
  return
      [make](std::unique_ptr<Transport> inner) { return std::make_unique<PlantedTransport>(std::move(inner), make()); };
}

Scenario driving(const char* bus, const char* layout, const std::string& events) {
  return *scenarioFrom(std::string{"bus="} + bus + " seed=1 " + layout + " one_module=0 length=9000; " + events);
}

constexpr const char* kTwoWheels = "wheels=2 singles=0";
constexpr const char* kOneSingle = "wheels=0 singles=1";
constexpr unsigned kWithSlowest = 128;  // Layout::variant
constexpr const char* kOneAxis = "wheels=0 singles=0 axes=1";

/// The position of an axis on every bus here: setpoint 2 has its low word, setpoint 3 its high one; actual values likewise.
std::int32_t joined(const std::array<std::int16_t, 3>& words) {
  return static_cast<std::int32_t>(std::uint32_t{static_cast<std::uint16_t>(words[2])} << 16 |
                                   static_cast<std::uint16_t>(words[1]));
}
void split(std::int32_t position, std::array<std::int16_t, 3>& words) {
  words[1] = static_cast<std::int16_t>(static_cast<std::uint32_t>(position) & 0xFFFFu);
  words[2] = static_cast<std::int16_t>(static_cast<std::uint32_t>(position) >> 16);
}

struct PlantedFault {
  const char* name;
  const char* invariant;
  const char* events;  ///< what brings it to light, after "enable" at 1500 (DeviceNet 4500)
  Plant (*make)();
  const char* layout = kTwoWheels;
  unsigned variant = 0;
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
    // It is enabled, and its setpoint never leaves.
    {"SetpointLost", "FollowsItsCommand", "5400+900 drive 0 40 10",
     [] {
       Plant plant;
       plant.outputs = [](Outputs& outputs) { outputs[0].setpoints[0] = 0; };
       return plant;
     }},
    // A wheel that is built in the other way round, and nobody has said so.
    {"TurnedRound", "FollowsItsCommand", "5400+900 drive 0 40 10",
     [] {
       Plant plant;
       plant.outputs = [](Outputs& outputs) {
         outputs[1].setpoints[0] = static_cast<std::int16_t>(-outputs[1].setpoints[0]);
       };
       return plant;
     }},
    // An actual value from before goes on being told.
    {"SpeedStandsStill", "MotionToldAsItIs", "5400+900 drive 0 40 10",
     [] {
       Plant plant;
       plant.inputs = [](Inputs& inputs) { inputs[0].input.actual_values[0] = 0; };
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
    // What an axis was told before it was stopped it is told again when it is enabled.
    {"TargetKeptForLater", "AxisMovesOnlyAsAsked", "5400+0 go 0 50 0; 5900+0 disable 0 1 0; 7000+0 enable 0 1 0",
     [] {
       const auto last = std::make_shared<std::optional<std::int32_t>>();
       Plant plant;
       plant.outputs = [last](Outputs& outputs) {
         if (!runs(outputs[0])) return;
         const std::int32_t target = joined(outputs[0].setpoints);
         if (!*last && std::abs(target) > 1000) *last = target;
         if (*last) split(**last, outputs[0].setpoints);
       };
       return plant;
     },
     kOneAxis},
    // Targets in other steps than those of the count.
    {"StepsTooLong", "AxisWithinItsLimits", "5400+0 go 0 95 0",
     [] {
       Plant plant;
       plant.outputs = [](Outputs& outputs) {
         if (runs(outputs[0])) split(joined(outputs[0].setpoints) / 10 * 11, outputs[0].setpoints);
       };
       return plant;
     },
     kOneAxis},
    // A position from before goes on being told.
    {"OldPosition", "AxisPositionTrue", "5400+0 go 0 50 0",
     [] {
       const auto first = std::make_shared<std::optional<std::array<std::int16_t, 3>>>();
       Plant plant;
       plant.inputs = [first](Inputs& inputs) {
         if (!*first && joined(inputs[0].input.actual_values) > 1000) *first = inputs[0].input.actual_values;
         if (*first) inputs[0].input.actual_values = **first;
       };
       return plant;
     },
     kOneAxis},
    // A target nobody has asked for.
    {"AnotherTarget", "AxisMovesOnlyAsAsked", "6000+0 late_answers 0 1 0",
     [] {
       const auto cycles = std::make_shared<unsigned>(0);
       Plant plant;
       plant.outputs = [cycles](Outputs& outputs) {
         if (!runs(outputs[0]) || ++*cycles < 50) return;
         split(joined(outputs[0].setpoints) + 2000, outputs[0].setpoints);
       };
       return plant;
     },
     kOneAxis},
    // With P104 above 0 a motor without a setpoint turns.
    {"ZeroKeepsItEnabled", "TurnsOnlyAsCommanded", "5400+600 drive 0 40 10",
     [] {
       const auto ran = std::make_shared<bool>(false);
       Plant plant;
       plant.outputs = [ran](Outputs& outputs) {
         *ran = *ran || runs(outputs[0]);
         if (*ran && (outputs[0].control_word & kSets) == 0x047E) outputs[0].control_word |= 0x0001;
       };
       return plant;
     },
     kTwoWheels, kWithSlowest},
    // And one that has lost its sign turns the other way.
    {"SignLost", "TurnsTheCommandedWay", "5400+600 turn 0 -40 0",
     [] {
       Plant plant;
       plant.outputs = [](Outputs& outputs) {
         outputs[0].setpoints[0] = static_cast<std::int16_t>(std::abs(outputs[0].setpoints[0]));
       };
       return plant;
     },
     kOneSingle, kWithSlowest},
};

CampaignBus busOf(const char* name) {
  CampaignBus bus{};
  for (const CampaignBus& each : campaignBuses()) {
    if (std::string{each.name} == name) bus = each;
  }
  return bus;
}

// Something beside it, which the fault does not need. An axis over PROFIBUS would be stopped by it on its way.
Scenario scenarioOf(const char* bus, const PlantedFault& fault) {
  const std::string beside =
      fault.layout == kTwoWheels ? "; 6300+100 late_answers 1 1 0" : "; 8800+100 late_answers 0 1 0";
  Scenario scenario = driving(bus, fault.layout, "4800+0 enable 0 1 0; " + std::string{fault.events} + beside);
  scenario.layout.variant = fault.variant;
  return scenario;
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

// One parameter, one value, whichever way it is asked for: every entry of the catalogue that a simulated inverter has,
// read by PKW, by records of DP-V1 (MS1), by SDO, by explicit messages of DeviceNet and by PCP.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "system/can_robot.h"
#include "system/devicenet_robot.h"
#include "system/interbus_robot.h"
#include "system/parameter_answers.h"
#include "system/simulated_robot.h"

namespace nord_driver::test {
namespace {

using profile::Series;

/// Number, set and index; 0 where the parameter has none.
using Place = std::tuple<std::uint16_t, std::uint8_t, std::uint8_t>;

std::string nameOf(const Place& place) {
  const auto [number, set, index] = place;
  return "P" + std::to_string(number) + " set " + std::to_string(set) + " index " + std::to_string(index);
}

struct Values {
  std::map<Place, std::string> told;  ///< as a user reads it
  std::set<Place> shown;              ///< what the inverter itself writes: it can differ from bus to bus
};

/// Some value within the parameter's range, another one for each place.
std::int32_t distinctValue(const sim::ParameterDefinition& definition, unsigned set, unsigned element) {
  const std::int64_t width = std::int64_t{definition.maximum} - definition.minimum + 1;
  const std::int64_t some = 7919LL * definition.number + 101LL * set + 1009LL * element;
  return static_cast<std::int32_t>(definition.minimum + some % width);
}

class Reader {
 public:
  Reader(DrivenRobot& robot, sim::ParameterStore& store)
      : robot_(robot),
        store_(store),
        known_(catalogue::shippedCatalogues(), robot.config().drives[0].series, std::nullopt) {}

  Values readAll() {
    for (const catalogue::ParameterEntry* entry : known_.all()) {
      const sim::ParameterDefinition* definition = store_.find(entry->number);
      if (definition == nullptr) continue;
      const unsigned sets = definition->per_set ? sim::ParameterStore::kSets : 1;
      const unsigned elements = entry->elements ? std::min<unsigned>(*entry->elements, definition->elements) : 1;
      for (unsigned set = 0; set < sets; ++set) {
        for (unsigned element = 0; element < std::max(elements, 1u); ++element) {
          read(*entry, *definition, set, element);
          if (::testing::Test::HasFatalFailure()) return values_;
        }
      }
    }
    return values_;
  }

 private:
  void read(const catalogue::ParameterEntry& entry, const sim::ParameterDefinition& definition, unsigned set,
            unsigned element) {
    const auto number_of_set = static_cast<std::uint8_t>(definition.per_set ? set + 1 : 0);
    const auto index = static_cast<std::uint8_t>(entry.elements ? element + 1 : 0);
    const Place place{entry.number, number_of_set, index};
    const std::int32_t before = store_.value(entry.number, set, element);
    const std::int32_t given = distinctValue(definition, set, element);
    ASSERT_TRUE(store_.preset(entry.number, set, element, given)) << nameOf(place);

    cycle::Request request;
    request.drive = 0;
    request.kind = cycle::RequestKind::kReadParameter;
    request.parameter = catalogue::accessTo({entry.number, number_of_set, index}, known_).request;
    const cycle::Completion answer = robot_.ask(request);
    const std::int32_t stored = store_.value(entry.number, set, element);
    store_.preset(entry.number, set, element, before);

    ASSERT_TRUE(answer.success) << nameOf(place) << ": " << answer.message.str();
    EXPECT_EQ(entry.meant(stored, element + 1), entry.meant(answer.parameter.raw, element + 1)) << nameOf(place);
    values_.told[place] = known_.valueText(&entry, answer.parameter.raw, element + 1);
    if (stored != given) values_.shown.insert(place);
  }

  DrivenRobot& robot_;
  sim::ParameterStore& store_;
  catalogue::DriveCatalogue known_;
  Values values_;
};

template <typename Robot, typename Options>
Values valuesOf(const Options& options) {
  Robot robot{options};
  EXPECT_TRUE(robot.bringUp());
  return Reader{robot, robot.unit(0).parameters()}.readAll();
}

Values byPkw(Series series) {
  SimulatedRobot::Options options;
  options.one_module = series == Series::kSk2xxe;
  return valuesOf<SimulatedRobot>(options);
}

Values byMs1() {
  SimulatedRobot::Options options;
  options.one_module = true;
  options.drives["ppo_type"] = 3;
  return valuesOf<SimulatedRobot>(options);
}

Values bySdo(Series series) {
  CanRobot::Options options;
  if (series == Series::kSk2xxe) {
    options.gateway_inverters = 2;
    options.drives["series"] = std::string{"sk2xxe"};
    options.simulate = [](sim::SimConfig& config) {
      for (sim::DriveConfig& drive : config.drives) drive.device.series = sim::Series::kSk2xxe;
    };
  }
  return valuesOf<CanRobot>(options);
}

Values byExplicitMessages(Series series) {
  DevicenetRobot::Options options;
  options.on_inverter = series == Series::kSk5xxe;
  return valuesOf<DevicenetRobot>(options);
}

Values byPcp() {
  InterbusRobot::Options options;
  options.pcp = true;
  return valuesOf<InterbusRobot>(options);
}

void expectTheSame(const char* by, const Values& values, const Values& by_pkw) {
  SCOPED_TRACE(by);
  ASSERT_EQ(by_pkw.told.size(), values.told.size());
  std::size_t compared = 0;
  for (const auto& [place, told] : values.told) {
    ASSERT_EQ(1u, by_pkw.told.count(place)) << nameOf(place);
    if (by_pkw.shown.count(place) > 0 || values.shown.count(place) > 0) continue;
    EXPECT_EQ(by_pkw.told.at(place), told) << nameOf(place);
    ++compared;
  }
  EXPECT_GT(compared, values.told.size() * 9 / 10) << "what the inverter shows by itself is not compared";
}

TEST(SameValueOnEveryChannel, OfAnSk2xxe) {
  const Values by_pkw = byPkw(Series::kSk2xxe);
  ASSERT_GT(by_pkw.told.size(), 50u);
  expectTheSame("MS1", byMs1(), by_pkw);
  expectTheSame("SDO", bySdo(Series::kSk2xxe), by_pkw);
  expectTheSame("explicit messages", byExplicitMessages(Series::kSk2xxe), by_pkw);
}

TEST(SameValueOnEveryChannel, OfAnSk5xxe) {
  const Values by_pkw = byPkw(Series::kSk5xxe);
  ASSERT_GT(by_pkw.told.size(), 50u);
  expectTheSame("SDO", bySdo(Series::kSk5xxe), by_pkw);
  expectTheSame("explicit messages", byExplicitMessages(Series::kSk5xxe), by_pkw);
  expectTheSame("PCP", byPcp(), by_pkw);
}

}  // namespace
}  // namespace nord_driver::test

// One drive that is fine, and one that is not, for every rule and series.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>

#include "commissioning/checked_drive.h"
#include "commissioning/rules.h"

namespace nord_driver::commissioning {
namespace {

using profile::Series;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<Series> kDecentral{Series::kSk1x0e, Series::kSk2xxe};
const std::vector<Series> kOlder{Series::kSk300e, Series::kSk700e, Series::kSk750e};
const std::vector<Series> kSk5{Series::kSk5xxe, Series::kSk54xe};
const std::vector<Series> kSk511{Series::kSk5xxe}, kSk7{Series::kSk700e, Series::kSk750e};
const std::vector<Series> kPosicon{Series::kSk2xxe, Series::kSk5xxe, Series::kSk54xe, Series::kSk700e, Series::kSk750e};
const std::vector<Series> kAll(profile::kAllSeries.begin(), profile::kAllSeries.end());
const std::vector<Series> kSeparate{Series::kSk5xxe, Series::kSk300e, Series::kSk700e, Series::kSk750e};
const std::vector<Series> kArrays{Series::kSk54xe, Series::kSk1x0e, Series::kSk2xxe};

using Change = std::function<void(AskedDrive&)>;

void leave(AskedDrive&) {}
void behindModule(AskedDrive& asked) {
  asked.identity.timeout_owner = TimeoutOwner::kModule;
}
void unprotected(AskedDrive& asked) {
  asked.identity.protected_by.clear();
}
void needsTimeout(AskedDrive& asked) {
  asked.identity.timeout_needed = true;
}
void looksOn(AskedDrive& asked) {
  unprotected(asked);
  asked.looks_on = true;
}
void looksOnAtAGateway(AskedDrive& asked) {
  looksOn(asked);
  asked.identity.timeout_notices = false;
}
void looksOnAtCia402(AskedDrive& asked) {
  looksOn(asked);
  asked.identity.nord_profile = false;
}
void onePair(AskedDrive& asked) {
  asked.identity.process_values = 1;
}
void accepted(AskedDrive& asked) {
  asked.allows_minimum_frequency = true;
}
void typed60(AskedDrive& asked) {
  asked.typed_max_frequency = 60.0;
}
void ratedCurrent(AskedDrive& asked) {
  asked.rated_current = 3.5;
}
void limitsTorque(AskedDrive& asked) {
  asked.words.words = 3;
  asked.words.list.push_back({false, profile::WordUse::kTorqueLimit});
}
void limitsTorqueAndCurrent(AskedDrive& asked) {
  limitsTorque(asked);
  asked.words.list.push_back({false, profile::WordUse::kCurrentLimit});
}
void positions(AskedDrive& asked) {
  asked.words.words = 3;
  cycle::addPositionNeeds(cycle::PositionSetup{}, asked.series, asked.words);
}
void hasPositionBits(AskedDrive& asked) {
  cycle::PositionSetup setup;
  setup.home = cycle::PositionBit{cycle::PositionBit::Carrier::kBusBit, 3, 22};
  setup.reset = cycle::PositionBit{cycle::PositionBit::Carrier::kControlBit, 9, 61};
  setup.referenced = cycle::SignalSetup{};
  setup.referenced->source = cycle::SignalSource::kStatusBit;
  setup.referenced->number = 10;
  asked.position_bits = cycle::askedBits(setup, asked.series);
}
void measuresTorque(AskedDrive& asked) {
  asked.words.words = 3;
  asked.words.list.push_back({true, profile::WordUse::kTorqueCurrent});
}
void measuresTorqueAndCurrent(AskedDrive& asked) {
  measuresTorque(asked);
  ratedCurrent(asked);
}
void positionsWithCurrent(AskedDrive& asked) {
  positions(asked);
  ratedCurrent(asked);
}
void mayMove(AskedDrive& asked) {
  asked.may_move_bits = {2};
}
void slowBus(AskedDrive& asked) {
  asked.identity.worst_cycle = 0.6;
}
Change on(const std::string& transport) {
  return [transport](AskedDrive& asked) { asked.transport = transport; };
}
Change asks(double hertz) {
  return [hertz](AskedDrive& asked) { asked.top_frequency = hertz; };
}

struct Spoiled {
  ParameterKey key;
  std::int32_t raw;
};

/// P546 to P548, P543 to P545 and P600 as positions() needs them.
const std::vector<Spoiled> kPositioning{
    {{547, 1, 0}, 23}, {{548, 1, 0}, 24}, {{544, 1, 0}, 10}, {{545, 1, 0}, 15}, {{600, 1, 0}, 1}};
Change counts(double per_motor_turn) {
  return [per_motor_turn](AskedDrive& asked) {
    positions(asked);
    asked.counted_per_motor_turn = per_motor_turn;
  };
}
std::vector<Spoiled> withGear(std::int32_t ratio, std::int32_t reduction) {
  std::vector<Spoiled> all = kPositioning;
  all.push_back({{607, 1, 0}, ratio});
  all.push_back({{608, 1, 0}, reduction});
  return all;
}

struct Row {
  const char* what;
  std::vector<Series> series;
  Change change;
  std::vector<Spoiled> spoiled;
  std::vector<std::string> found;
};

// Values typed from the manuals that Rule::source names.
const std::vector<Row>& rows() {
  static const std::vector<Row> kRows{
      {"terminals", kDecentral, leave, {{{509}, 0}}, {"bus_has_control error P509 -> 3"}},
      {"terminals", kSk5, leave, {{{509}, 0}}, {"bus_has_control error P509 -> 4"}},
      {"terminals", kOlder, leave, {{{509}, 0}}, {"bus_has_control error P509 -> 10"}},
      {"setpoint only", kOlder, leave, {{{509}, 8}}, {"bus_has_control error P509 -> 10"}},
      {"control word only", kOlder, leave, {{{509}, 9}}, {"bus_has_control error P509 -> 10"}},
      {"another bus", kSk5, on("canopen"), {{{509}, 4}}, {"bus_has_control error P509 -> 6"}},
      {"another bus", kSk5, on("devicenet"), {{{509}, 6}}, {"bus_has_control error P509 -> 7"}},
      {"another bus", kSk5, on("interbus"), {{{509}, 6}}, {"bus_has_control error P509 -> 5"}},
      {"another bus", kOlder, on("interbus"), {{{509}, 10}}, {"bus_has_control error P509 -> 14"}},
      {"not printed", kOlder, on("canopen"), {{{509}, 10}}, {"bus_has_control error P509"}},
      {"not printed, may be", kOlder, on("canopen"), {{{509}, 17}}, {}},
      {"a transport of somebody else", kAll, on("my_card"), {{{509}, 1}}, {"bus_has_control error P509"}},
      {"a transport of somebody else, any bus", kAll, on("my_card"), {{{509}, 2}}, {}},
      {"behind a module", kSk511, behindModule, {{{509}, 4}, {{513}, 5}}, {"bus_has_control error P509 -> 6"}},
      {"ignored", kSk511, behindModule, {{{509}, 6}, {{513}, -1}}, {"bus_errors_heeded error P513 -> 5"}},

      {"setpoint of the terminals", kSk5, leave, {{{510, 0, 1}, 1}}, {"bus_gives_setpoint error P510[-01] -> 0"}},
      {"setpoint named", kSk5, leave, {{{510, 0, 1}, 4}}, {}},
      {"setpoint of the terminals", kDecentral, leave, {{{510, 0, 1}, 1}}, {"bus_gives_setpoint error P510[-01] -> 0"}},
      {"setpoint named", kDecentral, leave, {{{510, 0, 1}, 3}}, {}},

      {"first setpoint", kSeparate, leave, {{{546, 1, 0}, 0}}, {"first_setpoint error P546 set 1 -> 1"}},
      {"first setpoint", kArrays, leave, {{{546, 1, 1}, 2}}, {"first_setpoint error P546[-01] set 1 -> 1"}},
      {"in another set", kArrays, leave, {{{546, 3, 1}, 2}}, {"first_setpoint warning P546[-01] set 3 -> 1"}},
      {"first actual value", kSeparate, leave, {{{543, 1, 0}, 3}}, {"first_actual_value error P543 set 1 -> 1"}},
      {"first actual value", kArrays, leave, {{{543, 4, 1}, 3}}, {"first_actual_value warning P543[-01] set 4 -> 1"}},

      {"torque limit", kSeparate, leave, {{{547, 1, 0}, 2}}, {"further_setpoints error P547 set 1 -> 0"}},
      {"frequency addition", kSeparate, leave, {{{548, 1, 0}, 4}}, {"further_setpoints warning P548 set 1 -> 0"}},
      {"current limit", kSk7, leave, {{{547, 1, 0}, 6}}, {"further_setpoints error P547 set 1 -> 0"}},
      {"torque limit commanded", kSeparate, limitsTorque, {{{547, 1, 0}, 2}}, {}},
      {"in the other word", kSk511, limitsTorque, {{{548, 1, 0}, 2}}, {}},
      {"nothing carries it", kSk511, limitsTorque, {}, {"asked_words error P547 set 1 -> 2"}},
      // What is asked for comes first: of two remedies for one word the first is applied (fixesFor).
      {"another one in its place",
       kSk511,
       limitsTorque,
       {{{547, 1, 0}, 4}, {{548, 1, 0}, 4}},
       {"asked_words error P547 set 1 -> 2", "further_setpoints warning P547 set 1 -> 0",
        "further_setpoints warning P548 set 1 -> 0"}},
      {"two that nothing carries",
       kSk511,
       limitsTorqueAndCurrent,
       {},
       {"asked_words error P547 set 1 -> 2", "asked_words error P548 set 1 -> 6"}},
      {"nothing carries it", kDecentral, limitsTorque, {}, {"asked_words error P546[-02] set 1 -> 11"}},
      {"no torque current", kSk511, measuresTorque, {{{544, 1, 0}, 0}}, {"asked_words error P544 set 1 -> 4"}},
      {"not carried", kSeparate, onePair, {{{548, 1, 0}, 4}}, {}},
      {"torque limit", kDecentral, leave, {{{546, 1, 2}, 11}}, {"further_setpoints error P546[-02] set 1 -> 0"}},
      {"does not position",
       kSk511,
       positions,
       {{{547, 1, 0}, 21}, {{548, 1, 0}, 22}, {{544, 1, 0}, 10}, {{545, 1, 0}, 15}, {{600, 1, 0}, 0}},
       {"position_control error P600 set 1"}},
      {"positions", kPosicon, leave, {{{600, 1, 0}, 1}}, {"position_control error P600 set 1 -> 0"}},
      {"positions in another set", kPosicon, leave, {{{600, 3, 0}, 2}}, {"position_control warning P600 set 3 -> 0"}},
      {"positions, and is to", kSk511, positions, kPositioning, {}},
      {"bits of a position control",
       kSk511,
       hasPositionBits,
       {{{480, 0, 4}, 22}, {{480, 0, 12}, 61}, {{481, 0, 9}, 20}},
       {}},
      {"other bits",
       kSk511,
       hasPositionBits,
       {{{480, 0, 4}, 0}, {{480, 0, 12}, 22}, {{481, 0, 9}, 7}},
       {"position_bits warning P480[-04] -> 22", "position_bits warning P480[-12] -> 61",
        "position_bits warning P481[-09] -> 20"}},
      {"a bit that starts the motor",
       kSk511,
       hasPositionBits,
       {{{480, 0, 4}, 1}, {{480, 0, 12}, 61}, {{481, 0, 9}, 20}},
       {"position_bits warning P480[-04] -> 22", "bus_bits warning P480[-04] -> 22"}},
      {"no high word",
       kSk511,
       positions,
       {{{547, 1, 0}, 23}, {{548, 1, 0}, 0}, {{544, 1, 0}, 10}, {{545, 1, 0}, 15}, {{600, 1, 0}, 1}},
       {"asked_words error P548 set 1 -> 24"}},
      {"counts the motor", kSk511, positions, kPositioning, {}},
      {"counts through a gear", kSk511, positions, withGear(3, 2), {"position_gear warning P607 set 1"}},
      {"counts it as configured", kSk511, counts(1.5), withGear(3, 2), {}},
      {"counts it the other way round", kSk511, counts(1.5), withGear(2, 3), {}},
      {"counts another gear", kSk511, counts(1.5), withGear(5, 3), {"position_gear warning P607 set 1"}},
      {"an encoder behind the gear", kSk511, counts(0.05), kPositioning, {}},
      {"no gear at all", kSk511, positions, withGear(0, 1), {"position_gear warning P607 set 1"}},
      {"no current", kSeparate, ratedCurrent, {{{544, 1, 0}, 4}}, {"current note P545 set 1 -> 3"}},
      {"no word for a current", kSk511, positionsWithCurrent, kPositioning, {"current note P544 set 1"}},
      {"another word for a current",
       kSk511,
       measuresTorqueAndCurrent,
       {{{544, 1, 0}, 4}, {{545, 1, 0}, 0}},
       {"current note P545 set 1 -> 3"}},
      {"a current", kSeparate, ratedCurrent, {{{544, 1, 0}, 4}, {{545, 1, 0}, 3}}, {}},

      {"errors ignored", kSk5, leave, {{{513}, -1}}, {"bus_errors_heeded error P513 -> 0"}},
      {"errors ignored, as a word", kOlder, leave, {{{513}, 0xFFFF}}, {"bus_errors_heeded error P513 -> 0"}},
      {"nobody watches", kSk5, unprotected, {}, {"bus_errors_heeded error P513 -> 5"}},
      {"P513 watches", kSk5, unprotected, {{{513}, 5}}, {}},
      {"the gateway ends the words", kOlder, needsTimeout, {}, {"bus_errors_heeded error P513 -> 5"}},
      {"module ignores errors", kDecentral, leave, {{{151}, -1}}, {"bus_errors_heeded error P151 -> 0"}},
      {"nobody watches", kDecentral, unprotected, {}, {"bus_errors_heeded error P151 -> 500"}},
      {"too short", kSk5, slowBus, {{{513}, 5}}, {"timeout_long_enough warning P513 -> 6"}},
      {"too short", kDecentral, leave, {{{151}, 19}}, {"timeout_long_enough warning P151 -> 500"}},
      {"long enough", kDecentral, leave, {{{151}, 20}}, {}},
      {"a node that looks on", kAll, looksOn, {}, {}},
      {"errors ignored, looking on", kSk5, looksOn, {{{513}, -1}}, {}},
      {"trips while it looks on", kSk5, looksOn, {{{513}, 5}}, {"timeout_long_enough warning P513"}},
      {"trips while it looks on", kDecentral, looksOn, {{{151}, 500}}, {"timeout_long_enough warning P151"}},
      {"sends no words", kOlder, looksOnAtAGateway, {{{513}, 5}}, {}},
      {"CiA 402", kSk5, looksOnAtCia402, {{{513}, 5}}, {}},
      {"module not watched, looking on", kDecentral, looksOn, {{{120, 0, 1}, 0}}, {}},
      {"module not watched", kDecentral, leave, {{{120, 0, 1}, 0}}, {"module_watched warning P120[-01] -> 1"}},
      {"module not watched", kSk511, behindModule, {{{509}, 6}, {{513}, 0}}, {"module_watched warning P513 -> 5"}},

      {"too slow", kAll, asks(60.0), {}, {"top_speed warning P105 set 1"}},
      {"just fast enough", kAll, asks(50.0), {}, {}},
      {"hardly used", kAll, asks(4.9), {}, {"top_speed note P105 set 1"}},
      {"no limits", kAll, asks(0.0), {}, {}},
      {"as typed", kAll, typed60, {{{105, 1, 0}, 600}, {{105, 2, 0}, 600}, {{105, 3, 0}, 600}, {{105, 4, 0}, 600}}, {}},
      {"not as typed",
       kAll,
       typed60,
       {{{105, 1, 0}, 600}, {{105, 2, 0}, 600}, {{105, 3, 0}, 600}},
       {"maximum_as_typed warning P105 set 4"}},

      {"turns at 0", kAll, leave, {{{104, 1, 0}, 20}}, {"minimum_zero error P104 set 1 -> 0"}},
      {"turns at 0 in another set", kAll, leave, {{{104, 2, 0}, 20}}, {"minimum_zero warning P104 set 2 -> 0"}},
      {"accepted", kAll, accepted, {{{104, 1, 0}, 20}}, {"minimum_zero note P104 set 1 -> 0"}},
      {"enable by a bit",
       kAll,
       leave,
       {{{480, 0, 1}, 1}, {{480, 0, 8}, 2}, {{480, 0, 3}, 5}},
       {"bus_bits warning P480[-01] -> 0", "bus_bits warning P480[-08] -> 0"}},
      {"accepted with may_move", kAll, mayMove, {{{480, 0, 2}, 1}}, {"bus_bits note P480[-02]"}},
      {"enable by a control bit", kArrays, leave, {{{480, 0, 11}, 2}}, {"bus_bits warning P480[-11] -> 0"}},
      {"not saved", kAll, leave, {{{560}, 0}}, {"writes_saved warning P560 -> 1"}},
  };
  return kRows;
}

TEST(Rules, FindNothingInADriveThatIsRight) {
  for (const Series series : kAll) {
    for (const char* transport : {"profibus_dp", "canopen", "devicenet", "interbus"}) {
      const Drives drives{drive(askedDrive(series, transport))};
      EXPECT_THAT(shortly(check(drives)), IsEmpty()) << profile::toString(series) << " " << transport;
    }
  }
}

TEST(Rules, FindWhatIsWrongAndNothingElse) {
  for (const Row& row : rows()) {
    for (const Series series : row.series) {
      AskedDrive asked = askedDrive(series);
      row.change(asked);
      const catalogue::DriveCatalogue& known = knownOf(asked);
      CommissioningFacts facts = rightFacts(asked, known);
      for (const Spoiled& spoiled : row.spoiled) facts.store(spoiled.key, spoiled.raw);
      const Drives drives{{asked, known, facts, 1}};
      EXPECT_THAT(shortly(check(drives)), ElementsAreArray(row.found)) << row.what << ", " << profile::toString(series);
    }
  }
}

// No row of the table may be left out of the test above, and no rule of the one below.
TEST(Rules, AreAllTested) {
  std::set<std::string> tested{"set_in_force", "base_alike", "readable"};
  for (const Row& row : rows()) {
    for (const std::string& found : row.found) tested.insert(found.substr(0, found.find(' ')));
  }
  std::set<std::string> named;
  for (const Rule& rule : rules()) named.insert(rule.name);
  EXPECT_EQ(named, tested);
}

TEST(Rules, TellTheSetInForce) {
  for (const Series series : kAll) {
    const AskedDrive asked = askedDrive(series);
    const catalogue::DriveCatalogue& known = knownOf(asked);
    CommissioningFacts facts = rightFacts(asked, known);
    const Drives drives{{asked, known, facts, 3}};
    const Findings findings = check(drives);
    ASSERT_EQ(1u, findings.size()) << profile::toString(series);
    EXPECT_THAT(toText(findings[0]), HasSubstr("parameter set = 3: the driver stays in the set it finds"));
    EXPECT_EQ(Severity::kNote, findings[0].severity);
  }
}

TEST(Rules, TellTheGearOfTheCount) {
  AskedDrive asked = askedDrive(Series::kSk5xxe);
  counts(1.25)(asked);
  std::vector<std::pair<ParameterKey, std::int32_t>> spoil;
  for (const Spoiled& spoiled : withGear(3, 2)) spoil.emplace_back(spoiled.key, spoiled.raw);
  const Findings findings = check({drive(asked, spoil)});
  ASSERT_EQ(1u, findings.size());
  EXPECT_EQ(
      "P607 set 1 Speed ratio = 3: with P608 = 2 they are a gear between motor and count, and by position/gear_ratio "
      "and "
      "gear_ratio a revolution of the motor counts as 1.25: positions may be wrong by a factor; compare the position "
      "with "
      "the joint, and set position/gear_ratio to what is counted for one revolution of the joint's shaft, or both "
      "parameters to 1 (BU 2700, 6.4.4 (positions))",
      toText(findings[0]));
}

TEST(Rules, TellWhatCouldNotBeRead) {
  for (const Series series : kAll) {
    const AskedDrive asked = askedDrive(series);
    const catalogue::DriveCatalogue& known = knownOf(asked);
    CommissioningFacts facts = rightFacts(asked, known);
    facts.storeUnreadable({509, 0, 0});
    facts.storeUnreadable({104, 1, 0});
    facts.storeUnreadable({104, 2, 0});
    const Drives drives{{asked, known, facts, 1}};
    EXPECT_THAT(shortly(check(drives)), ElementsAre("readable warning P509", "readable warning P104 set 1"))
        << profile::toString(series);
  }
}

TEST(Rules, MissNoMaximumThatIsTypedIn) {
  AskedDrive asked = askedDrive(Series::kSk5xxe);
  const catalogue::DriveCatalogue& known = knownOf(asked);
  CommissioningFacts facts = rightFacts(asked, known);
  facts.storeUnreadable({105, 1, 0});
  EXPECT_THAT(shortly(check({{asked, known, facts, 1}})), ElementsAre("readable warning P105 set 1"));
  asked.typed_max_frequency = 50.0;
  EXPECT_THAT(check({{asked, known, facts, 1}}), IsEmpty());
}

// A technician looks it up.
TEST(Rules, NameAManualWithEveryFinding) {
  for (const Row& row : rows()) {
    for (const Series series : row.series) {
      AskedDrive asked = askedDrive(series);
      row.change(asked);
      std::vector<std::pair<ParameterKey, std::int32_t>> spoil;
      for (const Spoiled& spoiled : row.spoiled) spoil.emplace_back(spoiled.key, spoiled.raw);
      for (const Finding& finding : check({drive(asked, spoil)})) {
        EXPECT_FALSE(finding.why.empty());
        EXPECT_TRUE(finding.remedy || !finding.advice.empty()) << toText(finding);
        if (finding.key.number == 104) continue;  // no manual at hand describes it
        EXPECT_THAT(finding.source, HasSubstr("BU ")) << toText(finding);
      }
    }
  }
}

TEST(Rules, AreThoseOfTheDocument) {
  std::vector<std::string> written;
  std::ifstream file(std::string(NORD_DRIVER_SOURCE_DIR) + "/doc/commissioning.md");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("| `", 0) == 0) written.push_back(line);
  }
  EXPECT_THAT(written, ElementsAreArray(rulesAsRows()));
}

}  // namespace
}  // namespace nord_driver::commissioning

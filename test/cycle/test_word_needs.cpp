// Which words carry what a configuration needs, where 32 bits take the place of a word of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cycle/word_needs.h"
#include "profile/word_function.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;
using profile::WordUse;

PositionSetup position(std::uint8_t bits) {
  PositionSetup setup;
  setup.bits = bits;
  return setup;
}

WordNeeds needsOf(std::uint8_t bits, std::initializer_list<WordNeed> further, Series series = Series::kSk750e) {
  WordNeeds needs;
  needs.words = 3;
  needs.positions = true;
  addPositionNeeds(position(bits), series, needs);
  for (const WordNeed& need : further) needs.list.push_back(need);
  return needs;
}

// BU 0020 6.1.2: P548 "is only present if P546 is neither 3 nor 6". What stands in it is left over, and a torque limit put
// there would be half of the target.
TEST(WordNeeds, A32BitTargetLeavesNoThirdSetpoint) {
  const WordFunctions wide{{3, 1, 2}, {6, 1, 4}};
  const WordNeed torque{false, WordUse::kTorqueLimit};
  EXPECT_FALSE(carries(3, torque, wide, Series::kSk750e));
  EXPECT_TRUE(carries(3, torque, WordFunctions{{2, 1, 2}, {6, 1, 4}}, Series::kSk750e)) << "16 bits leave it its place";
  EXPECT_TRUE(carries(3, torque, WordFunctions{{3, 1, 2}, {6, 1, 4}}, Series::kSk5xxe)) << "other words, other codes";
  const auto missing = missingWord(needsOf(32, {torque}), wide, Series::kSk750e);
  ASSERT_TRUE(missing);
  EXPECT_EQ(547, missing->number);
}

// Setpoint 1 and actual value 1 of these series are the position's: what stands there instead is told as the position that
// is missing, and never as a frequency that it should be.
TEST(WordNeeds, OfSk7x0eTheFirstWordsNeedNotBeTheFrequency) {
  const WordNeeds needs = needsOf(32, {});
  const WordFunctions bits_first{{7, 0, 0}, {12, 0, 0}};
  EXPECT_TRUE(firstWordFits(needs, false, 7, Series::kSk750e));
  EXPECT_TRUE(firstWordFits(needs, true, 12, Series::kSk750e));
  const auto missing = missingWord(needs, bits_first, Series::kSk750e);
  ASSERT_TRUE(missing);
  EXPECT_EQ(546, missing->number);
  EXPECT_EQ(3, missing->expected);
  EXPECT_FALSE(firstWordFits(WordNeeds{}, false, 7, Series::kSk750e)) << "of a drive that follows velocities it is";
}

TEST(WordNeeds, A32BitPositionLeavesNoThirdActualValue) {
  const WordNeed current{true, WordUse::kTorqueCurrent};
  EXPECT_FALSE(carries(3, current, WordFunctions{{3, 1, 0}, {6, 1, 4}}, Series::kSk750e));
  EXPECT_TRUE(carries(3, current, WordFunctions{{3, 1, 0}, {1, 6, 4}}, Series::kSk750e)) << "the frequency has 16 bits";
}

// The second one would be sent as 0, and with it the target.
TEST(WordNeeds, APositionThatStandsInTwoWordsIsToBeSwitchedOff) {
  const auto low = *profile::setpointCode(Series::kSk5xxe, 2, WordUse::kPositionLow);
  const WordNeeds needs = needsOf(16, {}, Series::kSk5xxe);
  const WordFunctions once{{1, low, 0}, {1, *profile::actualValueCode(Series::kSk5xxe, WordUse::kPositionLow), 0}};
  EXPECT_FALSE(missingWord(needs, once, Series::kSk5xxe));
  WordFunctions twice = once;
  twice.setpoints[2] = low;
  const auto second = missingWord(needs, twice, Series::kSk5xxe);
  ASSERT_TRUE(second);
  EXPECT_EQ(548, second->number);
  EXPECT_EQ(0, second->expected);
  EXPECT_EQ(low, second->found);
  EXPECT_TRUE(second->surplus);
}

// Of all others every word with the function is written, alike.
TEST(WordNeeds, ATorqueLimitMayStandInTwoWords) {
  WordNeeds needs;
  needs.words = 3;
  needs.list.push_back({false, WordUse::kTorqueLimit});
  EXPECT_FALSE(missingWord(needs, WordFunctions{{1, 2, 2}, {1, 0, 0}}, Series::kSk5xxe));
}

// A bus I/O bit is carried by a word, whichever of the three it is; a bit of the control word by none.
TEST(WordNeeds, EachBitThatTeachesAPositionNeedsAWord) {
  const PositionBit bus{PositionBit::Carrier::kBusBit, 0, 24}, control{PositionBit::Carrier::kControlBit, 8, 24};
  const auto words = [](const TeachSetup& teach) {
    PositionSetup setup = position(32);
    setup.teach = teach;
    WordNeeds needs;
    addPositionNeeds(setup, Series::kSk5xxe, needs);
    return std::count_if(needs.list.begin(), needs.list.end(), [](const WordNeed& need) {
      return !need.actual_value && need.use == WordUse::kBusBits && need.first == 2 && need.last == 3;
    });
  };
  EXPECT_EQ(1, words({bus, control, control, 1}));
  EXPECT_EQ(1, words({control, bus, control, 1}));
  EXPECT_EQ(1, words({control, control, bus, 1}));
  EXPECT_EQ(1, words({bus, bus, bus, 1})) << "one for all of them";
  EXPECT_EQ(0, words({control, control, control, 1}));
  EXPECT_EQ(0, words({control, control, std::nullopt, 1}));
}

// The configuration refuses it before; asked all the same, it names no other function in its place.
TEST(WordNeeds, AFunctionThatTheSeriesHasNotIsNoNumber) {
  WordNeeds needs;
  needs.words = 3;
  needs.list.push_back({false, WordUse::kPosiconBits});
  const auto missing = missingWord(needs, WordFunctions{{1, 0, 0}, {1, 0, 0}}, Series::kSk5xxe);
  ASSERT_TRUE(missing);
  EXPECT_EQ(547, missing->number);
  EXPECT_EQ(0, missing->expected);
}

// P548 is not there beside 32 bits: told to be set it could not be found.
TEST(WordNeeds, BesideA32BitTargetNoThirdWordIsNamed) {
  const WordNeed torque{false, WordUse::kTorqueLimit}, bits{false, WordUse::kPosiconBits, 1, 3};
  const auto missing = missingWord(needsOf(32, {bits, torque}), WordFunctions{{3, 12, 0}, {6, 0, 0}}, Series::kSk750e);
  ASSERT_TRUE(missing);
  EXPECT_EQ(547, missing->number);
}

// Without `mode: position` word 1 is the frequency; a number in no manual is none of a position.
TEST(WordNeeds, TheFirstWordIsTheFrequencyUnlessThePositionTakesIt) {
  EXPECT_FALSE(firstWordFits(WordNeeds{}, false, 21, Series::kSk5xxe));
  EXPECT_FALSE(firstWordFits(WordNeeds{}, true, 10, Series::kSk5xxe));
  const WordNeeds needs = needsOf(32, {}, Series::kSk5xxe);
  EXPECT_TRUE(firstWordFits(needs, false, 21, Series::kSk5xxe));
  EXPECT_FALSE(firstWordFits(needs, false, 250, Series::kSk5xxe));
  EXPECT_FALSE(firstWordFits(needs, true, 250, Series::kSk5xxe));
}

// --- what is configured ----------------------------------------------------------------------------------------------

WordSetup reading(std::initializer_list<SignalSetup> signals) {
  WordSetup setup;
  setup.signals = signals;
  return setup;
}

SignalSetup signal(SignalSource source, std::uint8_t number) {
  SignalSetup made;
  made.source = source;
  made.number = number;
  return made;
}

std::string missing(const WordSetup& setup, const WordFunctions& functions, Series series = Series::kSk5xxe) {
  const auto word = missingWord(wordNeeds(setup, 3), functions, series);
  if (!word) return "none";
  return "P" + std::to_string(word->number) + (word->is_array ? "[" + std::to_string(word->index) + "]" : "") + " = " +
         std::to_string(word->expected);
}

TEST(WordNeeds, ASignalNeedsTheWordItIsReadFrom) {
  const WordFunctions off{{1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ("P547 = 17", missing(reading({signal(SignalSource::kBusInBit, 0)}), off));
  EXPECT_EQ("P544 = 12", missing(reading({signal(SignalSource::kBusOutBit, 0)}), off));
  EXPECT_EQ("P544 = 5", missing(reading({signal(SignalSource::kDigitalInput, 1)}), off));
  EXPECT_EQ("P544 = 5", missing(reading({signal(SignalSource::kRelay, 1)}), off));
  EXPECT_EQ("P544 = 17", missing(reading({signal(SignalSource::kAnalogInput, 1)}), off));
  EXPECT_EQ("P544 = 18", missing(reading({signal(SignalSource::kAnalogInput, 2)}), off));
  for (const SignalSource source : {SignalSource::kControlBit, SignalSource::kStatusBit, SignalSource::kModuleInput}) {
    EXPECT_EQ("none", missing(reading({signal(source, 8)}), off)) << "no setpoint and no actual value carries it";
  }
}

TEST(WordNeeds, OfEachUseOneWordInEachDirection) {
  const auto needed = [](std::initializer_list<SignalSetup> signals) {
    return wordNeeds(reading(signals), 3).list.size();
  };
  EXPECT_EQ(1u, needed({signal(SignalSource::kBusInBit, 0), signal(SignalSource::kBusInBit, 1)}));
  EXPECT_EQ(2u, needed({signal(SignalSource::kBusInBit, 0), signal(SignalSource::kBusOutBit, 0)}));
  EXPECT_EQ(2u, needed({signal(SignalSource::kRelay, 1), signal(SignalSource::kAnalogInput, 1)}));
}

// Of a series whose words are set in an array, the element is a part of what has to be set.
TEST(WordNeeds, TheParameterIsNamedAsTheSeriesHasIt) {
  const WordFunctions off{{1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ("P543[2] = 12", missing(reading({signal(SignalSource::kBusOutBit, 0)}), off, Series::kSk2xxe));
  EXPECT_EQ("P546[2] = 20", missing(reading({signal(SignalSource::kBusInBit, 0)}), off, Series::kSk2xxe));
}

// The effort of a joint is the torque current's.
TEST(WordNeeds, ATorqueNeedsTheTorqueCurrent) {
  WordSetup setup;
  EXPECT_EQ("none", missing(setup, {{1, 0, 0}, {1, 0, 0}}));
  setup.torque_at_limit = 10.0;
  EXPECT_EQ("P544 = 4", missing(setup, {{1, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ("none", missing(setup, {{1, 0, 0}, {1, 0, 4}}));
}

// P480 counts where a bit of it is in use, carried by a word or not.
TEST(WordNeeds, TheFunctionsOfBitsAreAskedForWhereOneIsInUse) {
  EXPECT_TRUE(wordNeeds(reading({signal(SignalSource::kControlBit, 8)}), 1).bits);
  EXPECT_TRUE(wordNeeds(reading({signal(SignalSource::kBusInBit, 0), signal(SignalSource::kRelay, 1)}), 3).bits);
  EXPECT_FALSE(wordNeeds(reading({signal(SignalSource::kModuleOutput, 1), signal(SignalSource::kRelay, 1)}), 3).bits);
}

TEST(WordNeeds, WhoOnlyLooksOnNeedsWhatHeReads) {
  const WordNeeds all =
      wordNeeds(reading({signal(SignalSource::kBusInBit, 0), signal(SignalSource::kAnalogInput, 1)}), 3);
  const WordNeeds inputs = onlyInputs(all);
  ASSERT_EQ(1u, inputs.list.size());
  EXPECT_EQ(WordUse::kAnalogInput1, inputs.list[0].use);
}

}  // namespace
}  // namespace nord_driver::cycle

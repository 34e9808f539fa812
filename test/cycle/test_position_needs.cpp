// Which words a drive that positions needs, and the parameter that is named where one is missing.
#include <gtest/gtest.h>

#include <string>

#include "cycle/word_needs.h"

namespace nord_driver::cycle {
namespace {

using profile::Series;

std::string missing(Series series, const WordFunctions& functions, const PositionSetup& setup,
                    std::size_t carried = 3) {
  WordNeeds needs;
  needs.words = carried;
  addPositionNeeds(setup, series, needs);
  const auto word = missingWord(needs, functions, series);
  if (!word) return "none";
  return std::to_string(word->number) + "[" + std::to_string(word->index) + "] -> " + std::to_string(word->expected);
}

std::string missing(Series series, const WordFunctions& functions, std::uint8_t bits = 32, std::size_t carried = 3) {
  PositionSetup setup;
  setup.bits = bits;
  return missing(series, functions, setup, carried);
}

// A word for the bits, and no place for the frequency: the first word is no longer it, instead of a half of the position.
TEST(PositionNeeds, LeaveRoomForTheBits) {
  PositionSetup setup;
  setup.home = PositionBit{PositionBit::Carrier::kBusBit, 0, 22};
  WordFunctions functions{{1, 21, 22}, {1, 10, 15}};
  EXPECT_EQ("547[1] -> 17", missing(Series::kSk5xxe, functions, setup));
  functions.setpoints = {1, 17, 22};
  EXPECT_EQ("546[1] -> 21", missing(Series::kSk5xxe, functions, setup));
  functions.setpoints = {21, 17, 22};
  EXPECT_EQ("none", missing(Series::kSk5xxe, functions, setup));
  functions.actual_values = {10, 15, 0};
  EXPECT_EQ("none", missing(Series::kSk5xxe, functions, setup));
  WordNeeds needs;
  needs.words = 3;
  addPositionNeeds(setup, Series::kSk5xxe, needs);
  EXPECT_TRUE(firstWordFits(needs, false, 17, Series::kSk5xxe));
  EXPECT_FALSE(firstWordFits(needs, true, 12, Series::kSk5xxe)) << "of the actual values it is the frequency";
}

TEST(PositionNeeds, WithElementsNeedNoTargetInWords) {
  PositionSetup setup;
  setup.axis.by_element = true;
  setup.array = PositionBit{PositionBit::Carrier::kBusBit, 4, 55};
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 17, 0}, {1, 10, 15}}, setup));
  EXPECT_EQ("547[1] -> 17", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 15}}, setup));
  EXPECT_EQ("543[3] -> 15", missing(Series::kSk2xxe, {{1, 20, 0}, {1, 10, 9}}, setup));
  setup.array = PositionBit{PositionBit::Carrier::kPosicon, 0, 55};
  EXPECT_EQ("none", missing(Series::kSk700e, {{3, 12, 0}, {6, 0, 0}}, setup));
  setup.bits = 16;
  EXPECT_EQ("none", missing(Series::kSk700e, {{4, 1, 0}, {6, 0, 0}}, setup));
}

TEST(PositionNeeds, NameTheParameterAndItsValue) {
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 15}}));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{22, 1, 21}, {15, 10, 0}}));
  EXPECT_EQ("547[1] -> 23", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 15}})) << "as 10 and 15 count (BU 2700 5.3)";
  EXPECT_EQ("548[1] -> 22", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 15}}));
  EXPECT_EQ("548[1] -> 24", missing(Series::kSk5xxe, {{1, 23, 2}, {1, 10, 15}})) << "the other half of that pair";
  EXPECT_EQ("548[1] -> 22", missing(Series::kSk5xxe, {{1, 21, 24}, {1, 10, 15}})) << "no halves of two pairs";
  EXPECT_EQ("546[2] -> 23", missing(Series::kSk2xxe, {{1, 0, 0}, {1, 4, 9}}));
  EXPECT_EQ("543[3] -> 15", missing(Series::kSk2xxe, {{1, 23, 24}, {1, 10, 9}}));
  EXPECT_EQ("546[1] -> 3", missing(Series::kSk700e, {{1, 0, 0}, {6, 0, 0}}));
  EXPECT_EQ("543[1] -> 6", missing(Series::kSk700e, {{3, 0, 0}, {1, 6, 0}})) << "32 bits are in word 1 only";
  EXPECT_EQ("none", missing(Series::kSk700e, {{6, 0, 0}, {10, 0, 0}})) << "increments are positions, too";
}

TEST(PositionNeeds, WithTwoWordsTakeTheFirstAsWell) {
  EXPECT_EQ("546[1] -> 21", missing(Series::kSk5xxe, {{1, 22, 0}, {10, 15, 0}}, 32, 2));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{21, 22, 0}, {10, 15, 0}}, 32, 2));
}

TEST(PositionNeeds, Of16BitsAreOneWordAndNoHighOne) {
  EXPECT_EQ("547[1] -> 23", missing(Series::kSk5xxe, {{1, 0, 0}, {1, 10, 0}}, 16));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 0}}, 16));
  EXPECT_EQ("548[1] -> 0", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 0}}, 16)) << "it would be taken for 32 bits";
  EXPECT_EQ("546[1] -> 2", missing(Series::kSk700e, {{1, 0, 0}, {6, 0, 0}}, 16, 1));
}

TEST(PositionNeeds, OfTwoWordsLeaveTheFirstToTheFrequencyWhereTheOtherSuffices) {
  EXPECT_EQ("547[1] -> 23", missing(Series::kSk5xxe, {{1, 2, 0}, {1, 10, 0}}, 16, 2));
}

// A half of a position in word 1 counts as one in any other.
TEST(PositionNeeds, PairTheHalvesWhereverOneStands) {
  EXPECT_EQ("547[1] -> 22", missing(Series::kSk5xxe, {{21, 0, 0}, {10, 15, 0}}, 32, 2));
  EXPECT_EQ("547[1] -> 21", missing(Series::kSk5xxe, {{22, 0, 0}, {10, 15, 0}}, 32, 2));
  EXPECT_EQ("547[1] -> 0", missing(Series::kSk5xxe, {{21, 21, 0}, {1, 10, 0}}, 16)) << "the second would be sent as 0";
  EXPECT_EQ("546[1] -> 0", missing(Series::kSk5xxe, {{22, 21, 0}, {1, 10, 0}}, 16)) << "it would be taken for 32 bits";
  EXPECT_EQ("545[1] -> 0", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 15}}, 16)) << "of the actual position, too";
}

// 32 bits of SK 700E and 750E stand in setpoint 1 only, whatever it carries now.
TEST(PositionNeeds, Of32BitsOfSk7x0eTakeTheFirstWordFromTheBits) {
  PositionSetup setup;
  setup.home = PositionBit{PositionBit::Carrier::kPosicon, 0, 22};
  EXPECT_EQ("546[1] -> 3", missing(Series::kSk750e, {{4, 0, 0}, {6, 0, 0}}, setup));
}

TEST(PositionNeeds, AskForNoBitsWhereTargetsStandInWords) {
  PositionSetup setup;
  setup.array = PositionBit{PositionBit::Carrier::kBusBit, 4, 55};
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 15}}, setup));
}

PositionSetup referencedBy(SignalSource source, std::uint8_t number, std::uint8_t bits) {
  PositionSetup setup;
  setup.bits = bits;
  setup.referenced = SignalSetup{};
  setup.referenced->source = source;
  setup.referenced->number = number;
  return setup;
}

// A reference run whose end no word shows would never end.
TEST(PositionNeeds, CarryTheBitThatShowsTheReference) {
  const PositionSetup by_bus_bit = referencedBy(SignalSource::kBusOutBit, 5, 16);
  EXPECT_EQ("545[1] -> 12", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 0}}, by_bus_bit));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 12}}, by_bus_bit));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 12, 10}}, by_bus_bit));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 0}, {1, 10, 0}}, referencedBy(SignalSource::kStatusBit, 13, 16)))
      << "the status word is always there";
}

// Three actual values of which the bits take one: the position's other half stands in the first.
TEST(PositionNeeds, LeaveRoomForTheBitThatShowsTheReference) {
  const PositionSetup setup = referencedBy(SignalSource::kBusOutBit, 5, 32);
  EXPECT_EQ("543[1] -> 15", missing(Series::kSk5xxe, {{1, 21, 22}, {1, 10, 12}}, setup));
  EXPECT_EQ("none", missing(Series::kSk5xxe, {{1, 21, 22}, {15, 10, 12}}, setup));
}

}  // namespace
}  // namespace nord_driver::cycle

#include <gtest/gtest.h>

#include <string>

#include "profile/word_function.h"

namespace nord_driver::profile {
namespace {

// The same use under other numbers: a word understood by another series' table would be another command.
TEST(WordFunction, HasATableForEachSeries) {
  EXPECT_EQ(WordUse::kTorqueLimit, findSetpointFunction(Series::kSk5xxe, 2, 2)->use);
  EXPECT_EQ(WordUse::kFrequencyAddition, findSetpointFunction(Series::kSk2xxe, 2, 2)->use);
  EXPECT_EQ(WordUse::kTorqueLimit, findSetpointFunction(Series::kSk300e, 3, 2)->use);
  EXPECT_EQ(11, setpointCode(Series::kSk2xxe, 2, WordUse::kTorqueLimit));
  EXPECT_EQ(2, setpointCode(Series::kSk54xe, 3, WordUse::kTorqueLimit));
  EXPECT_EQ(17, setpointCode(Series::kSk5xxe, 2, WordUse::kBusBits));
  EXPECT_EQ(20, setpointCode(Series::kSk1x0e, 2, WordUse::kBusBits));
}

// BU 0020 6.1.2: 7 means bus bits in P546, and the maximum frequency in P547.
TEST(WordFunction, KnowsThatSetpoint1OfTheOlderSeriesHasATableOfItsOwn) {
  EXPECT_EQ(WordUse::kBusBits, findSetpointFunction(Series::kSk700e, 1, 7)->use);
  EXPECT_EQ(WordUse::kMaximumFrequency, findSetpointFunction(Series::kSk700e, 2, 7)->use);
  EXPECT_EQ(WordUse::kPosition32, findSetpointFunction(Series::kSk750e, 1, 3)->use);
  EXPECT_EQ(nullptr, findSetpointFunction(Series::kSk300e, 1, 3)) << "only with POSICON, which SK 300E has not";
  EXPECT_EQ(nullptr, findSetpointFunction(Series::kSk300e, 2, 7)) << "only SK 7x0E";
}

// BU 0280 has the bus bits under 19, BU 0220 the torque of the servo mode.
TEST(WordFunction, LeavesWhatTwoManualsNameDifferentlyUnused) {
  for (const std::uint16_t code : {std::uint16_t{17}, std::uint16_t{19}}) {
    EXPECT_EQ(WordUse::kDisputed, findSetpointFunction(Series::kSk2xxe, 2, code)->use) << code;
    EXPECT_NE(WordUse::kDisputed, findSetpointFunction(Series::kSk5xxe, 2, code)->use) << code;
  }
}

TEST(WordFunction, KnowsActualValues) {
  EXPECT_EQ(WordUse::kFrequency, findActualValueFunction(Series::kSk750e, 1)->use);
  EXPECT_EQ(Nominal::kTorqueLimit, findActualValueFunction(Series::kSk5xxe, 4)->nominal);
  EXPECT_EQ(WordUse::kPosition16, findActualValueFunction(Series::kSk700e, 6)->use);
  EXPECT_EQ(nullptr, findActualValueFunction(Series::kSk5xxe, 6)) << "reserved";
  EXPECT_EQ(17, actualValueCode(Series::kSk2xxe, WordUse::kAnalogInput1));
  EXPECT_EQ(std::nullopt, actualValueCode(Series::kSk300e, WordUse::kAnalogInput1)) << "its table ends at 12";
}

TEST(WordFunction, NamesWhatItKnowsAndSaysWhatItDoesNot) {
  EXPECT_EQ("Torque current limit", std::string{setpointName(Series::kSk5xxe, 2, 2)});
  EXPECT_EQ("reserved or unknown", std::string{setpointName(Series::kSk5xxe, 2, 99)});
  EXPECT_EQ("reserved or unknown", std::string{actualValueName(Series::kSk5xxe, 13)});
}

// BU 2700 6.4.4: three parameters on SK 500E to 535E, arrays on the others.
TEST(WordFunction, SaysWhereAFunctionIsSet) {
  EXPECT_EQ(547, setpointParameter(Series::kSk5xxe, 2).number);
  EXPECT_FALSE(setpointParameter(Series::kSk5xxe, 2).is_array);
  EXPECT_EQ(546, setpointParameter(Series::kSk2xxe, 3).number);
  EXPECT_EQ(3, setpointParameter(Series::kSk2xxe, 3).index);
  EXPECT_TRUE(setpointParameter(Series::kSk54xe, 1).is_array);
  EXPECT_EQ(545, actualValueParameter(Series::kSk700e, 3).number);
}

}  // namespace
}  // namespace nord_driver::profile

// Which words carry positions, by series and function code: BU 0020 7.3.5 to 7.3.8, BU 2700 5.3 and 6.4.4.

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/inverter/position_fixture.h"

namespace nord_driver::sim {
namespace {

using Words = std::array<Word, 3>;

constexpr std::int32_t kBorders[] = {0,       1,      -1,      32'767,     32'768,     -32'768,
                                     -32'769, 65'536, -65'536, 50'000'000, -50'000'000};

Word low(std::int32_t value) {
  return static_cast<Word>(static_cast<std::uint32_t>(value) & 0xFFFFu);
}
Word high(std::int32_t value) {
  return static_cast<Word>(static_cast<std::uint32_t>(value) >> 16);
}

double targetOf(Axis& axis, const Words& words, unsigned carried = 3) {
  axis.send(0x047E, words, carried);
  return axis.model.posicon().target();
}

// "With the SK 500E in any two of the three words PZD2, PZD3, PZD4", by codes 21 to 24: BU 0020 7.3.5.
TEST(PositionWords, LowAndHighInAnyTwoWordsInAnyOrder) {
  for (const Series series : {Series::kSk5xxe, Series::kSk54xe, Series::kSk2xxe}) {
    for (const std::int32_t code : {21, 23}) {
      std::array<std::int32_t, 3> functions{0, code, code + 1};
      std::sort(functions.begin(), functions.end());
      do {
        for (const std::int32_t wanted : kBorders) {
          Axis axis(series);
          std::array<std::int32_t, 3> actual{};
          Words words{};
          for (unsigned n = 0; n < 3; ++n) {
            if (functions[n] == code) words[n] = low(wanted), actual[n] = 10;
            if (functions[n] == code + 1) words[n] = high(wanted), actual[n] = 15;
          }
          axis.words(functions, actual);
          EXPECT_NEAR(wanted * 0.001, targetOf(axis, words), 1e-9) << code;
        }
      } while (std::next_permutation(functions.begin(), functions.end()));
    }
  }
}

TEST(PositionWords, WhatTheEncoderShowsAtFirstIsInTheWords) {
  for (const std::int32_t shown : kBorders) {
    PosiconSettings settings;
    settings.position = shown * 0.001;
    Axis axis(Series::kSk2xxe, settings);
    axis.words({1, 23, 24}, {1, 10, 15});
    axis.send(0x047E, {});
    EXPECT_EQ(low(shown), axis.actual()[1]);
    EXPECT_EQ(high(shown), axis.actual()[2]);
  }
}

// "Only the Low word for the position can also be transferred": BU 2700 6.4.4.
TEST(PositionWords, ALowWordAloneHasASign) {
  Axis axis;
  axis.words({21, 0, 0}, {10, 0, 0});
  EXPECT_NEAR(32.767, targetOf(axis, {0x7FFF, 0, 0}), 1e-9);
  EXPECT_NEAR(-32.768, targetOf(axis, {0x8000, 0, 0}), 1e-9);
  EXPECT_NEAR(-0.001, targetOf(axis, {0xFFFF, 0, 0}), 1e-9);
}

TEST(PositionWords, AHighWordThatTheTelegramDoesNotCarryIsNone) {
  Axis axis;
  axis.words({21, 22, 0}, {10, 15, 0});
  EXPECT_NEAR(-0.001, targetOf(axis, {0xFFFF, 0, 0}, 1), 1e-9);
  EXPECT_NEAR(65.535, targetOf(axis, {0xFFFF, 0, 0}, 3), 1e-9);
}

// PZD2 and PZD3, the high word first; SW2 in PZD4, where these series have SW3 before SW2: BU 0020 7.3.5, 7.3.6.
TEST(PositionWords, TheFieldOfSk700eIsTheSecondAndTheThirdWord) {
  for (const Series series : {Series::kSk700e, Series::kSk750e}) {
    for (const std::int32_t wanted : kBorders) {
      PosiconSettings settings;
      settings.position = wanted * 0.001;
      Axis axis(series, settings);
      axis.words({3, 1, 0}, {6, 1, 4});
      // SW1 is PZD2, SW3 is PZD3, SW2 is PZD4.
      EXPECT_NEAR(wanted * 0.001, targetOf(axis, {high(wanted), 0x2000, low(wanted)}), 1e-9);
      EXPECT_EQ(high(wanted), axis.actual()[0]);
      EXPECT_EQ(low(wanted), axis.actual()[2]);
      EXPECT_EQ(0, axis.actual()[1]) << "IW2 by P544: no frequency";
    }
  }
}

TEST(PositionWords, Setpoint2IsATopSpeedBehindTheField) {
  Axis axis(Series::kSk700e);
  axis.words({3, 1, 0}, {6, 1, 0});
  axis.preset(600, 2);
  axis.send(0x047E, {});
  double fastest = 0.0;
  for (int i = 0; i < 1600; ++i) {
    axis.send(0x047F, {high(20'000), 0x1000, low(20'000)});
    fastest = std::max(fastest, axis.motor.rotorFrequency());
  }
  EXPECT_NEAR(12.5, fastest, 0.3);  // a quarter of 50 Hz
  EXPECT_NEAR(20.0, axis.position(), 0.001);
}

// On DeviceNet the low word comes first (BU 0280 4.2.1.1).
TEST(PositionWords, ABusMayTransferTheLowWordFirst) {
  Axis axis(Series::kSk700e, PosiconSettings{}, WideField{1, 0});
  axis.words({3, 0, 0}, {6, 0, 0});
  EXPECT_NEAR(-50'000.0, targetOf(axis, {low(-50'000'000), high(-50'000'000), 0}), 1e-9);
}

TEST(PositionWords, WithPpo1ThereIsNoFieldAndNoTarget) {
  Axis axis(Series::kSk700e);
  axis.words({3, 0, 0}, {6, 0, 0});
  EXPECT_EQ(0.0, targetOf(axis, {0x0001, 0, 0}, 1));
  EXPECT_FALSE(axis.model.wideActual());
}

TEST(PositionWords, SixteenBitsOfSk700eHaveASign) {
  Axis axis(Series::kSk700e);
  axis.words({2, 0, 0}, {6, 0, 0});
  EXPECT_NEAR(-32.768, targetOf(axis, {0x8000, 0, 0}, 1), 1e-9);
  EXPECT_NEAR(32.767, targetOf(axis, {0x7FFF, 0, 0}, 1), 1e-9);
}

// "Setpoint/actual position corresponding to an 8192 increment encoder": BU 0020 6.1.2, footnote 4.
TEST(PositionWords, IncrementsOfSk700eAre8192ARevolution) {
  PosiconSettings settings;
  settings.position = 2.5;
  Axis axis(Series::kSk700e, settings);
  axis.words({6, 0, 0}, {10, 0, 0});
  EXPECT_NEAR(-3.0, targetOf(axis, {high(-24'576), 0, low(-24'576)}), 1e-9);
  EXPECT_EQ(high(20'480), axis.actual()[0]);
  EXPECT_EQ(low(20'480), axis.actual()[2]);
}

TEST(PositionWords, SeriesWithoutPosiconHaveNone) {
  for (const Series series : {Series::kSk300e, Series::kSk1x0e}) {
    Axis axis(series);
    axis.words({2, 12, 24}, {6, 10, 15});
    EXPECT_EQ(0.0, targetOf(axis, {1000, 1000, 1000}));
    EXPECT_EQ(nullptr, axis.parameters.find(613));
  }
}

// A gateway that splits telegrams: low and high word from different moments.
TEST(PositionWords, TornWordsAreThoseOfTwoTelegrams) {
  Axis axis;
  axis.words({21, 22, 0}, {10, 15, 0});
  axis.send(0x047E, {low(65'535), high(65'535), 0});
  axis.model.setTornWords(true);
  EXPECT_NEAR(0.0, targetOf(axis, {low(65'536), high(65'536), 0}), 1e-9) << "the new low word, the old high word";
  EXPECT_NEAR(65.536, targetOf(axis, {low(65'536), high(65'536), 0}), 1e-9);
}

TEST(PositionWords, TornActualWordsJumpByAWholeHighWord) {
  PosiconSettings settings;
  settings.position = 65.0;
  settings.torn_words = true;
  Axis axis(Series::kSk5xxe, settings);
  axis.words({21, 22, 0}, {10, 15, 0});
  axis.send(0x047E, {});
  bool jumped = false;
  for (int i = 0; i < 400; ++i) {
    axis.send(0x047F, {low(66'000), high(66'000), 0});
    const Words words = axis.actual();
    const double shown = (words[1] * 65536 + words[0]) * 0.001;
    jumped = jumped || std::abs(shown - axis.position()) > 60.0;
  }
  EXPECT_TRUE(jumped);
  EXPECT_NEAR(66.0, axis.position(), 0.001);
}

}  // namespace
}  // namespace nord_driver::sim

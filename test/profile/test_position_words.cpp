// Where a position stands in the words, by function code. The words of the examples are typed from the manuals' layouts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "profile/position_words.h"

namespace nord_driver::profile {
namespace {

constexpr FunctionCodes kNone{0, 0, 0};

ProcessValues values(Word first, Word second, Word third) {
  return {toSigned(first), toSigned(second), toSigned(third)};
}

// BU 2700 5.3: P546 = 1, 23, 24 and P543 = 1, 10, 15. 100.000 revolutions are 100 000 steps, 0001 86A0h.
TEST(PositionWords, OfTheExampleInBu2700) {
  const PositionWords words = positionWords(Series::kSk2xxe, {1, 23, 24}, {1, 10, 15}, 3);
  EXPECT_EQ((PositionField{32, 1, 2, 1000}), words.setpoint);
  EXPECT_EQ((PositionField{32, 1, 2, 1000}), words.actual);
  EXPECT_EQ(0, words.speed_setpoint.value_or(9));
  EXPECT_EQ(0, words.speed_actual.value_or(9));
  ProcessValues sent = values(0x4000, 0, 0);
  putPosition(words.setpoint, 100'000, sent);
  EXPECT_EQ(values(0x4000, 0x86A0, 0x0001), sent);
  EXPECT_EQ(100'000, getPosition(words.actual, sent));
}

// BU 0020 7.3.5: P546 = 21 low and P547 = 22 high word, "any two of the three words PZD2, PZD3, PZD4".
TEST(PositionWords, OfSk53xeInAnyTwoWordsInEitherOrder) {
  for (const Series series : {Series::kSk5xxe, Series::kSk54xe, Series::kSk2xxe}) {
    const std::uint16_t low = series == Series::kSk2xxe ? 23 : 21;
    for (std::uint8_t at_low = 0; at_low < 3; ++at_low) {
      for (std::uint8_t at_high = 0; at_high < 3; ++at_high) {
        if (at_low == at_high) continue;
        FunctionCodes setpoints = kNone, actual_values = kNone;
        setpoints[at_low] = low;
        setpoints[at_high] = static_cast<std::uint16_t>(low + 1);
        actual_values[at_high] = 10;  // and the actual value the other way round
        actual_values[at_low] = 15;
        const PositionWords words = positionWords(series, setpoints, actual_values, 3);
        EXPECT_EQ((PositionField{32, at_low, at_high, 1000}), words.setpoint);
        EXPECT_EQ((PositionField{32, at_high, at_low, 1000}), words.actual);
        ProcessValues sent{};
        putPosition(words.setpoint, -2, sent);
        EXPECT_EQ(toSigned(0xFFFE), sent[at_low]);
        EXPECT_EQ(toSigned(0xFFFF), sent[at_high]);
      }
    }
  }
}

// "21 (23) low word, 22 (24) high word" (BU 0020 7.3.5): the two pairs count something else.
TEST(PositionWords, OfTwoPairsAreNone) {
  EXPECT_FALSE(positionWords(Series::kSk5xxe, {1, 21, 24}, {1, 10, 15}, 3).setpoint.carried());
  EXPECT_FALSE(positionWords(Series::kSk5xxe, {23, 22, 1}, {1, 10, 15}, 3).setpoint.carried());
  EXPECT_TRUE(positionWords(Series::kSk5xxe, {1, 23, 24}, {1, 10, 15}, 3).setpoint.carried());
}

// BU 2700 6.4.4: "only the low word can also be transferred", 32.767 to -32.768 revolutions.
TEST(PositionWords, OfALowWordAloneAre16Bits) {
  const PositionWords words = positionWords(Series::kSk5xxe, {1, 21, 0}, {10, 1, 0}, 2);
  EXPECT_EQ((PositionField{16, 1, 1, 1000}), words.setpoint);
  EXPECT_EQ((PositionField{16, 0, 0, 1000}), words.actual);
  EXPECT_EQ(1, words.speed_actual.value_or(9));
  ProcessValues sent = values(1, 2, 3);
  putPosition(words.setpoint, -1, sent);
  EXPECT_EQ(values(1, 0xFFFF, 3), sent);
  EXPECT_EQ(-32768, getPosition(words.actual, values(0x8000, 0, 0)));
  EXPECT_EQ(32767, getPosition(words.actual, values(0x7FFF, 0, 0)));
}

// BU 0020 7.3.1: the field of SW1 is PZD2 and PZD3, where SW3 stands otherwise; SW2 stays in PZD4. P547 = 1 is the speed.
TEST(PositionWords, OfSk7x0eAreOneFieldThatTakesSetpoint3) {
  const PositionWords words = positionWords(Series::kSk700e, {3, 1, 7}, {6, 1, 1}, 3, FieldOrder::kLowFirst);
  EXPECT_EQ((PositionField{32, 0, 2, 1000}), words.setpoint);
  EXPECT_EQ((PositionField{32, 0, 2, 1000}), words.actual);
  EXPECT_EQ(1, words.speed_setpoint.value_or(9));
  EXPECT_EQ(1, words.speed_actual.value_or(9)) << "P545 = 1 means nothing: IW3 is a half of the position";
  ProcessValues sent = values(0, 0x4000, 0);
  putPosition(words.setpoint, 0x00018ABC, sent);
  EXPECT_EQ(values(0x8ABC, 0x4000, 0x0001), sent);
  const PositionWords other = positionWords(Series::kSk750e, {3, 0, 0}, {6, 0, 0}, 3);
  putPosition(other.setpoint, 0x00018ABC, sent);
  EXPECT_EQ(values(0x0001, 0x4000, 0x8ABC), sent);
}

TEST(PositionWords, OfSk7x0eNeedALongTelegramFor32Bits) {
  EXPECT_FALSE(positionWords(Series::kSk700e, {3, 0, 0}, {6, 0, 0}, 1).setpoint.carried());
  const PositionWords words = positionWords(Series::kSk700e, {2, 0, 0}, {6, 0, 0}, 1);
  EXPECT_EQ((PositionField{16, 0, 0, 1000}), words.setpoint);
  EXPECT_EQ((PositionField{16, 0, 0, 1000}), words.actual) << "32 bits only where the setpoint has them";
}

// Note 4 of BU 0020 6.1.2: "corresponding to an 8192 increment encoder".
TEST(PositionWords, CountIncrementsOfSk7x0e) {
  const PositionWords words = positionWords(Series::kSk700e, {6, 0, 0}, {10, 0, 0}, 3);
  EXPECT_EQ((PositionField{32, 2, 0, 8192}), words.setpoint);
  EXPECT_EQ((PositionField{32, 2, 0, 8192}), words.actual);
  const PositionWords narrow = positionWords(Series::kSk700e, {5, 0, 0}, {10, 0, 0}, 3);
  EXPECT_EQ((PositionField{16, 0, 0, 8192}), narrow.setpoint);
  EXPECT_EQ((PositionField{16, 0, 0, 8192}), narrow.actual) << "32 bits only where the setpoint has them";
}

TEST(PositionWords, BeyondWhatTheBusCarriesAreNone) {
  const PositionWords words = positionWords(Series::kSk5xxe, {1, 21, 22}, {1, 10, 15}, 1);
  EXPECT_FALSE(words.setpoint.carried());
  EXPECT_FALSE(words.actual.carried());
  EXPECT_FALSE(positionWords(Series::kSk300e, {3, 0, 0}, {6, 0, 0}, 3).setpoint.carried());
  EXPECT_FALSE(positionWords(Series::kSk1x0e, {1, 0xFFFF, 24}, {1, 0xFFFF, 15}, 3).setpoint.carried());
}

// Whatever the codes are: what is put is got, and no word changes but those of the position.
TEST(PositionWords, PutAndGotAreTheSame) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937 random{seed};
    const std::vector<Series> all(std::begin(kAllSeries), std::end(kAllSeries));
    int carried = 0;
    for (int i = 0; i < 200'000; ++i) {
      const Series series = all[random() % all.size()];
      FunctionCodes codes{};
      for (auto& code : codes) code = static_cast<std::uint16_t>(random() % 25);
      const PositionField field = positionWords(series, codes, codes, 1 + random() % 3).setpoint;
      const ProcessValues before =
          values(static_cast<Word>(random()), static_cast<Word>(random()), static_cast<Word>(random()));
      ProcessValues after = before;
      const auto wide = static_cast<std::int32_t>(random());
      const std::int32_t steps = field.bits == 16 ? toSigned(static_cast<Word>(wide)) : wide;
      putPosition(field, steps, after);
      if (!field.carried()) {
        ASSERT_EQ(before, after) << "seed " << seed << ", " << i;
        continue;
      }
      ++carried;
      ASSERT_EQ(steps, getPosition(field, after)) << "seed " << seed << ", " << i;
      for (std::size_t place = 0; place < 3; ++place) {
        if (place == field.low || place == field.high) continue;
        ASSERT_EQ(before[place], after[place]) << "seed " << seed << ", " << i;
      }
    }
    EXPECT_GT(carried, 1000);
  }
}

}  // namespace
}  // namespace nord_driver::profile

#include <gtest/gtest.h>

#include "nord_driver/profile/position_words.h"
#include "nord_driver/profile/ppo.h"

namespace nord_driver::profile {
namespace {

// BU 0020 7.3.5: P546 = 3 is one field in PZD2 and PZD3; setpoint 2 stays in PZD4, whatever the swap of SW2 and SW3.
TEST(PositionWords, AreOneFieldOnSk7x0E) {
  for (const Series series : {Series::kSk700e, Series::kSk750e}) {
    const auto where = setpointPositionWords(series, {3, 2, 0});
    ASSERT_TRUE(where.has_value());
    ProcessOutput output;
    output.control_word = 0x047F;
    output.setpoints[1] = 0x2000;
    ASSERT_TRUE(splitPosition(0x00012345, *where, output.setpoints));
    const auto layout = ppoLayout(4, kIdentTechnologyUnit, series);
    const PpoWords words = pack(layout.value(), {}, output);
    const PpoWords expected = {0x047F, 0x0001, 0x2345, 0x2000, 0x0000, 0x0000};
    EXPECT_EQ(expected, words);
    EXPECT_TRUE(setpointPositionWords(series, {6, 0, 0}).has_value());
    EXPECT_FALSE(setpointPositionWords(series, {1, 0, 0}).has_value());
    EXPECT_FALSE(setpointPositionWords(series, {21, 22, 0}).has_value());
  }
}

// The actual position is 32 bits wide there when P546 says so (BU 0020 7.3.7).
TEST(PositionWords, FollowP546InTheAnswerOfSk7x0E) {
  const auto where = actualPositionWords(Series::kSk700e, {3, 0, 0}, {6, 1, 0});
  ASSERT_TRUE(where.has_value());
  const auto layout = ppoLayout(4, kIdentTechnologyUnit, Series::kSk700e);
  PkwWords pkw;
  ProcessInput input;
  ASSERT_TRUE(unpack(layout.value(), {0x0B37, 0xFFFF, 0xFFFE, 0x2000, 0, 0}, pkw, input));
  EXPECT_EQ(-2, joinPosition(*where, input.actual_values));
  EXPECT_EQ(0x2000, input.actual_values[1]);
  EXPECT_FALSE(actualPositionWords(Series::kSk700e, {1, 0, 0}, {6, 1, 0}).has_value());
  EXPECT_FALSE(actualPositionWords(Series::kSk700e, {3, 0, 0}, {1, 6, 0}).has_value());
}

// Two free words by function codes: 21 with 22, 23 with 24 (BU 0020 7.3.5); 10 with 15 back (BU 2700 5.3).
TEST(PositionWords, AreTwoFreeWordsOnTheOthers) {
  for (const Series series : {Series::kSk2xxe, Series::kSk5xxe, Series::kSk54xe}) {
    auto where = setpointPositionWords(series, {1, 23, 24});
    ASSERT_TRUE(where.has_value());
    EXPECT_EQ(1, where->low);
    EXPECT_EQ(2, where->high);
    where = setpointPositionWords(series, {22, 1, 21});
    ASSERT_TRUE(where.has_value());
    EXPECT_EQ(2, where->low);
    EXPECT_EQ(0, where->high);
    EXPECT_FALSE(setpointPositionWords(series, {21, 24, 1}).has_value());
    EXPECT_FALSE(setpointPositionWords(series, {21, 1, 0}).has_value());
    EXPECT_FALSE(setpointPositionWords(series, {3, 0, 0}).has_value());
    where = actualPositionWords(series, {1, 23, 24}, {1, 10, 15});
    ASSERT_TRUE(where.has_value());
    EXPECT_EQ(1, where->low);
    EXPECT_EQ(2, where->high);
    EXPECT_FALSE(actualPositionWords(series, {1, 23, 24}, {1, 10, 0}).has_value());
  }
  for (const Series series : {Series::kSk1x0e, Series::kSk300e}) {
    EXPECT_FALSE(setpointPositionWords(series, {3, 21, 22}).has_value());
    EXPECT_FALSE(actualPositionWords(series, {3, 21, 22}, {6, 10, 15}).has_value());
  }
}

// Two's complement over both words, +-50000.000 revolutions, and the third value is somebody else's.
TEST(PositionWords, SplitAndJoin) {
  struct Case {
    std::int32_t position;
    int low, high;
  };
  for (const Case& c : {Case{0, 0, 0}, Case{1, 1, 0}, Case{-1, -1, -1}, Case{65536, 0, 1}, Case{0x8000, -0x8000, 0},
                        Case{50000000, -3968, 762}, Case{-50000000, 3968, -763}}) {
    ProcessValues values{77, 77, 77};
    ASSERT_TRUE(splitPosition(c.position, {1, 2}, values));
    EXPECT_EQ(77, values[0]);
    EXPECT_EQ(c.low, values[1]) << c.position;
    EXPECT_EQ(c.high, values[2]) << c.position;
    EXPECT_EQ(c.position, joinPosition({1, 2}, values));
  }
  ProcessValues values{1, 2, 3};
  for (const std::int32_t beyond : {50000001, -50000001}) {
    EXPECT_FALSE(splitPosition(beyond, {0, 1}, values));
    EXPECT_EQ((ProcessValues{1, 2, 3}), values);
  }
}

}  // namespace
}  // namespace nord_driver::profile

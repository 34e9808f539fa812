#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "profile/pkw.h"

namespace nord_driver::profile {
namespace {

PkwOrder order(OrderLabel label, std::uint16_t number, Word index, std::int32_t value = 0) {
  PkwOrder result;
  result.label = label;
  result.number = number;
  result.index = index;
  result.value = value;
  return result;
}

// BU 2700 6.6.3: P102 in set 3 to 10.00 s is 744E 0200 0000 03E8, answered 444E 0200 0000 03E8.
TEST(Pkw, SpellsTheManualsWrite) {
  const PkwOrder write = order(OrderLabel::kWriteArrayWord, 102, pkwIndex(ParameterShape::kPerSet, 3, 1), 1000);
  EXPECT_EQ((PkwWords{0x744E, 0x0200, 0x0000, 0x03E8}), toWords(write));
  EXPECT_TRUE(answers(write, toAnswer({0x444E, 0x0200, 0x0000, 0x03E8})));
}

// P508 is PNU 1508 = 5E4h (BU 0020 7.5.1): reading it is 15E4.
TEST(Pkw, AddsAThousandToTheNumber) {
  EXPECT_EQ((PkwWords{0x15E4, 0, 0, 0}), toWords(order(OrderLabel::kRead, 508, 0)));
  EXPECT_EQ((PkwWords{0, 0, 0, 0}), toWords(PkwOrder{}));
}

// "For negative values, the High bytes must be filled up with FFh" (BU 2700 6.5.1.3).
TEST(Pkw, FillsTheHighWordOfNegativeValues) {
  EXPECT_EQ((PkwWords{0x25E9, 0, 0xFFFF, 0xFFFF}), toWords(order(OrderLabel::kWriteWord, 513, 0, -1)));
  EXPECT_EQ(-1, toAnswer({0x15E9, 0, 0xFFFF, 0xFFFF}).value);
  EXPECT_EQ(65535, toAnswer({0x15E9, 0, 0x0000, 0xFFFF}).value);
  EXPECT_EQ(0x00012345, toAnswer({0x25E9, 0, 0x0001, 0x2345}).value);
  EXPECT_EQ(0x2345, toAnswer({0x15E9, 0, 0x0001, 0x2345}).value);
}

// BU 0020 7.5.2: raw 15h is element 000101b, set 01b; 57h is element 010101b, set 11b. The raw element counts from 0.
TEST(Pkw, BuildsTheIndexInBothForms) {
  EXPECT_EQ(0x1500, pkwIndex(ParameterShape::kArrayPerSet, 2, 6));
  EXPECT_EQ(0x5700, pkwIndex(ParameterShape::kArrayPerSet, 4, 22));
  EXPECT_EQ(0x0000, pkwIndex(ParameterShape::kArrayPerSet, 1, 1));
  EXPECT_EQ(0x0200, pkwIndex(ParameterShape::kPerSet, 3, 7));
  EXPECT_EQ(0x0200, pkwIndex(ParameterShape::kArray, 4, 3));
  EXPECT_EQ(0xFE00, pkwIndex(ParameterShape::kArray, 1, 255));
  EXPECT_EQ(0x0000, pkwIndex(ParameterShape::kPlain, 4, 9));
}

// The table of order and answer labels in BU 2700 6.5.1.1, with AK 11 and 12 as BU 0020 7.5.1 has them.
TEST(Pkw, PairsOrdersAndAnswers) {
  const struct {
    OrderLabel order;
    unsigned first, second;
  } pairs[] = {
      {OrderLabel::kRead, 1, 2},
      {OrderLabel::kWriteWord, 1, 1},
      {OrderLabel::kWriteDouble, 2, 2},
      {OrderLabel::kReadArray, 4, 5},
      {OrderLabel::kWriteArrayWord, 4, 4},
      {OrderLabel::kWriteArrayDouble, 5, 5},
      {OrderLabel::kReadArrayLength, 6, 6},
      {OrderLabel::kWriteArrayDoubleRam, 5, 5},
      {OrderLabel::kWriteArrayWordRam, 4, 4},
      {OrderLabel::kWriteDoubleRam, 2, 2},
      {OrderLabel::kWriteWordRam, 1, 1},
  };
  for (const auto& pair : pairs) {
    for (unsigned label = 0; label < 16; ++label) {
      const PkwAnswer answer = toAnswer({static_cast<Word>(label << 12 | 0x44E), 0x0200, 0, 7});
      const bool expected = label == pair.first || label == pair.second || label == 7;
      EXPECT_EQ(expected, answers(order(pair.order, 102, 0x0200, 7), answer))
          << "order " << static_cast<int>(pair.order) << ", answer " << label;
    }
  }
}

// The plausibility check of BU 2700 6.5.1.1: label, number, index, and the value of a write.
TEST(Pkw, TakesNoAnswerOfAnotherOrder) {
  const PkwOrder write = order(OrderLabel::kWriteArrayWord, 102, 0x0200, 1000);
  EXPECT_FALSE(answers(write, toAnswer({0x444F, 0x0200, 0, 0x03E8})));
  EXPECT_FALSE(answers(write, toAnswer({0x444E, 0x0100, 0, 0x03E8})));
  EXPECT_FALSE(answers(write, toAnswer({0x444E, 0x0200, 0, 0x03E9})));
  EXPECT_FALSE(answers(write, toAnswer({0x0000, 0, 0, 0})));
  EXPECT_TRUE(answers(order(OrderLabel::kReadArray, 102, 0x0200), toAnswer({0x444E, 0x0200, 0, 0x03E9})));
}

// Of a double word all 32 bits are the value, of a word its 16: what the inverter says beside them is not compared.
TEST(Pkw, ComparesAsManyBitsAsWereWritten) {
  for (const auto& [label, index, answer] : {std::tuple{OrderLabel::kWriteDouble, Word{0}, 0x244Eu},
                                             {OrderLabel::kWriteDoubleRam, Word{0}, 0x244Eu},
                                             {OrderLabel::kWriteArrayDouble, Word{0x0200}, 0x544Eu},
                                             {OrderLabel::kWriteArrayDoubleRam, Word{0x0200}, 0x544Eu}}) {
    const PkwOrder write = order(label, 102, index, 0x00018ABC);
    const auto of = [&, pke = static_cast<Word>(answer), at = index](Word high, Word low) {
      return answers(write, toAnswer({pke, at, high, low}));
    };
    EXPECT_TRUE(of(0x0001, 0x8ABC));
    EXPECT_FALSE(of(0x0001, 0x8ABD)) << static_cast<int>(label);
    EXPECT_FALSE(of(0x0000, 0x8ABC)) << static_cast<int>(label);
    EXPECT_FALSE(of(0x8001, 0x8ABC)) << static_cast<int>(label);
  }
  EXPECT_TRUE(answers(order(OrderLabel::kWriteWord, 102, 0, -2), toAnswer({0x144E, 0, 0x0000, 0xFFFE})));
  EXPECT_TRUE(answers(order(OrderLabel::kWriteWord, 102, 0, -2), toAnswer({0x144E, 0, 0xFFFF, 0xFFFE})));
  EXPECT_FALSE(answers(order(OrderLabel::kWriteWord, 102, 0, -2), toAnswer({0x144E, 0, 0xFFFF, 0xFFFF})));
}

TEST(Pkw, ReadsTheErrorNumber) {
  const PkwAnswer answer = toAnswer({0x744E, 0x0200, 0, 201});
  EXPECT_EQ(201, answer.error_number);
  EXPECT_TRUE(answers(order(OrderLabel::kWriteArrayWordRam, 102, 0x0200, 7), answer));
}

TEST(Pkw, HasWordsForEveryListedError) {
  const std::uint16_t listed[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 101, 102, 103, 201, 202};
  for (const std::uint16_t number : listed) {
    EXPECT_EQ(std::string::npos, pkwErrorText(number).str().find("do not list")) << number;
    EXPECT_NE(ParameterReason::kNone, pkwReason(number)) << number;
  }
  EXPECT_EQ("PKW error 8, an error number the manuals do not list", pkwErrorText(8).str());
  EXPECT_EQ(ParameterReason::kOther, pkwReason(8));
}

// What the driver acts on (BU 2700 6.5.1.1, the table of error messages in PWE2).
TEST(Pkw, TellsTheReasonOfAnError) {
  EXPECT_EQ(ParameterReason::kNoSuchParameter, pkwReason(0));
  EXPECT_EQ(ParameterReason::kReadOnly, pkwReason(1));
  EXPECT_EQ(ParameterReason::kOutOfLimits, pkwReason(2));
  EXPECT_EQ(ParameterReason::kNoSuchElement, pkwReason(3));
  EXPECT_EQ(ParameterReason::kNotIndexed, pkwReason(4));
  EXPECT_EQ(ParameterReason::kNoInverter, pkwReason(101));
  EXPECT_EQ(ParameterReason::kNoInverter, pkwReason(102));
  EXPECT_EQ(ParameterReason::kNotSupported, pkwReason(201)) << "no order that spares the EEPROM";
  EXPECT_EQ(ParameterReason::kUnreadable, pkwReason(202));
  EXPECT_NE(std::string::npos, pkwErrorText(202).str().find("use PPO 2 or acyclic access")) << "the way out of it";
}

}  // namespace
}  // namespace nord_driver::profile

// What the cycle needs of parameters at compile time. That it says what the files say: test_catalogue_agreement.cpp.
#include <gtest/gtest.h>

#include "profile/cycle_parameters.h"
#include "profile/parameter_shape.h"

namespace nord_driver::profile {
namespace {

// BU 2700 6.6.3: P102 has a resolution of 0.01 s, so 03E8h is 10.00 s.
TEST(CycleParameters, ScaleTheManualsExample) {
  const CycleParameter* ramp = findCycleParameter(102, Series::kSk5xxe);
  ASSERT_NE(nullptr, ramp);
  EXPECT_DOUBLE_EQ(10.0, toValue(*ramp, 0x03E8));
}

// P513 = -0.1 s arrives as FFFFh: signed, whatever stands in the high word (BU 0020 6.1.2).
TEST(CycleParameters, ReadSignedAndUnsignedWords) {
  const CycleParameter* timeout = findCycleParameter(513, Series::kSk5xxe);
  ASSERT_NE(nullptr, timeout);
  EXPECT_DOUBLE_EQ(-0.1, toValue(*timeout, 0xFFFF));
  EXPECT_DOUBLE_EQ(-0.1, toValue(*timeout, -1));
  const CycleParameter* frequency = findCycleParameter(105, Series::kSk5xxe);
  ASSERT_NE(nullptr, frequency);
  EXPECT_DOUBLE_EQ(6553.5, toValue(*frequency, -1));
}

// The same number is another parameter in another series (BU 0020 6.1, 6.2; BU 0220 5.1; BU 0280 5.1).
TEST(CycleParameters, DifferBySeries) {
  EXPECT_EQ(ParameterShape::kPerSet, findCycleParameter(543, Series::kSk5xxe)->shape);
  EXPECT_EQ(5, findCycleParameter(543, Series::kSk54xe)->elements);
  EXPECT_EQ(3, findCycleParameter(543, Series::kSk2xxe)->elements);
  EXPECT_EQ(nullptr, findCycleParameter(544, Series::kSk54xe));
  EXPECT_EQ(nullptr, findCycleParameter(999, Series::kSk5xxe));
}

TEST(CycleParameters, AreArraysWhereTheyHaveElements) {
  for (const Series series : kAllSeries) {
    int found = 0;
    for (std::uint16_t number = 0; number < 1000; ++number) {
      const CycleParameter* parameter = findCycleParameter(number, series);
      if (parameter == nullptr) continue;
      ++found;
      EXPECT_EQ(number, parameter->number);
      EXPECT_EQ(isArray(parameter->shape), parameter->elements > 1) << number;
    }
    EXPECT_GT(found, 12) << toString(series);
  }
}

TEST(CycleParameters, BuildTheRequestOfAnElement) {
  const ParameterRequest version = readRequest(*findCycleParameter(707, Series::kSk5xxe), 2, 2);
  EXPECT_EQ(707, version.number);
  EXPECT_EQ(ParameterShape::kArray, version.shape);
  EXPECT_EQ(2, version.index);
  const ParameterRequest maximum = readRequest(*findCycleParameter(105, Series::kSk5xxe), 2, 0);
  EXPECT_EQ(2, maximum.parameter_set);
  EXPECT_EQ(1, maximum.index);
}

}  // namespace
}  // namespace nord_driver::profile

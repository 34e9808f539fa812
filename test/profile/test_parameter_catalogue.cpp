#include <gtest/gtest.h>

#include <limits>

#include "profile/parameter_catalogue.h"

namespace nord_driver::profile {
namespace {

// BU 2700 6.6.3: P102 has a resolution of 0.01 s, so 03E8h is 10.00 s.
TEST(ParameterCatalogue, ScalesTheManualsExample) {
  const ParameterInfo* info = findParameter(102, Series::kSk5xxe);
  ASSERT_NE(nullptr, info);
  EXPECT_DOUBLE_EQ(10.0, toValue(*info, 0x03E8));
  EXPECT_EQ(9999, toRaw(*info, 99.99));
  EXPECT_STREQ("s", info->unit);
}

// P513 = -0.1 s arrives as FFFFh: signed, whatever stands in the high word (BU 0020 6.1.2).
TEST(ParameterCatalogue, ReadsSignedAndUnsignedWords) {
  const ParameterInfo* timeout = findParameter(513, Series::kSk5xxe);
  ASSERT_NE(nullptr, timeout);
  EXPECT_DOUBLE_EQ(-0.1, toValue(*timeout, 0xFFFF));
  EXPECT_DOUBLE_EQ(-0.1, toValue(*timeout, -1));
  EXPECT_EQ(-1, toRaw(*timeout, -0.1));
  const ParameterInfo* bus_in = findParameter(740, Series::kSk5xxe);
  ASSERT_NE(nullptr, bus_in);
  EXPECT_DOUBLE_EQ(65535.0, toValue(*bus_in, -1));
}

TEST(ParameterCatalogue, RefusesValuesOutOfRange) {
  const ParameterInfo* ppo = findParameter(507, Series::kSk5xxe);
  ASSERT_NE(nullptr, ppo);
  EXPECT_EQ(std::nullopt, toRaw(*ppo, 0.0));
  EXPECT_EQ(std::nullopt, toRaw(*ppo, 5.0));
  EXPECT_EQ(std::nullopt, toRaw(*ppo, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(std::nullopt, toRaw(*ppo, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(4, toRaw(*ppo, 4.0));
}

// The same number is another parameter in another series (BU 0020 6.1, 6.2; BU 0220 5.1; BU 0280 5.1).
TEST(ParameterCatalogue, DiffersBySeries) {
  EXPECT_EQ(ParameterShape::kPerSet, findParameter(543, Series::kSk5xxe)->shape);
  EXPECT_EQ(5, findParameter(543, Series::kSk54xe)->elements);
  EXPECT_EQ(3, findParameter(543, Series::kSk2xxe)->elements);
  EXPECT_EQ(12, findParameter(543, Series::kSk700e)->maximum);
  EXPECT_EQ(nullptr, findParameter(544, Series::kSk54xe));
  EXPECT_EQ(10000, findParameter(513, Series::kSk300e)->maximum);
}

// Every entry can be found, scales back and forth over its limits, and no series knows a number twice.
TEST(ParameterCatalogue, IsConsistent) {
  int found = 0;
  for (const Series series : kAllSeries) {
    for (std::uint16_t number = 0; number < 1000; ++number) {
      const ParameterInfo* info = findParameter(number, series);
      if (info == nullptr) continue;
      ++found;
      EXPECT_EQ(number, info->number);
      EXPECT_LT(info->minimum, info->maximum) << number;
      EXPECT_EQ(info->maximum, toRaw(*info, toValue(*info, info->maximum))) << number;
      EXPECT_EQ(info->minimum, toRaw(*info, toValue(*info, info->minimum))) << number;
      EXPECT_EQ(info->is_signed, info->minimum < 0) << number;
      const bool is_array = info->shape == ParameterShape::kArray || info->shape == ParameterShape::kArrayPerSet;
      EXPECT_EQ(is_array, info->elements > 1) << number;
    }
  }
  EXPECT_GT(found, 150);
  EXPECT_EQ(nullptr, findParameter(999, Series::kSk5xxe));
}

TEST(ParameterCatalogue, BuildsTheRequestOfAnElement) {
  const ParameterRequest fault = readRequest(*findParameter(700, Series::kSk5xxe), 2, 3);
  EXPECT_EQ(700, fault.number);
  EXPECT_EQ(ParameterShape::kArray, fault.shape);
  EXPECT_EQ(3, fault.index);
  const ParameterRequest maximum = readRequest(*findParameter(105, Series::kSk5xxe), 2, 0);
  EXPECT_EQ(2, maximum.parameter_set);
  EXPECT_EQ(1, maximum.index);
}

}  // namespace
}  // namespace nord_driver::profile

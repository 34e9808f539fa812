#include <gtest/gtest.h>

#include "nord_driver/core/fixed_vector.h"

namespace nord_driver {
namespace {

TEST(FixedVector, TakesNoMoreThanItsCapacity) {
  FixedVector<int, 2> values;
  EXPECT_TRUE(values.push_back(1));
  EXPECT_TRUE(values.push_back(2));
  EXPECT_TRUE(values.full());
  EXPECT_FALSE(values.push_back(3));
  EXPECT_EQ(2u, values.size());
}

TEST(FixedVector, ErasesFromTheFront) {
  FixedVector<int, 4> values{1, 2, 3};
  values.eraseFront(2);
  EXPECT_EQ((FixedVector<int, 4>{3}), values);
  values.eraseFront(9);
  EXPECT_TRUE(values.empty());
}

TEST(FixedVector, GivesItsElementsFromTheFrontOneByOne) {
  FixedVector<int, 2> values{1, 2};
  EXPECT_EQ(1, values.takeFront());
  EXPECT_TRUE(values.push_back(3)) << "there is room again";
  EXPECT_EQ(2, values.takeFront());
  EXPECT_EQ(3, values.takeFront());
  EXPECT_EQ(std::nullopt, values.takeFront());
  EXPECT_TRUE(values.push_back(4)) << "taking from nothing took nothing away";
  EXPECT_EQ((FixedVector<int, 2>{4}), values);
}

TEST(FixedVector, ResizeFillsWithDefaultsNotWithOldValues) {
  FixedVector<int, 4> values{7, 8};
  values.clear();
  values.resize(2);
  EXPECT_EQ((FixedVector<int, 4>{0, 0}), values);
  values.resize(9);
  EXPECT_EQ(4u, values.size());
}

}  // namespace
}  // namespace nord_driver

#include <gtest/gtest.h>

#include <algorithm>

#include "profile/process_data_order.h"

namespace nord_driver::profile {
namespace {

// BU 0020 7.2.2.
TEST(ProcessDataOrder, OldSeriesPutTheThirdBeforeTheSecond) {
  EXPECT_TRUE(thirdBeforeSecond(Series::kSk300e));
  EXPECT_TRUE(thirdBeforeSecond(Series::kSk700e));
  EXPECT_TRUE(thirdBeforeSecond(Series::kSk750e));
  EXPECT_EQ(3, std::count_if(kAllSeries.begin(), kAllSeries.end(), thirdBeforeSecond));
}

}  // namespace
}  // namespace nord_driver::profile

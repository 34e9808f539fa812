#include <gtest/gtest.h>

#include "nord_driver/profile/series.h"

namespace nord_driver::profile {
namespace {

TEST(Series, ReadsEveryNameItWrites) {
  for (const Series series : kAllSeries) EXPECT_EQ(series, seriesFrom(toString(series)));
  EXPECT_EQ(Series::kSk5xxe, seriesFrom("sk5xxe"));
  EXPECT_EQ(std::nullopt, seriesFrom("SK5XXE"));
  EXPECT_EQ(std::nullopt, seriesFrom(""));
}

}  // namespace
}  // namespace nord_driver::profile

#include <gtest/gtest.h>

#include "nord_driver/profile/series.h"

namespace nord_driver::profile {
namespace {

TEST(Series, ReadsEveryNameItWrites) {
  for (const Series series : kAllSeries) EXPECT_EQ(series, seriesFrom(toString(series)));
  EXPECT_EQ(Series::kSk5xxe, seriesFrom("sk5xxe"));
  EXPECT_EQ(std::nullopt, seriesFrom(""));
}

TEST(Series, ReadsWhatTheNameplateSays) {
  EXPECT_EQ(Series::kSk5xxe, seriesFrom("SK5XXE"));
  EXPECT_EQ(Series::kSk5xxe, seriesFrom("SK535E"));
  EXPECT_EQ(Series::kSk5xxe, seriesFrom("SK 500E-750-340-A"));
  EXPECT_EQ(Series::kSk54xe, seriesFrom("SK 540E"));
  EXPECT_EQ(Series::kSk2xxe, seriesFrom("SK 205E"));
  EXPECT_EQ(Series::kSk1x0e, seriesFrom("SK 180E"));
  EXPECT_EQ(Series::kSk300e, seriesFrom("Sk300E"));
  EXPECT_EQ(Series::kSk750e, seriesFrom("SK 750E"));
}

TEST(Series, TakesNoWordThatCouldMeanTwo) {
  for (const char* word : {"sk", "SK 7x0E", "sk xxxe", "SK 550E", "SK 205", "SK 205EX", "5xxe", "sk+35e", "SK 170E",
                           "xk535e", "sx535e", "sk535f"}) {
    EXPECT_EQ(std::nullopt, seriesFrom(word)) << word;
  }
}

}  // namespace
}  // namespace nord_driver::profile

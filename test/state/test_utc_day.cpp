// Days by UTC and their text.
#include <gtest/gtest.h>

#include "state/utc_day.h"

namespace nord_driver::state {
namespace {

TEST(UtcDay, BeginsAtMidnight) {
  const WallTime epoch{};
  EXPECT_EQ(0, utcDay(epoch));
  EXPECT_EQ(0, utcDay(epoch + std::chrono::hours{24} - std::chrono::nanoseconds{1}));
  EXPECT_EQ(1, utcDay(epoch + std::chrono::hours{24}));
  EXPECT_EQ(-1, utcDay(epoch - std::chrono::nanoseconds{1}));
}

TEST(UtcDay, IsWrittenAndReadTheSame) {
  EXPECT_EQ("1970-01-01", dayText(0));
  EXPECT_EQ("2026-11-23", dayText(20'780));
  EXPECT_EQ(20'780, dayFrom("2026-11-23"));
  EXPECT_EQ(dayFrom("2024-02-28").value_or(0) + 2, dayFrom("2024-03-01")) << "a leap year";
}

TEST(UtcDay, TakesNothingElseForADay) {
  for (const char* wrong : {"", "2026-02-31", "2026-13-01", "2026-11-23 ", "26-11-23", "today"}) {
    EXPECT_FALSE(dayFrom(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace nord_driver::state

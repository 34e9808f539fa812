#include <gtest/gtest.h>

#include "core/baud_rate.h"
#include "nord_driver/core/time.h"

namespace nord_driver {
namespace {

using std::chrono::microseconds;

TEST(Time, SecondsGoBothWays) {
  EXPECT_EQ(std::chrono::milliseconds{200}, seconds(0.2));
  EXPECT_DOUBLE_EQ(0.2, toSeconds(seconds(0.2)));
}

TEST(BaudRate, BitTimes) {
  EXPECT_EQ(microseconds{22}, BaudRate{500'000}.bits(11));
  EXPECT_EQ(microseconds{22}, BaudRate{500'000}.characters(1));
  EXPECT_EQ(Duration{1'718'750}, BaudRate{19'200}.bits(33));
}

TEST(BaudRate, RoundsUpSoThatAPauseIsNeverTooShort) {
  EXPECT_EQ(Duration{22'003}, BaudRate{45'450}.bits(1));  // 22002.2 ns
}

}  // namespace
}  // namespace nord_driver

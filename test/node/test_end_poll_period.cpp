#include <gtest/gtest.h>

#include "node/end_poll_period.h"

namespace nord_driver::node {
namespace {

using std::chrono::milliseconds;

TEST(EndPollPeriodTest, IsHalfACycle) {
  EXPECT_EQ(milliseconds{5}, endPollPeriod(milliseconds{10}));
  EXPECT_EQ(milliseconds{10}, endPollPeriod(milliseconds{20}));
}

TEST(EndPollPeriodTest, IsBetween1And20Milliseconds) {
  EXPECT_EQ(milliseconds{1}, endPollPeriod(milliseconds{1}));
  EXPECT_EQ(milliseconds{20}, endPollPeriod(milliseconds{200}));
}

}  // namespace
}  // namespace nord_driver::node

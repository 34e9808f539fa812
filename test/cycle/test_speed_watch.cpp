#include <gtest/gtest.h>

#include "cycle/speed_watch.h"

namespace nord_driver::cycle {
namespace {

class SpeedWatchTest : public ::testing::Test {
 protected:
  void run(double command, double actual, double time, bool enabled = true) {
    for (const Instant end = now_ + seconds(time); now_ < end; now_ += seconds(0.01)) {
      watch_.update(enabled, command, actual, 10.0, now_);
    }
  }
  SpeedWatch watch_;
  Instant now_{std::chrono::hours{1}};
};

// 2 % of the maximum speed.
TEST_F(SpeedWatchTest, TellsTheDeviationAndWhetherItIsSmall) {
  run(5.0, 4.85, 0.1);
  EXPECT_NEAR(-0.15, watch_.deviation(), 1e-12);
  EXPECT_TRUE(watch_.atSpeed());
  run(5.0, 4.75, 0.1);
  EXPECT_FALSE(watch_.atSpeed());
  run(-5.0, -4.85, 0.1);
  EXPECT_TRUE(watch_.atSpeed());
}

// More than 5 % away for 3 s without a break; a ramp is shorter.
TEST_F(SpeedWatchTest, NoticesADriveThatDoesNotFollowForLong) {
  run(5.0, 4.0, 2.9);
  EXPECT_FALSE(watch_.isNotFollowing());
  run(5.0, 4.0, 0.2);
  EXPECT_TRUE(watch_.isNotFollowing());
  run(5.0, 4.9, 0.02);
  EXPECT_FALSE(watch_.isNotFollowing());
  run(5.0, 4.0, 2.9);
  EXPECT_FALSE(watch_.isNotFollowing()) << "counted anew";
}

TEST_F(SpeedWatchTest, LooksOnlyWhileEnabledAndScaled) {
  run(5.0, 0.0, 10.0, false);
  EXPECT_FALSE(watch_.isNotFollowing());
  EXPECT_FALSE(watch_.atSpeed());
  EXPECT_EQ(0.0, watch_.deviation());
  watch_.update(true, 5.0, 0.0, 0.0, now_);
  EXPECT_FALSE(watch_.isNotFollowing());
  EXPECT_FALSE(watch_.atSpeed());
}

}  // namespace
}  // namespace nord_driver::cycle

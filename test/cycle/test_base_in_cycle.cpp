// A base with sides in the cycle: its sizes, corrected while the node runs, and its pose.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

class BaseInCycle : public ::testing::Test, protected CycleBench {
 protected:
  void SetUp() override {
    run(80);
    ASSERT_TRUE(ask(RequestKind::kEnable).success);
  }
  void drive(double linear, double angular, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandBase(linear, angular);
      step();
    }
  }
};

// A correction while it drives would be a step of its speed.
TEST_F(BaseInCycle, TakesTheSizesThatAreCorrectedOnceItStands) {
  drive(0.0, 4.0, 5);
  const int before = setpoint(kRight);
  ASSERT_GT(before, 500);
  ports.tuneBase({2.0, 1.0, 1.0, true});
  drive(0.0, 4.0, 5);
  EXPECT_EQ(before, setpoint(kRight));
  drive(0.0, 0.0, 5);
  drive(0.0, 4.0, 5);
  EXPECT_NEAR(2 * before, setpoint(kRight), 1) << "twice the wheel separation";
  EXPECT_NEAR(-2 * before, setpoint(kLeft), 1);
}

// Somebody who waits for a motion that does not come is told why, as long as he asks for it.
TEST_F(BaseInCycle, IsToldToBeCommandedByTheNewestCommandAlone) {
  EXPECT_FALSE(snapshot().base.commanded);
  ASSERT_TRUE(ask(RequestKind::kDisable).success);
  drive(0.5, 0.0, 2);
  EXPECT_TRUE(snapshot().base.commanded);
  EXPECT_FALSE(snapshot().base.enabled);
  drive(0.0, 0.0, 2);
  EXPECT_FALSE(snapshot().base.commanded);
  drive(0.0, 0.5, 2);
  EXPECT_TRUE(snapshot().base.commanded);
  run(100);
  EXPECT_FALSE(snapshot().base.commanded) << "older than cmd_vel_timeout";
}

TEST_F(BaseInCycle, ResettingTheOdometryMakesItsPoseZero) {
  drive(1.0, 1.0, 100);
  drive(0.0, 0.0, 50);
  ASSERT_GT(snapshot().base.pose.x, 0.1);
  ASSERT_GT(snapshot().base.pose.heading, 0.1);
  EXPECT_TRUE(ask(RequestKind::kResetOdometry).success);
  EXPECT_EQ(0.0, snapshot().base.pose.x);
  EXPECT_EQ(0.0, snapshot().base.pose.y);
  EXPECT_EQ(0.0, snapshot().base.pose.heading);
}

}  // namespace
}  // namespace nord_driver::cycle

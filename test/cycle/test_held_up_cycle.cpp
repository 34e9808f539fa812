// A cycle that comes late: the computer was busy, or the bus took its time.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

constexpr double kAcceleration = 0.5;  // m/s^2

/// What setpoint 1 may change by in 0.1 s: 0.5 rad/s at the wheel, 52 of 16384, and one for the rounding.
constexpr int kTenthOfASecond = 53;

class HeldUpCycle : public ::testing::Test, protected CycleBench {
 protected:
  HeldUpCycle() : CycleBench{std::nullopt, kAcceleration} {}

  void SetUp() override {
    run(30);
    const Completion answer = ask(RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  /// The bus cycle stands still, while commands go on coming.
  void holdUp(double linear) {
    transport.time += std::chrono::seconds{2};
    commandBase(linear);
  }
};

// The wheels have not followed the ramp of the two seconds nobody told them of: the next setpoint is no jump.
TEST_F(HeldUpCycle, GoesOnWhereTheRampWas) {
  commandBase(1.0);
  run(20);
  const int before = setpoint(kLeft);
  ASSERT_GT(before, 60);
  holdUp(1.0);
  step();
  EXPECT_GT(setpoint(kLeft), before);
  EXPECT_LE(setpoint(kLeft), before + kTenthOfASecond);
  for (int i = 0; i < 300; ++i) {
    commandBase(1.0);
    step();
  }
  const int fast = setpoint(kLeft);
  ASSERT_GT(fast, 1000);
  holdUp(0.0);
  step();
  EXPECT_LT(setpoint(kLeft), fast) << "braking begins at once";
  EXPECT_GE(setpoint(kLeft), fast - kTenthOfASecond);
}

// Cycles that always take longer than cycle_rate says still brake as the limit says.
TEST_F(HeldUpCycle, KeepsTheRampOnASlowBus) {
  transport.exchange_time = std::chrono::milliseconds{50};
  for (int i = 0; i < 20; ++i) {
    commandBase(1.0);
    step();
  }
  EXPECT_NEAR(521, setpoint(kLeft), 27) << "0.5 m/s after a second";
}

// The wheels have stood for most of that time: half the speed of before over all of it would be 15 m.
TEST_F(HeldUpCycle, IsNoWayOfTheBase) {
  for (int i = 0; i < 400; ++i) {
    commandBase(1.0);
    step();
  }
  const double before = snapshot().base.pose.x;
  const double joint = snapshot().drives[kLeft].joint_position;
  ASSERT_GT(before, 1.0);
  transport.time += std::chrono::seconds{30};
  for (auto& inverter : transport.inverters) inverter.fault = true;
  run(10);
  EXPECT_NEAR(before, snapshot().base.pose.x, 0.5);
  EXPECT_NEAR(joint, snapshot().drives[kLeft].joint_position, 5.0);
}

// At 5 Hz three periods are longer than what a cycle may take otherwise: after more than these nobody knows the way.
TEST(HeldUpSlowCycle, IsNoWayAfterThreePeriods) {
  for (const auto& [held, known] :
       {std::pair{std::chrono::milliseconds{590}, true}, {std::chrono::milliseconds{610}, false}}) {
    CycleConfig config = CycleBench::config();
    config.cycle_rate = 5.0;
    CycleBench bench{config};
    bench.run(30);
    ASSERT_TRUE(bench.ask(RequestKind::kEnable).success);
    for (int i = 0; i < 40; ++i) {
      bench.commandBase(1.0);
      bench.step();
    }
    const double before = bench.snapshot().drives[CycleBench::kLeft].joint_position;
    bench.transport.time += held - CycleBench::kCycle;
    bench.commandBase(1.0);
    bench.step();
    EXPECT_EQ(known, bench.snapshot().drives[CycleBench::kLeft].joint_position > before + 1.0) << held.count() << " ms";
  }
}

}  // namespace
}  // namespace nord_driver::cycle

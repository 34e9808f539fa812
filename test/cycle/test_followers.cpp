// A drive that follows another one in the cycle: it has no command of its own, and goes where its leader goes.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

/// The lift leads drive 0; drive 1 stands alone.
CycleConfig led() {
  CycleConfig config = CycleBench::config();
  config.base.reset();
  config.drives[0].name = "follower";
  config.drives[0].follows = "lift";
  config.drives[0].leader = CycleBench::kLift;
  config.drives[1].name = "alone";
  return config;
}

class FollowersInCycle : public ::testing::Test, protected CycleBench {
 protected:
  FollowersInCycle() : CycleBench{led()} {}
  void SetUp() override {
    run(100);
    const Completion answer = ask(RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
  void drive(double velocity, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandLift(velocity);
      ports.commandDrive(0, {-velocity, transport.time, true});
      step();
    }
  }
};

TEST_F(FollowersInCycle, GoWhereTheirLeaderGoes) {
  drive(20.0, 20);
  EXPECT_NEAR(20.0, snapshot().drives[kLift].velocity_command, 0.02);
  EXPECT_NEAR(20.0, snapshot().drives[0].velocity_command, 0.02) << "not where a command of their own says";
  EXPECT_EQ(0.0, snapshot().drives[1].velocity_command);
  drive(-20.0, 20);
  EXPECT_NEAR(-20.0, snapshot().drives[0].velocity_command, 0.02);
}

// How fast it is to be its leader says; what it measures against that is the leader's ramp, not a deviation.
TEST_F(FollowersInCycle, AreNotComparedWithACommand) {
  transport.inverters[0].ramp = 0;
  drive(20.0, 400);
  EXPECT_EQ(0.0, snapshot().drives[0].speed_deviation);
  EXPECT_FALSE(snapshot().drives[0].not_following);
  EXPECT_TRUE(snapshot().drives[kLift].at_speed);
}

}  // namespace
}  // namespace nord_driver::cycle

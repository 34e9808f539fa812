// The angle of each drive's joint, as it is told for /joint_states: counted on from what the drive measures.
#include <gtest/gtest.h>

#include "cycle/cycle_bench.h"

namespace nord_driver::cycle {
namespace {

class JointAngles : public ::testing::Test, protected CycleBench {
 protected:
  void drive(double velocity, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      commandLift(velocity);
      step();
    }
  }
  const DriveSnapshot& lift() { return snapshot().drives[kLift]; }

 private:
  void SetUp() override {
    run(80);
    ASSERT_TRUE(ask(RequestKind::kEnable, kLift).success);
  }
};

TEST_F(JointAngles, AreCountedOnFromTheMeasuredVelocity) {
  EXPECT_EQ(0.0, lift().joint_position);
  drive(20.0, 20);
  const double begin = lift().joint_position;
  ASSERT_NEAR(20.0, lift().velocity, 0.02);
  drive(20.0, 100);
  EXPECT_NEAR(20.0, lift().joint_position - begin, 0.05) << "a second";
  EXPECT_EQ(0.0, snapshot().drives[kLeft].joint_position) << "the others stand";
}

// How far it went unseen nobody knows.
TEST_F(JointAngles, StayWhileTheDriveIsNotSeen) {
  drive(20.0, 100);
  transport.inverters[kLift].silent = true;
  drive(20.0, 10);
  ASSERT_FALSE(lift().online);
  const double lost = lift().joint_position;
  EXPECT_GT(lost, 10.0);
  drive(20.0, 100);
  EXPECT_EQ(lost, lift().joint_position);
}

}  // namespace
}  // namespace nord_driver::cycle

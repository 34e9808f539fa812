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

// The drive came to rest while nobody saw it: half of what it did before is no way it goes now.
TEST_F(JointAngles, GoOnFromRestAfterALoss) {
  drive(20.0, 100);
  transport.inverters[kLift].silent = true;
  drive(20.0, 10);
  ASSERT_FALSE(lift().online);
  const double lost = lift().joint_position;
  transport.inverters[kLift].switchOffAndOn();
  transport.inverters[kLift].silent = false;
  run(80);
  ASSERT_TRUE(lift().online);
  EXPECT_EQ(lost, lift().joint_position);
}

// Half a second without a cycle is way still; what lasts longer says nothing of the way between.
TEST_F(JointAngles, AreCountedOnOverHalfASecondAtMost) {
  drive(20.0, 100);
  const double before = lift().joint_position;
  transport.time += std::chrono::milliseconds{490};
  drive(20.0, 1);
  EXPECT_NEAR(10.0, lift().joint_position - before, 0.05);
  transport.time += std::chrono::milliseconds{490} + Duration{1};
  const double held = lift().joint_position;
  drive(20.0, 1);
  EXPECT_EQ(held, lift().joint_position);
}

TEST_F(JointAngles, AreThoseOfEachDrive) {
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  for (int i = 0; i < 100; ++i) {
    commandBase(0.0, 4.0);
    step();
  }
  EXPECT_LT(snapshot().drives[kLeft].joint_position, -1.0);
  EXPECT_GT(snapshot().drives[kRight].joint_position, 1.0);
  EXPECT_EQ(0.0, lift().joint_position);
}

// Until P105 is known a share of it is no speed: the first one that is moves nothing by itself.
TEST(JointAnglesBeforeP105, BeginWithTheFirstSpeedThatIsKnown) {
  CycleBench bench;
  bench.transport.hold_answers = true;
  bench.transport.inverters[CycleBench::kLift].terminals = true;  // it turns, whoever lets it
  bench.run(20);
  ASSERT_EQ(0.0, bench.snapshot().drives[CycleBench::kLift].velocity);
  bench.transport.answerAll();
  for (int i = 0; i < 100 && bench.snapshot().drives[CycleBench::kLift].velocity == 0.0; ++i) bench.step();
  ASSERT_GT(bench.snapshot().drives[CycleBench::kLift].velocity, 10.0);
  EXPECT_EQ(0.0, bench.snapshot().drives[CycleBench::kLift].joint_position);
  bench.step();
  EXPECT_GT(bench.snapshot().drives[CycleBench::kLift].joint_position, 0.1);
}

}  // namespace
}  // namespace nord_driver::cycle

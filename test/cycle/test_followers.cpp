// A drive that follows another one in the cycle: it has no command of its own, and goes where its leader goes.
#include <gtest/gtest.h>

#include <utility>

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

// P104: a follower told to go slower than its own would run ahead of its leader, or against it.
class FollowersWithMinimum : public ::testing::Test, protected CycleBench {
 protected:
  explicit FollowersWithMinimum(CycleConfig config = led(), const ScriptedTransport& prepared = ScriptedTransport{3})
      : CycleBench{accepting(std::move(config)), prepared} {}

  static CycleConfig accepting(CycleConfig config) {
    for (DriveSetup& setup : config.drives) setup.drive.allow_minimum_frequency = true;
    return config;
  }
  /// 5 Hz, 15.7 rad/s.
  void begin(DriveIndex follower) {
    transport.of_drive[follower][104] = 50;
    transport.inverters[follower].minimum = 1638;
    run(100);
    const Completion answer = ask(RequestKind::kEnable);
    ASSERT_TRUE(answer.success) << answer.message.c_str();
  }
};

TEST_F(FollowersWithMinimum, RestTogetherWithALeaderThatIsTooSlowForThem) {
  begin(0);
  const auto drive = [this](double velocity) {
    for (int i = 0; i < 60; ++i) {
      commandLift(velocity);
      step();
    }
  };
  drive(15.0);
  EXPECT_EQ(0, setpoint(kLift));
  EXPECT_EQ(0.0, snapshot().drives[0].velocity_command);
  EXPECT_TRUE(snapshot().drives[kLift].saturated);
  drive(16.0);
  EXPECT_NEAR(16.0, snapshot().drives[kLift].velocity_command, 0.02);
  EXPECT_NEAR(16.0, snapshot().drives[0].velocity_command, 0.02);
  EXPECT_FALSE(snapshot().drives[kLift].saturated);
}

/// One of the two has P104 > 0.
class FollowersThatShareTheirWords : public FollowersWithMinimum, public ::testing::WithParamInterface<DriveIndex> {
 protected:
  void expectWords(Word word) {
    EXPECT_EQ(word, controlWord(0));
    EXPECT_EQ(word, controlWord(kLift));
  }
};

// A follower with P509 as broadcast obeys its leader's word: 047F to one and 047E to the other would turn it at its P104,
// or leave it disabled.
TEST_P(FollowersThatShareTheirWords, RestAndResumeInTheSameWords) {
  begin(GetParam());
  expectWords(0x047E);
  for (const double velocity : {20.0, 0.0, -20.0}) {
    for (int i = 0; i < 200; ++i) {
      commandLift(velocity);
      step();
      ASSERT_EQ(controlWord(kLift), controlWord(0)) << velocity << " rad/s, cycle " << i;
    }
    expectWords(velocity == 0.0 ? 0x047E : 0x047F);
    EXPECT_NEAR(velocity, snapshot().drives[kLift].velocity_command, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, FollowersThatShareTheirWords, ::testing::Values(0, CycleBench::kLift));

// One that nobody follows turns at its own P104, as its inverter has it.
TEST_F(FollowersWithMinimum, AreNotAskedByADriveThatIsAlone) {
  begin(1);
  for (int i = 0; i < 60; ++i) {
    ports.commandDrive(1, {10.0, transport.time, true});
    step();
  }
  EXPECT_NEAR(10.0, snapshot().drives[1].velocity_command, 0.02);
  EXPECT_TRUE(snapshot().drives[1].saturated);
}

/// One of the two has no reverse.
class FollowersForwardOnly : public FollowersWithMinimum, public ::testing::WithParamInterface<DriveIndex> {
 protected:
  FollowersForwardOnly() : FollowersWithMinimum{led(), forwardOnly(GetParam())} {}
  static ScriptedTransport forwardOnly(DriveIndex drive) {
    ScriptedTransport transport{3};
    transport.forward_only = {drive};
    return transport;
  }
  void drive(double velocity) {
    for (int i = 0; i < 200; ++i) {
      commandLift(velocity);
      step();
    }
  }
};

// It would rest by OFF1 while the other one drives on, or hold its leader at a setpoint of 0, at which that one turns.
TEST_P(FollowersForwardOnly, WithMinimumRestTogetherWhereOneCannotReverse) {
  begin(0);
  drive(20.0);
  for (const DriveIndex i : {DriveIndex{0}, kLift}) EXPECT_NEAR(20.0, snapshot().drives[i].velocity_command, 0.02);
  EXPECT_FALSE(snapshot().drives[kLift].saturated);
  drive(-20.0);
  EXPECT_EQ(0x047E, controlWord(0));
  EXPECT_EQ(0, transport.inverters[0].frequency());
  for (const DriveIndex i : {DriveIndex{0}, kLift}) EXPECT_EQ(0, setpoint(i)) << i;
  EXPECT_TRUE(snapshot().drives[kLift].saturated);
}

// It hears its leader, whatever its own words say: turning with it, it is not saturated.
TEST_P(FollowersForwardOnly, WithoutMinimumOnlyItsOwnDirectionsBoundTheLeader) {
  run(100);
  ASSERT_TRUE(ask(RequestKind::kEnable).success);
  drive(-20.0);
  const bool leader = GetParam() == kLift;
  EXPECT_EQ(leader, setpoint(kLift) == 0);
  EXPECT_EQ(leader, snapshot().drives[kLift].saturated);
  EXPECT_FALSE(snapshot().drives[0].saturated);
  EXPECT_NEAR(leader ? 0.0 : -20.0, snapshot().drives[0].velocity_command, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Each, FollowersForwardOnly, ::testing::Values(0, CycleBench::kLift));

/// The left wheel leads the lift.
CycleConfig ledByAWheel() {
  CycleConfig config = CycleBench::config();
  config.drives[CycleBench::kLift].follows = config.drives[CycleBench::kLeft].name;
  config.drives[CycleBench::kLift].leader = CycleBench::kLeft;
  return config;
}

class FollowersOfAWheelWithMinimum : public FollowersWithMinimum {
 protected:
  FollowersOfAWheelWithMinimum() : FollowersWithMinimum{ledByAWheel()} {}
  void drive(double linear) {
    for (int i = 0; i < 60; ++i) {
      commandBase(linear);
      step();
    }
  }
};

TEST_F(FollowersOfAWheelWithMinimum, RestWithTheWholeBase) {
  begin(kLift);
  drive(1.5);
  for (const DriveIndex i : {kLeft, kRight}) EXPECT_EQ(0, setpoint(i)) << i;
  EXPECT_TRUE(snapshot().drives[kLeft].saturated);
  drive(1.6);
  for (const DriveIndex i : {kLeft, kRight}) EXPECT_NE(0, setpoint(i)) << i;
  EXPECT_FALSE(snapshot().drives[kLeft].saturated);
}

}  // namespace
}  // namespace nord_driver::cycle

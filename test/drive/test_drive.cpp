// Starting, enabling and running one drive.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

// BU 2700 6.6.1 and BU 0020 9.2: 0B70 -> 047E -> 0B31 -> 047F 2000 -> 0B37 2000, after the exchange that learns the
// set.
TEST_F(DriveTest, FollowsTheManualsStartUp) {
  EXPECT_EQ(0x0000, cycle(0x0B70));
  EXPECT_EQ(0x047E, cycle(0x0B70));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  drive_.requestEnable(now_);
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(0x047F, cycle(0x0B31));
  EXPECT_EQ(0x047F, cycle(0x0B37));
  EXPECT_EQ(0, setpoint_);
  EXPECT_EQ(Phase::kEnabled, report().phase);
  drive_.setVelocity({3.926990816987241});  // 25 Hz of 50
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0x2000, setpoint_);
  EXPECT_NEAR(25.0, report().frequency.value, 1e-9);
  EXPECT_NEAR(3.926990816987241, report().velocity.value, 1e-9);
  EXPECT_NEAR(3.926990816987241, report().velocity_command.value, 1e-9);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// 047E also says "parameter set 1": it must not reach an inverter whose set is not known yet (here: set 3, still
// turning).
TEST_F(DriveTest, LearnsTheSetBeforeItsFirstCommand) {
  EXPECT_EQ(0x0000, silence());
  EXPECT_EQ(0x0000, cycle(0x0000));  // the module answers, the inverter is off
  EXPECT_EQ(0x0000, cycle(0x8B37, 0x2000));
  EXPECT_EQ(0x847E, cycle(0x8B37, 0x2000));
  EXPECT_EQ(3, report().parameter_set);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(0x847E, cycle(0x8B31)) << i;
}

// SW1 is a share of P105 of the set in the same telegram, IW1 of the set in the status word (BU 0020 7.3.5).
TEST_F(DriveTest, ScalesByP105OfTheSetInForce) {
  cycle(0x8B31);
  cycle(0x8B31);
  drive_.requestEnable(now_);
  cycle(0x8B31);
  EXPECT_EQ(0x847F, cycle(0x8B37));
  drive_.setVelocity({3.926990816987241});  // 25 Hz of 100
  EXPECT_EQ(0x847F, cycle(0x8B37, 0x1000));
  EXPECT_EQ(0x1000, setpoint_);
  EXPECT_NEAR(25.0, report().frequency.value, 1e-9);
}

// No enable without "ready to switch on" seen after the request: the status from before it is no answer to it.
TEST_F(DriveTest, EnablesOnlyOnAFreshReady) {
  start();
  drive_.requestEnable(now_);
  EXPECT_EQ(0x047E, silence());
  EXPECT_EQ(0x047E, silence());
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(0x047F, cycle(0x0B37));
}

// A request that falls between telegram and answer: that answer is older than the request's own 047E.
TEST_F(DriveTest, WaitsForTheAnswerToItsOwnShutDown) {
  start();
  drive_.pollOutput(now_);
  drive_.requestEnable(now_);
  profile::ProcessInput ready;
  ready.status_word = 0x0B31;
  drive_.handleInput(ready, true, now_);
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(0x047F, cycle(0x0B37));
}

TEST_F(DriveTest, GoesBackToIdleWhenTheInverterDoesNotFollow) {
  start();
  drive_.requestEnable(now_);
  cycle(0x0B31);
  const Instant begin = now_;
  while (report().phase == Phase::kEnabling) {
    ASSERT_LT(now_ - begin, seconds(1.0));
    EXPECT_EQ(0x047F, cycle(0x0B31));
    EXPECT_EQ(0, setpoint_);
  }
  EXPECT_EQ(Refusal::kEnableTimeout, report().refusal);
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// 047F is out and may still come to act: OFF1 is held until "ready to switch on" is seen, as after any enabling.
TEST_F(DriveTest, StopsTheInverterThatFollowsTooLate) {
  start();
  drive_.requestEnable(now_);
  cycle(0x0B31);
  const Instant begin = now_;
  while (report().phase == Phase::kEnabling) {
    ASSERT_LT(now_ - begin, seconds(1.0)) << "enable_timeout does not end the enabling";
    cycle(0x0B33);
  }
  EXPECT_EQ(Refusal::kEnableTimeout, report().refusal);
  for (const Word late : {Word{0x0B33}, Word{0x0B37}, Word{0x0B37}}) {
    EXPECT_EQ(0x047E, cycle(late, 0x0800));
    EXPECT_EQ(Phase::kStopping, report().phase);
    EXPECT_FALSE(drive_.isAtRest());
  }
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// Each refusal of requestEnable() has its cause; none of them puts 047F on the wire.
class RefusalTest : public DriveTest {
 protected:
  Refusal ask() {
    drive_.requestEnable(now_);
    const Refusal refusal = report().refusal;
    EXPECT_EQ(0x0E, drive_.pollOutput(now_).control_word & 0x0F);
    EXPECT_STRNE("nothing", toString(refusal));
    return refusal;
  }
};

TEST_F(RefusalTest, WhileOffline) {
  drive_.requestEnable(now_);
  EXPECT_EQ(Refusal::kOffline, report().refusal);
  EXPECT_EQ(0x0000, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

TEST_F(RefusalTest, WhileAFaultStands) {
  start();
  cycle(0x0B38);
  EXPECT_EQ(Refusal::kFault, ask());
}

// The inverter acknowledges by itself when the enable goes, or by P506 (BU 0020 8): what was seen stays seen.
TEST_F(RefusalTest, AfterAFaultThatVanishedByItself) {
  start();
  cycle(0x0B38);
  cycle(0x0B31);
  EXPECT_TRUE(report().fault_latched);
  EXPECT_EQ(Refusal::kFaultLatched, ask());
}

TEST_F(RefusalTest, UnderLocalControl) {
  start();
  cycle(0x0931);
  EXPECT_EQ(Refusal::kLocalControl, ask());
}

TEST_F(RefusalTest, FromAStateWithoutAWayUp) {
  start();
  for (const int status : {0x0B37, 0x0B17, 0x0B30, 0x0B02}) {
    cycle(static_cast<Word>(status));
    EXPECT_EQ(Refusal::kWrongState, ask()) << status;
  }
}

TEST_F(RefusalTest, InASetThatIsNotTheCommandedOne) {
  start();
  EXPECT_EQ(0x047E, cycle(0x4B31));
  EXPECT_EQ(Refusal::kParameterSet, ask());
}

TEST_F(RefusalTest, WithoutP105OfTheSetInForce) {
  cycle(0x4B31);
  cycle(0x4B31);
  EXPECT_EQ(Refusal::kMaxFrequencyUnknown, ask());
  EXPECT_FALSE(report().scaled);
  drive_.setMaxFrequency(2, {std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(Refusal::kMaxFrequencyUnknown, ask());
  drive_.setMaxFrequency(2, {70.0});
  drive_.requestEnable(now_);
  EXPECT_EQ(Refusal::kNone, report().refusal);
}

TEST_F(RefusalTest, WhileStopping) {
  run();
  drive_.requestShutdown(now_);
  EXPECT_EQ(Refusal::kStopping, ask());
}

// What is no number becomes 0 on the wire, and is said.
TEST_F(DriveTest, NeverSendsNonsense) {
  run();
  for (const double nonsense : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    drive_.setVelocity({nonsense});
    EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
    EXPECT_EQ(0, setpoint_);
    EXPECT_TRUE(report().command_invalid);
    EXPECT_EQ(0.0, report().velocity_command.value);
  }
  drive_.setVelocity({1.0});
  cycle(0x0B37, 0x2000);
  EXPECT_FALSE(report().command_invalid);
}

TEST_F(DriveTest, SaturatesAtP105) {
  run();
  drive_.setVelocity({-1000.0});
  cycle(0x0B37, 0x2000);
  EXPECT_EQ(-16384, setpoint_);
  EXPECT_TRUE(report().saturated);
  EXPECT_NEAR(-7.853981633974483, report().velocity_command.value, 1e-9);
  EXPECT_NEAR(7.853981633974483, drive_.maxVelocity()->value, 1e-9);
}

// Reverse is the sign of setpoint 1, with bits 11 and 12 = 0.
TEST_F(DriveTest, ReversesByTheSignOfTheSetpoint) {
  run();
  drive_.setVelocity({-3.926990816987241});
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
  EXPECT_EQ(-0x2000, setpoint_);
}

// A velocity from before enabling is not waiting for it.
TEST_F(DriveTest, ForgetsVelocitiesGivenWhileNotEnabled) {
  start();
  drive_.setVelocity({5.0});
  drive_.requestEnable(now_);
  drive_.setVelocity({5.0});
  cycle(0x0B31);
  cycle(0x0B37);
  cycle(0x0B37);
  EXPECT_EQ(0, setpoint_);
}

// The sign of IW1 in left rotation is inferred; a contradiction with bits 11 and 12 is told, unless switched off.
TEST_F(DriveTest, TellsWhenSignAndDirectionBitsContradict) {
  run();
  cycle(0x1337, -0x2000);
  EXPECT_FALSE(report().direction_contradiction);
  cycle(0x1337, 0x2000);
  EXPECT_TRUE(report().direction_contradiction);
  cycle(0x0B37, -0x2000);
  EXPECT_TRUE(report().direction_contradiction);
  cycle(0x0337, 0x2000);  // neither bit, or both: they tell no direction
  EXPECT_FALSE(report().direction_contradiction);
  cycle(0x1B37, -0x2000);
  EXPECT_FALSE(report().direction_contradiction);
  cycle(0x0B37, -100);  // at rest bit 11 is 1 whatever the sign
  EXPECT_FALSE(report().direction_contradiction);

  DriveConfig relaxed = config();
  relaxed.check_direction = false;
  Drive other(relaxed);
  profile::ProcessInput input;
  input.status_word = 0x1337;
  input.actual_values[0] = 0x2000;
  other.handleInput(input, true, now_);
  EXPECT_FALSE(other.report().direction_contradiction);
}

}  // namespace
}  // namespace nord_driver::drive

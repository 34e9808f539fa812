// Every way one drive stops.
#include <gtest/gtest.h>

#include <utility>

#include "drive/drive_fixture.h"

namespace nord_driver::drive {
namespace {

// OFF1 is no latch (bits 0 and 3 back during the ramp run the motor up again): 047E until "ready to switch on" is seen.
TEST_F(DriveTest, HoldsOff1UntilReadyToSwitchOn) {
  run();
  drive_.requestShutdown(now_);
  for (int i = 0; i < 20; ++i) {
    drive_.requestEnable(now_);
    drive_.setVelocity({5.0});
    ASSERT_EQ(0x047E, cycle(0x0A37, 0x1000)) << i;
    ASSERT_EQ(0, setpoint_);
    ASSERT_EQ(Phase::kStopping, report().phase);
  }
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_TRUE(drive_.isAtRest());
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// Its profile has an ordinary stop in the place of OFF2 and OFF3.
TEST_F(DriveTest, EndsAStopWithoutOff2AndOff3WhereAnOrdinaryOneEnds) {
  for (const bool has : {true, false}) {
    DriveConfig with = config();
    with.has_quick_stop = has;
    for (const bool coast : {true, false}) {
      drive_ = Drive{with};
      run();
      if (coast) {
        drive_.requestCoast(now_);
      } else {
        drive_.requestQuickStop(now_);
      }
      cycle(0x0A37, 0x1000);
      EXPECT_EQ(coast ? Phase::kCoasting : Phase::kQuickStopping, report().phase);
      cycle(0x0B31);
      EXPECT_EQ(!has, report().phase == Phase::kIdle);
      cycle(0x0B70);
      EXPECT_EQ(Phase::kIdle, report().phase);
    }
  }
}

TEST_F(DriveTest, QuickStopsWhenOff1DoesNotEnd) {
  run();
  drive_.requestShutdown(now_);
  const Instant begin = now_;
  while (cycle(0x0A37, 0x1000) == 0x047E) ASSERT_LE(now_ - begin, seconds(1.1));
  EXPECT_GE(now_ - begin, seconds(1.0));
  EXPECT_EQ(0x047B, cycle(0x0A17, 0x0800));
  EXPECT_EQ(StopCause::kShutdownTimeout, report().stop_cause);
}

// Terminals may end the ramp before it is over (OFF2, OFF3): there is nothing left to wait for.
TEST_F(DriveTest, EndsOff1WhenTerminalsDisableTheInverter) {
  run();
  drive_.requestShutdown(now_);
  EXPECT_EQ(0x047E, cycle(0x0A37, 0x1000));
  EXPECT_EQ(0x047E, cycle(0x0B60));
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(0x047E, cycle(0x0B70));
}

// What the inverter said before it got the word of a stop confirms nothing.
TEST_F(DriveTest, TakesNoStateFromBeforeAStopForItsEnd) {
  profile::ProcessInput ready, disabled;
  ready.status_word = 0x0B31;
  disabled.status_word = 0x0B70;
  start();
  drive_.requestEnable(now_);
  cycle(0x0B31);
  ASSERT_EQ(0x047F, cycle(0x0B31)) << "on its way up";
  drive_.requestShutdown(now_);
  drive_.handleInput(ready, true, now_);
  EXPECT_EQ(Phase::kStopping, report().phase);
  drive_.requestQuickStop(now_);
  drive_.handleInput(disabled, true, now_);
  EXPECT_EQ(Phase::kQuickStopping, report().phase);
  drive_.requestCoast(now_);
  drive_.handleInput(disabled, true, now_);
  EXPECT_EQ(Phase::kCoasting, report().phase);
  EXPECT_EQ(0x047D, cycle(0x0B70));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// A fault ends every way of stopping: its output is off, and "switch-on disabled" comes only after an acknowledgement.
TEST_F(DriveTest, AFaultEndsEveryStop) {
  using Request = void (Drive::*)(Instant, StopCause) noexcept;
  for (const Request request : {&Drive::requestShutdown, &Drive::requestQuickStop, &Drive::requestCoast}) {
    drive_ = Drive{config()};
    run();
    (drive_.*request)(now_, StopCause::kNone);
    cycle(0x0B37, 0x2000);
    ASSERT_NE(Phase::kIdle, report().phase);
    cycle(0x0B38);
    EXPECT_EQ(Phase::kIdle, report().phase);
    EXPECT_EQ(0x047E, cycle(0x0B38));
    EXPECT_TRUE(drive_.isAtRest());
  }
}

// OFF3 keeps bit 1 (without it the motor would coast) and ends in "switch-on disabled"; nothing restarts the drive.
TEST_F(DriveTest, HoldsTheQuickStopUntilSwitchOnDisabled) {
  run();
  drive_.requestQuickStop(now_);
  EXPECT_EQ(0x047B, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0, setpoint_);
  for (int i = 0; i < 20; ++i) {
    drive_.requestEnable(now_);
    ASSERT_EQ(0x047B, cycle(0x0A17, 0x1000)) << i;
  }
  EXPECT_EQ(0x047B, cycle(0x0B50));
  for (int i = 0; i < 20; ++i) ASSERT_EQ(0x047E, cycle(i < 2 ? 0x0B70 : 0x0B31)) << i;
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kQuickStop, report().stop_cause);
}

// A drive at "ready to switch on" is told as well, at least once.
TEST_F(DriveTest, QuickStopsAnIdleDriveToo) {
  start();
  drive_.requestQuickStop(now_);
  EXPECT_EQ(0x047B, cycle(0x0B31));
  EXPECT_EQ(0x047B, cycle(0x0B50));
  EXPECT_EQ(0x047E, cycle(0x0B31));
}

TEST_F(DriveTest, DropsToIdleOnAFaultAndRemembersIt) {
  run();
  EXPECT_EQ(0x047F, cycle(0x0B3F, 0x2000));
  EXPECT_EQ(0x047E, cycle(0x0B38, 0x1000));
  EXPECT_EQ(0, setpoint_);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(0x047E, cycle(0x0B31)) << i;
  EXPECT_EQ(StopCause::kFault, report().stop_cause);
  EXPECT_TRUE(report().fault_latched);
  EXPECT_EQ(0x0B3F, report().stop_status_word);
}

// OFF2 or OFF3 at terminals (status bits 4 and 5, BU 2700 6.4.2), or anything else that leaves "operation enabled":
// named, and never back by itself.
TEST_F(DriveTest, LatchesEveryUnaskedExit) {
  const std::pair<int, StopCause> kExits[] = {
      {0x0B70, StopCause::kUnaskedExit}, {0x0B31, StopCause::kUnaskedExit}, {0x0B33, StopCause::kUnaskedExit},
      {0x0B30, StopCause::kUnaskedExit}, {0x0B17, StopCause::kOff3},        {0x0B50, StopCause::kOff3},
      {0x0B60, StopCause::kOff2},        {0x0B40, StopCause::kOff2},        {0x0B02, StopCause::kOff2}};
  for (const auto& [status, cause] : kExits) {
    drive_ = Drive(config());
    run();
    EXPECT_EQ(0x047F, cycle(static_cast<Word>(status), 0x2000));
    for (int i = 0; i < 10; ++i) ASSERT_EQ(0x047E, cycle(0x0B37, 0x2000)) << status;
    EXPECT_EQ(cause, report().stop_cause) << status;
    EXPECT_EQ(Phase::kIdle, report().phase);
  }
}

TEST_F(DriveTest, KeepsTheStatusWordOfTheTerminalsStop) {
  run();
  cycle(0x0B17, 0x2000);
  cycle(0x0B70, 0);
  EXPECT_EQ(StopCause::kOff3, report().stop_cause);
  EXPECT_EQ(0x0B17, report().stop_status_word);
}

// A terminal's stop while enabling is named, too.
TEST_F(DriveTest, NamesTheStopThatEndsTheEnabling) {
  start();
  drive_.requestEnable(now_);
  cycle(0x0B31);
  EXPECT_EQ(0x047F, cycle(0x0B60));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(StopCause::kOff2, report().stop_cause);
  EXPECT_EQ(Refusal::kStopped, report().refusal);
}

// OFF2: bit 1 = 0, bit 10 and the rest as ever (BU 2700 6.4.1), until "switch-on disabled"; a quick stop does not take
// its place.
TEST_F(DriveTest, CoastsUntilSwitchOnDisabled) {
  run();
  drive_.requestCoast(now_);
  EXPECT_EQ(0x047D, cycle(0x0B37, 0x2000));
  EXPECT_EQ(0, setpoint_);
  drive_.requestQuickStop(now_);
  drive_.requestEnable(now_);
  EXPECT_EQ(Refusal::kStopping, report().refusal);
  EXPECT_EQ(0x047D, cycle(0x0B31));
  EXPECT_EQ(0x047D, cycle(0x0B60));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kCoast, report().stop_cause);
}

TEST_F(DriveTest, CarriesTheCoastIntoTheDark) {
  run();
  drive_.requestCoast(now_);
  fallSilent();
  EXPECT_EQ(0x047D, silence());
}

// Bit 9 = 0: the terminals may turn the motor, and a standing 047F would act when the bit returns (BU 0220 5.1.2).
TEST_F(DriveTest, DropsToIdleUnderLocalControl) {
  run();
  EXPECT_EQ(0x047F, cycle(0x0937, 0x2000));
  for (int i = 0; i < 10; ++i) ASSERT_EQ(0x047E, cycle(i < 5 ? 0x0937 : 0x0B37, 0x2000)) << i;
  EXPECT_EQ(StopCause::kLocalControl, report().stop_cause);
}

// Under local control the terminals choose the set: our word must not switch it back the moment control returns.
TEST_F(DriveTest, FollowsTheSetUnderLocalControl) {
  start();
  EXPECT_EQ(0x047E, cycle(0x8937, 0x2000));
  EXPECT_EQ(0x847E, cycle(0x8B37, 0x2000));
  EXPECT_EQ(0x847E, cycle(0x8B31));
}

// Setpoint 1 would be a share of another P105: a step of the speed.
TEST_F(DriveTest, StopsWhenTheSetChangesByItself) {
  run();
  EXPECT_EQ(0x047F, cycle(0x8B37, 0x2000));
  EXPECT_EQ(0x047E, cycle(0x8B37, 0x1000));
  EXPECT_EQ(StopCause::kParameterSet, report().stop_cause);
}

// The other set has another brake ramp (P103), which may last for minutes: as after a stop that was asked for, the
// quick stop follows (OFF3 in the set that was commanded, 047Bh). The cause that came first stays.
TEST_F(DriveTest, QuickStopsWhenOff1DoesNotEndInAChangedSet) {
  run();
  cycle(0x8B37, 0x2000);
  const Instant begin = now_;
  while (cycle(0x8B37, 0x1000) == 0x047E) ASSERT_LE(now_ - begin, seconds(1.1));
  EXPECT_GE(now_ - begin, seconds(1.0));
  EXPECT_EQ(0x047B, cycle(0x8B37, 0x1000));
  EXPECT_EQ(StopCause::kParameterSet, report().stop_cause);
  EXPECT_EQ(0x047B, cycle(0x8B50));
  EXPECT_EQ(0x047E, cycle(0x8B31));
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// Under local control no word is evaluated (BU 0220 5.1.2), however long the terminals turn the motor: OFF1 has its
// whole time from the moment control returns.
TEST_F(DriveTest, CountsOff1FromTheReturnOfControl) {
  run();
  for (int i = 0; i < 300; ++i) ASSERT_EQ(i < 1 ? 0x047F : 0x047E, cycle(0x0937, 0x2000)) << i;
  for (int i = 0; i < 99; ++i) ASSERT_EQ(0x047E, cycle(0x0B37, 0x1000)) << i;
  cycle(0x0B37, 0x1000);
  EXPECT_EQ(0x047B, cycle(0x0B37, 0x1000));
  EXPECT_EQ(StopCause::kLocalControl, report().stop_cause);
}

// A driver that starts over a motor that turns stops it with OFF1, and not only with that.
TEST_F(DriveTest, QuickStopsADriveThatIsFoundTurningAndTurnsOn) {
  for (int i = 0; i < 101; ++i) ASSERT_NE(0x047B, cycle(0x0B37, 0x2000)) << i;
  EXPECT_EQ(0x047B, cycle(0x0B37, 0x2000));
  EXPECT_EQ(StopCause::kShutdownTimeout, report().stop_cause);
}

// An idle drive at rest is left alone, for hours.
TEST_F(DriveTest, NeverQuickStopsAnIdleDriveAtRest) {
  start();
  for (const int status : {0x0B31, 0x0B70, 0x0B33, 0x0B38, 0x0937}) {
    for (int i = 0; i < 200; ++i) ASSERT_EQ(0x047E, cycle(static_cast<Word>(status))) << status;
  }
}

// Silence shorter than drive_timeout is bridged; longer is the end of "enabled".
TEST_F(DriveTest, BridgesShortSilence) {
  run();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(0x047F, silence()) << i;
  EXPECT_EQ(0x047F, cycle(0x0B37, 0x2000));
  EXPECT_EQ(Phase::kEnabled, report().phase);
}

// A drive that does not answer may still hear: 0000 would let it run on, so 047E is sent on unanswered. Then the set is
// learned anew, and it stays disabled.
TEST_F(DriveTest, StopsASilentDriveAndLearnsAgain) {
  run();
  const Instant last = now_;
  fallSilent();
  EXPECT_LE(now_ - last, seconds(0.07));
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
  EXPECT_EQ(profile::DriveState::kUnknown, report().state);
  EXPECT_EQ(0.0, report().velocity.value);
  const Instant begin = now_;
  Word word = silence();
  while (word != 0x0000) {
    ASSERT_LE(now_ - begin, seconds(1.1));
    ASSERT_EQ(0x047E, word);
    ASSERT_EQ(0, setpoint_);
    word = silence();
  }
  EXPECT_GE(now_ - begin, seconds(1.0));
  EXPECT_LE(now_ - begin, seconds(1.05));
  EXPECT_EQ(0x0000, cycle(0x8B31));
  for (int i = 0; i < 10; ++i) ASSERT_EQ(0x847E, cycle(0x8B31)) << i;
  EXPECT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
}

// The set it comes back with is the one that counts, also while it does not answer.
TEST_F(DriveTest, TakesTheSetOfADriveThatComesBackSoon) {
  run();
  fallSilent();
  EXPECT_EQ(0x047E, cycle(0x8B31));
  EXPECT_EQ(0x847E, cycle(0x8B31));
}

TEST_F(DriveTest, CarriesTheQuickStopIntoTheDark) {
  run();
  drive_.requestQuickStop(now_);
  fallSilent();
  EXPECT_EQ(0x047B, silence());
}

// A drive that was idle had its stop word long ago: it is only asked for its set.
TEST_F(DriveTest, AsksASilentIdleDriveOnlyForItsSet) {
  start();
  fallSilent();
  EXPECT_EQ(0x0000, silence());
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
}

// Idle is what we send, not what the motor does: on its way down it gets 047E, which a module's time-out does not trip.
TEST_F(DriveTest, CarriesTheIdleWordIntoTheDarkWhileItStillTurns) {
  cycle(0x8B37, 0x2000);  // found running in set 3
  ASSERT_EQ(Phase::kIdle, report().phase);
  EXPECT_EQ(0x847E, cycle(0x8A37, 0x1F00));
  fallSilent();
  const Instant begin = now_;
  while (silence() != 0x0000) ASSERT_LE(now_ - begin, seconds(1.1));
  EXPECT_GE(now_ - begin, seconds(0.9)) << "for shutdown_timeout";
  EXPECT_EQ(StopCause::kNone, report().stop_cause) << "it was not driven";
}

// A bus module under 24 V goes on exchanging zeros for an inverter that is off.
TEST_F(DriveTest, TakesAnAllZeroStatusWordForSilence) {
  run();
  const Instant begin = now_;
  while (report().online) {
    ASSERT_LE(now_ - begin, seconds(0.1));
    cycle(0x0000);
  }
  EXPECT_EQ(StopCause::kSilent, report().stop_cause);
}

// Setpoint 0 keeps the torque on; velocities are not listened to any more.
TEST_F(DriveTest, HoldsZeroOnItsOwnRamp) {
  run();
  drive_.requestSetpointZero(now_);
  drive_.setVelocity({5.0});
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(0x047F, cycle(0x0B37, 0x1000)) << i;
    ASSERT_EQ(0, setpoint_);
  }
  drive_.requestShutdown(now_);
  EXPECT_EQ(0x047E, cycle(0x0B31));
}

// A stop during enabling is a stop: nothing half enabled is left behind.
TEST_F(DriveTest, StopsWhileEnabling) {
  start();
  drive_.requestEnable(now_);
  cycle(0x0B31);
  EXPECT_EQ(0x047F, cycle(0x0B33));
  drive_.requestSetpointZero(now_);
  EXPECT_EQ(0x047E, cycle(0x0B37));
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(Refusal::kStopped, report().refusal);
  EXPECT_EQ(Phase::kIdle, report().phase);
}

// A new enable clears the cause of the stop before.
TEST_F(DriveTest, EnablesAgainOnlyWhenAsked) {
  run();
  cycle(0x0B70);
  cycle(0x0B31);
  drive_.requestEnable(now_);
  EXPECT_EQ(StopCause::kNone, report().stop_cause);
  EXPECT_EQ(0x047E, cycle(0x0B31));
  EXPECT_EQ(0x047F, cycle(0x0B37));
  cycle(0x0B37);
  EXPECT_EQ(0, setpoint_);
}

}  // namespace
}  // namespace nord_driver::drive

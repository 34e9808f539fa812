#include "trace/trace_feed.h"
#include "trace/trace_fixture.h"

namespace nord_driver::trace {
namespace {

constexpr Word kRunning = 0x0B37, kFaulted = 0x0B38;

class TraceFeedTest : public TraceTest {};

// The fault bit asks for a trace when it rises, not while it stands.
TEST_F(TraceFeedTest, AFaultThatRisesAsksOnce) {
  cycle(0, kRunning, kRunning);
  EXPECT_FALSE(feed_.pollTrigger());
  cycle(10, kRunning, kFaulted);
  cycle(20, kRunning, kFaulted);
  const auto trigger = feed_.pollTrigger();
  ASSERT_TRUE(trigger);
  EXPECT_EQ(TraceTrigger::Kind::kFault, trigger->kind);
  EXPECT_EQ(1u, trigger->drive);
  EXPECT_EQ(1u, trigger->cycle);
  EXPECT_EQ(at(10), trigger->time);
  EXPECT_EQ(kFaulted, trigger->status_word);
  EXPECT_FALSE(feed_.pollTrigger());
}

// A drive that falls silent with its fault and comes back with it has no new one; one that was acknowledged has.
TEST_F(TraceFeedTest, ADriveThatWasAwayKeepsItsFault) {
  cycle(0, kFaulted, kRunning);
  ASSERT_TRUE(feed_.pollTrigger());
  cycle(10, 0, kRunning);
  cycle(20, kFaulted, kRunning);
  EXPECT_FALSE(feed_.pollTrigger());
  cycle(30, kRunning, kRunning);
  cycle(40, kFaulted, kRunning);
  EXPECT_TRUE(feed_.pollTrigger());
}

// The base that stops by itself asks; the user's quick stop does not.
TEST_F(TraceFeedTest, TheBaseAsksWhenItStopsByItself) {
  snapshot_.base.stop_cause = drive::StopCause::kQuickStop;
  cycle(0, kRunning, kRunning);
  EXPECT_FALSE(feed_.pollTrigger());
  snapshot_.base.stop_cause = drive::StopCause::kNone;
  cycle(10, kRunning, kRunning);
  snapshot_.base.stop_cause = drive::StopCause::kSilent;
  snapshot_.base.text = "drive left stopped: the drive fell silent";
  cycle(20, 0, kRunning);
  cycle(30, 0, kRunning);
  const auto trigger = feed_.pollTrigger();
  ASSERT_TRUE(trigger);
  EXPECT_EQ(TraceTrigger::Kind::kStop, trigger->kind);
  EXPECT_EQ(cycle::kAllDrives, trigger->drive);
  EXPECT_EQ("drive left stopped: the drive fell silent", trigger->text.str());
  EXPECT_FALSE(feed_.pollTrigger());
}

// So does a drive, of a base or not.
TEST_F(TraceFeedTest, ADriveAsksWhenItStopsByItself) {
  snapshot_.drives[0].stop_cause = drive::StopCause::kLocalControl;
  cycle(0, kRunning, kRunning);
  const auto trigger = feed_.pollTrigger();
  ASSERT_TRUE(trigger);
  EXPECT_EQ(TraceTrigger::Kind::kStop, trigger->kind);
  EXPECT_EQ(0u, trigger->drive);
}

// With `stop/command_timeout` every end of the commands is a stop: their traces would push those of faults out.
TEST_F(TraceFeedTest, CommandsThatEndAskForNoTrace) {
  snapshot_.base.stop_cause = snapshot_.drives[0].stop_cause = drive::StopCause::kCommandTimeout;
  cycle(0, kRunning, kRunning);
  EXPECT_FALSE(feed_.pollTrigger());
}

// The stop of commands that ended stays the cause: a machine that does not come to rest then is worth a trace.
class OnTheWayDown : public TraceTest {
 protected:
  OnTheWayDown() {
    drive_.stop_cause = drive::StopCause::kCommandTimeout;
    told(true, profile::DriveState::kOperationEnabled, 0x047E);
    cycle(0, kRunning, kRunning);
  }

  void told(bool online, profile::DriveState state, Word sent) {
    drive_.online = online;
    drive_.state = state;
    drive_.output.control_word = sent;
  }
  bool asks(Word status) {
    cycle(10, status, kRunning);
    const auto trigger = feed_.pollTrigger();
    cycle(20, status, kRunning);
    EXPECT_FALSE(feed_.pollTrigger()) << "twice";
    return trigger && trigger->kind == TraceTrigger::Kind::kStop && trigger->drive == 0;
  }

  cycle::DriveSnapshot& drive_ = snapshot_.drives[0];
};

TEST_F(OnTheWayDown, ItsEndAsksForNone) {
  told(true, profile::DriveState::kReadyToSwitchOn, 0x047E);
  EXPECT_FALSE(asks(0x0331));
}

TEST_F(OnTheWayDown, ADriveThatFallsSilentAsks) {
  told(false, profile::DriveState::kUnknown, 0x047E);
  EXPECT_TRUE(asks(0));
}

TEST_F(OnTheWayDown, ADriveThatIsTakenOverAsks) {
  EXPECT_TRUE(asks(0x0137));
}

TEST_F(OnTheWayDown, AnOff1ThatBecomesAnOff3Asks) {
  told(true, profile::DriveState::kQuickStopActive, 0x047B);
  EXPECT_TRUE(asks(0x0317));
}

TEST_F(OnTheWayDown, Off2AtTheTerminalsAsks) {
  told(true, profile::DriveState::kSwitchOnDisabled, 0x047E);
  EXPECT_TRUE(asks(0x0340));
}

TEST_F(OnTheWayDown, AQuickStopThatIsTheStopAsksForNone) {
  told(true, profile::DriveState::kQuickStopActive, 0x047B);
  cycle(10, 0x0317, kRunning);
  static_cast<void>(feed_.pollTrigger());
  told(true, profile::DriveState::kSwitchOnDisabled, 0x047B);
  EXPECT_FALSE(asks(0x0340));
}

}  // namespace
}  // namespace nord_driver::trace

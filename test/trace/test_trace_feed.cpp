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

}  // namespace
}  // namespace nord_driver::trace

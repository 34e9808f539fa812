// Node guarding (CiA 301 7.2.8.3.2.1) and boot-ups that repeat, each by itself with the time as a variable.
#include <gtest/gtest.h>

#include "canopen/boot_up_watch.h"
#include "canopen/node_guard.h"
#include "support/can_text.h"

namespace nord_driver::canopen {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

/// Guard time 200 ms, life time factor 3, node 5.
struct Guarding : testing::Test {
  std::string question() {
    CanFrame frame;
    return guard.pollTransmit(frame) ? text(frame) : "";
  }
  /// True when a question stayed without an answer.
  bool after(milliseconds span) {
    now += span;
    return guard.poll(now);
  }

  NodeTimers timers;
  NodeGuard guard{5, milliseconds{200}, 3, timers};
  Instant now{std::chrono::hours{1}};
};

TEST_F(Guarding, AsksAtOnceAndOncePerGuardTime) {
  EXPECT_FALSE(guard.running());
  EXPECT_EQ("", question());
  guard.start(true, now);
  EXPECT_TRUE(guard.running());
  EXPECT_EQ("705#R1", question());
  EXPECT_EQ("", question());
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x05, now));
  EXPECT_FALSE(after(milliseconds{100})) << "it looks for the answer in between";
  EXPECT_FALSE(after(milliseconds{99}));
  EXPECT_EQ("", question());
  EXPECT_FALSE(after(milliseconds{1}));
  EXPECT_EQ("705#R1", question());
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x85, now));
  EXPECT_FALSE(guard.expired());
}

// A question without an answer is put again after half a guard time, whichever toggle bit comes then.
TEST_F(Guarding, AsksAgainAfterHalfAGuardTime) {
  guard.start(true, now);
  ASSERT_EQ("705#R1", question());
  EXPECT_FALSE(after(milliseconds{99}));
  EXPECT_TRUE(after(milliseconds{1}));
  EXPECT_EQ("705#R1", question());
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x85, now));
  EXPECT_EQ(GuardAnswer::kNotAsked, guard.handle(0x05, now)) << "one question, one answer";
}

// A node toggles in its answers to another master as well, whether the question or only the answer is seen.
TEST_F(Guarding, AnotherMastersQuestionLeavesTheToggleBitUnknown) {
  for (const bool is_seen : {true, false}) {
    guard.start(true, now);
    question();
    EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x05, now));
    if (is_seen) {
      guard.handleForeignQuestion();
    } else {
      EXPECT_EQ(GuardAnswer::kNotAsked, guard.handle(0x85, now));
    }
    after(milliseconds{100});
    after(milliseconds{100});
    ASSERT_EQ("705#R1", question());
    EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x05, now));
  }
}

// 600 ms without a good answer, not a moment earlier; a good one begins them anew.
TEST_F(Guarding, TheLifeTimeIsTheProduct) {
  guard.start(true, now);
  question();
  after(milliseconds{599});
  EXPECT_FALSE(guard.expired());
  after(milliseconds{1});
  EXPECT_TRUE(guard.expired());

  question();
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x05, now));
  EXPECT_FALSE(guard.expired());
  after(milliseconds{599});
  EXPECT_FALSE(guard.expired());
  after(milliseconds{1});
  EXPECT_TRUE(guard.expired());
}

// The toggle bit begins with 0 after a reset; of a node that was not reset the first answer tells it.
TEST_F(Guarding, TogglesFromItsResetOn) {
  guard.start(true, now);
  question();
  EXPECT_EQ(GuardAnswer::kWrongToggle, guard.handle(0x85, now));
  guard.start(false, now);
  EXPECT_EQ(GuardAnswer::kNotAsked, guard.handle(0x85, now)) << "what was asked before the start is over";
  question();
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x85, now));
  guard.start(false, now);
  question();
  EXPECT_EQ(GuardAnswer::kAccepted, guard.handle(0x85, now)) << "what was known before the start is not any more";
}

TEST_F(Guarding, IsOverWhenItIsStopped) {
  guard.start(true, now);
  question();
  after(milliseconds{600});
  ASSERT_TRUE(guard.expired());
  guard.stop();
  EXPECT_FALSE(guard.running());
  EXPECT_FALSE(guard.expired());
  EXPECT_EQ("", question());
  EXPECT_FALSE(timers.nextTimeout());
  EXPECT_EQ(GuardAnswer::kNotAsked, guard.handle(0x05, now));
  EXPECT_FALSE(after(seconds{1}));
  EXPECT_FALSE(guard.expired());
  guard.start(true, now);
  EXPECT_FALSE(guard.expired());
}

TEST_F(Guarding, AQuestionThatWasNotSentIsNotMissed) {
  guard.start(true, now);
  question();
  guard.notSent();
  EXPECT_FALSE(after(milliseconds{100}));
  EXPECT_EQ("705#R1", question());
}

// Four boot-ups, one closely after the other: the fourth is one too many. A device that is switched off and on now and
// then may do so as often as it likes.
TEST(BootUpWatch, CountsWhatBelongsTogether) {
  Instant now{std::chrono::hours{1}};
  BootUpWatch often;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(often.handleBootUp(now += milliseconds{1999})) << i;
  EXPECT_TRUE(often.handleBootUp(now += milliseconds{1999}));
  EXPECT_TRUE(often.handleBootUp(now += milliseconds{1}));
  EXPECT_FALSE(often.handleBootUp(now += seconds{2})) << "it was quiet meanwhile";
  BootUpWatch seldom;
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(seldom.handleBootUp(now += minutes{1})) << i;
}

}  // namespace
}  // namespace nord_driver::canopen

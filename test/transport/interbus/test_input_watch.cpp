// What the newest inputs of a gateway are worth, by their number, their age and the state of the ring.
#include <gtest/gtest.h>

#include "transport/interbus/input_watch.h"

namespace nord_driver {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

class InputWatchTest : public ::testing::Test {
 protected:
  InputWatchTest() { watch.setTimeout(milliseconds{50}); }
  /// New inputs that were asked for `age` ago.
  void come(Duration age = milliseconds{2}, bool ring_runs = true) {
    ++inputs.number;
    inputs.asked = now - age;
    inputs.received = now;
    inputs.bus_runs = ring_runs;
    watch.handle(inputs, now);
  }
  void pass(Duration time) {
    now += time;
    watch.handle(inputs, now);
  }

  InputWatch watch;
  link::RegisterInputs inputs;
  Instant now{std::chrono::hours{1}};
};

TEST_F(InputWatchTest, NothingHasComeYet) {
  watch.handle(inputs, now);
  EXPECT_EQ(InputWorth::kNone, watch.worth());
  EXPECT_FALSE(watch.isFresh());
  EXPECT_EQ(Interruption::kNone, watch.interruption());
  EXPECT_EQ(Duration::zero(), watch.age());
}

TEST_F(InputWatchTest, InputsAreFreshOnce) {
  come();
  EXPECT_TRUE(watch.isGood());
  EXPECT_TRUE(watch.isFresh());
  pass(milliseconds{10});
  EXPECT_TRUE(watch.isGood());
  EXPECT_FALSE(watch.isFresh()) << "those of the cycle before";
  come();
  EXPECT_TRUE(watch.isFresh());
}

// To the microsecond, and from the question on: 2 ms of the time-out are over when they come.
TEST_F(InputWatchTest, TheTimeOutCountsFromTheQuestion) {
  come(milliseconds{2});
  pass(milliseconds{48});
  EXPECT_TRUE(watch.isGood());
  EXPECT_EQ(Interruption::kNone, watch.interruption());
  pass(microseconds{1});
  EXPECT_EQ(InputWorth::kOld, watch.worth());
  EXPECT_EQ(microseconds{50'001}, watch.age());
  EXPECT_EQ(Interruption::kSilent, watch.interruption());
  pass(milliseconds{10});
  EXPECT_EQ(Interruption::kNone, watch.interruption()) << "said once";
}

// They tell how the drives were when the question was put.
TEST_F(InputWatchTest, LateAnswersAreNotFresh) {
  come(milliseconds{51});
  EXPECT_EQ(InputWorth::kOld, watch.worth());
  EXPECT_FALSE(watch.isFresh());
  EXPECT_EQ(Interruption::kNone, watch.interruption()) << "there were no good ones before";
}

TEST_F(InputWatchTest, ARingThatStandsEndsItAtOnce) {
  come();
  now += milliseconds{10};
  come(milliseconds{2}, false);
  EXPECT_EQ(InputWorth::kRingStands, watch.worth());
  EXPECT_FALSE(watch.isFresh());
  EXPECT_EQ(Interruption::kUnasked, watch.interruption());
  now += milliseconds{10};
  come(milliseconds{2}, false);
  EXPECT_EQ(Interruption::kNone, watch.interruption()) << "said once";
  come();
  EXPECT_TRUE(watch.isFresh());
  EXPECT_EQ(Interruption::kNone, watch.interruption());
}

TEST_F(InputWatchTest, AGatewayThatFallsSilentWhileTheRingStandsIsSilent) {
  come(milliseconds{2}, false);
  EXPECT_EQ(InputWorth::kRingStands, watch.worth());
  pass(milliseconds{60});
  EXPECT_EQ(InputWorth::kOld, watch.worth());
}

}  // namespace
}  // namespace nord_driver

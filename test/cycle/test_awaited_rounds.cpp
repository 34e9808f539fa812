// What decides motion and is not answered is awaited for some rounds of questions, and then no longer.
#include <gtest/gtest.h>

#include "cycle/device_reader.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;

/// Puts all questions of a round; P104 of the first set is the one that times out.
void runRound(DeviceReader& reader) {
  for (int questions = 0; questions < 500; ++questions) {
    const auto request = reader.pollRequest();
    if (!request) return;
    profile::ParameterResult result;
    const bool silent = request->number == 104 && request->parameter_set == 1;
    result.outcome = silent ? ParameterOutcome::kTimeout : ParameterOutcome::kDone;
    result.raw = 500;
    reader.handleResult(result);
  }
  FAIL() << "the device is asked for ever";
}

// So often again (DeviceReader::kAwaitedRounds), after the first time.
TEST(AwaitedRounds, ThreeMoreAfterTheFirst) {
  DeviceReader reader{profile::Series::kSk5xxe};
  runRound(reader);
  for (int again = 1; again <= 3; ++again) {
    EXPECT_TRUE(reader.missesMotion());
    EXPECT_FALSE(reader.motionKnown()) << "before question " << again << " of those again";
    reader.askMissingAgain();
    EXPECT_FALSE(reader.motionKnown()) << "it is under way";
    runRound(reader);
  }
  EXPECT_TRUE(reader.motionKnown());
}

/// All questions of a round have this outcome.
void runRound(DeviceReader& reader, const profile::ParameterResult& result) {
  for (int questions = 0; questions < 500 && reader.pollRequest(); ++questions) reader.handleResult(result);
}

// Whatever refuses for the moment, in words, is no channel that is dead: it may tell of P104 when it is asked again.
TEST(AwaitedRounds, AreThoseOfAChannelThatOnlyRefusesForTheMoment) {
  DeviceReader reader{profile::Series::kSk5xxe};
  profile::ParameterResult not_now;
  not_now.outcome = ParameterOutcome::kRefused;
  not_now.reason = profile::ParameterReason::kNotNow;
  runRound(reader, not_now);
  for (unsigned again = 0; again < DeviceReader::kAwaitedRounds; ++again) {
    EXPECT_FALSE(reader.motionKnown()) << again;
    ASSERT_TRUE(reader.missesMotion());
    reader.askMissingAgain();
    runRound(reader, not_now);
  }
  EXPECT_TRUE(reader.motionKnown());
}

// Nothing carries parameters there: nothing is awaited.
TEST(AwaitedRounds, AreNoneOfASilentChannel) {
  DeviceReader reader{profile::Series::kSk5xxe};
  runRound(reader, {});
  EXPECT_TRUE(reader.motionKnown());
}

}  // namespace
}  // namespace nord_driver::cycle

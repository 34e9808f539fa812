// What is read back after a write, and what that says of the write.
#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

#include "drive/fake_parameters.h"
#include "drive/parameter_notes.h"
#include "drive/parameter_session.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterAction;
using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;

class ParameterReadBack : public ::testing::Test {
 protected:
  void SetUp() override {
    ParameterRequest request;
    request.id = 7;
    request.action = ParameterAction::kWriteRam;
    request.number = 102;
    request.raw = -5;
    ASSERT_TRUE(session_.submit(request));
  }
  /// The next question, which has to be of this kind, is answered.
  void answer(ParameterAction asked, ParameterOutcome outcome, std::int32_t raw) {
    const auto request = session_.pollRequest();
    ASSERT_TRUE(request.has_value());
    ASSERT_EQ(asked, request->action);
    ParameterResult result;
    result.id = request->id;
    result.outcome = outcome;
    result.raw = raw;
    session_.handleResult(result);
  }

  ParameterSession session_;
};

// A channel of words hands a negative one on with its sign.
TEST_F(ParameterReadBack, IsTheNegativeWordWritten) {
  answer(ParameterAction::kRead, ParameterOutcome::kDone, 3);
  answer(ParameterAction::kWriteRam, ParameterOutcome::kDone, -5);
  answer(ParameterAction::kRead, ParameterOutcome::kDone, -5);
  const auto result = session_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kDone, result->outcome);
  EXPECT_EQ(-5, result->raw);
  EXPECT_STREQ("", result->note);
}

TEST_F(ParameterReadBack, CannotBeHad) {
  answer(ParameterAction::kRead, ParameterOutcome::kDone, 3);
  answer(ParameterAction::kWriteRam, ParameterOutcome::kDone, -5);
  answer(ParameterAction::kRead, ParameterOutcome::kTimeout, 0);
  const auto result = session_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kTimeout, result->outcome);
  EXPECT_STREQ(kNotReadBack, result->note);
}

/// What the inverter says to each question, in order; the session asks nothing else.
ParameterResult resultOf(ParameterSession& session, const ParameterRequest& request,
                         std::initializer_list<std::pair<const char*, ParameterResult>> answers) {
  EXPECT_TRUE(session.submit(request));
  for (const auto& [question, answer] : answers) {
    const auto asked = session.pollRequest();
    EXPECT_EQ(question, asked ? FakeParameters::record(*asked) : "nothing");
    if (asked) session.handleResult(answer);
  }
  EXPECT_FALSE(session.pollRequest().has_value());
  return session.pollResult().value_or(ParameterResult{});
}

ParameterResult done(std::int32_t raw) {
  ParameterResult result = FakeParameters::failure(ParameterOutcome::kDone);
  result.raw = raw;
  return result;
}

ParameterRequest write(ParameterAction action) {
  ParameterRequest request;
  request.action = action;
  request.number = 102;
  request.raw = 5;
  return request;
}

// Nobody knows where its values go: written, and said so.
TEST(WithoutP560, APersistentWriteIsCarriedOutAndSaysWhatIsNotKnown) {
  ParameterSession session;
  const ParameterResult missing = FakeParameters::refusal(ParameterReason::kNoSuchParameter);
  const ParameterResult result =
      resultOf(session, write(ParameterAction::kWritePersistent),
               {{"P102?", done(3)}, {"P560?", missing}, {"P102=5", done(5)}, {"P102?", done(5)}});
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_STREQ(kNoSwitch, result.note);
  EXPECT_EQ(1u, session.eepromWrites());
}

// Neither an order that spares the EEPROM nor P560: what was asked for cannot be had.
TEST(WithoutP560, AWriteToTheRamIsNotCarriedOut) {
  ParameterSession session;
  const ParameterResult unknown = FakeParameters::refusal(ParameterReason::kNotSupported);
  const ParameterResult missing = FakeParameters::refusal(ParameterReason::kNoSuchParameter);
  const ParameterResult result = resultOf(session, write(ParameterAction::kWriteRam),
                                          {{"P102?", done(3)}, {"P102~5", unknown}, {"P560?", missing}});
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_STREQ(kNothingSpares, result.note);
  EXPECT_EQ(0u, session.eepromWrites());
}

// What is refused has not reached the EEPROM; without an answer it may have.
TEST(EepromWrites, CountWhatMayHaveBeenCarriedOut) {
  for (const ParameterOutcome refused :
       {ParameterOutcome::kRefused, ParameterOutcome::kBusy, ParameterOutcome::kNoChannel}) {
    ParameterSession session;
    const ParameterResult result =
        resultOf(session, write(ParameterAction::kWritePersistent),
                 {{"P102?", done(3)}, {"P560?", done(1)}, {"P102=5", FakeParameters::failure(refused)}});
    EXPECT_EQ(refused, result.outcome);
    EXPECT_FALSE(result.eeprom_written);
    EXPECT_EQ(0u, session.eepromWrites());
  }
  ParameterSession session;
  const ParameterResult lost = FakeParameters::failure(ParameterOutcome::kTimeout);
  EXPECT_TRUE(resultOf(session, write(ParameterAction::kWritePersistent),
                       {{"P102?", done(3)}, {"P560?", done(1)}, {"P102=5", lost}})
                  .eeprom_written);
  EXPECT_EQ(1u, session.eepromWrites());
}

}  // namespace
}  // namespace nord_driver::drive

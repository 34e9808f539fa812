// P560, switched off for a write and put back: each way this can go wrong, question by question.
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

ParameterResult done(std::int32_t raw) {
  ParameterResult result = FakeParameters::failure(ParameterOutcome::kDone);
  result.raw = raw;
  return result;
}
const ParameterResult kLost = FakeParameters::failure(ParameterOutcome::kTimeout);
const ParameterResult kUnknownOrder = FakeParameters::refusal(ParameterReason::kNotSupported);

class EepromSwitchTest : public ::testing::Test {
 protected:
  using Answers = std::initializer_list<std::pair<const char*, ParameterResult>>;

  static ParameterRequest access(ParameterAction action, std::uint16_t number = 102, std::int32_t raw = 5) {
    ParameterRequest request;
    request.id = 7;
    request.action = action;
    request.number = number;
    request.raw = raw;
    return request;
  }
  /// What the session asks, in this order, and is answered.
  void answer(Answers answers) {
    for (const auto& [question, result] : answers) {
      const auto asked = session_.pollRequest();
      ASSERT_EQ(question, asked ? FakeParameters::record(*asked) : "nothing");
      session_.handleResult(result);
    }
  }
  /// A whole access: nothing is asked after these answers.
  ParameterResult resultOf(const ParameterRequest& request, Answers answers) {
    EXPECT_TRUE(session_.submit(request));
    answer(answers);
    EXPECT_FALSE(session_.pollRequest().has_value());
    return session_.pollResult().value_or(ParameterResult{});
  }
  /// A write to the RAM whose P560 = 0 cannot be put back.
  void owe() {
    resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)},
                                                  {"P102~5", kUnknownOrder},
                                                  {"P560?", done(1)},
                                                  {"P560=0", done(0)},
                                                  {"P560?", done(0)},
                                                  {"P102=5", done(5)},
                                                  {"P560=1", kLost},
                                                  {"P560=1", kLost}});
    ASSERT_TRUE(session_.owesEepromSwitch());
  }

  ParameterSession session_;
};

TEST_F(EepromSwitchTest, IsPutBackAtTheSecondTry) {
  const ParameterResult result = resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)},
                                                                               {"P102~5", kUnknownOrder},
                                                                               {"P560?", done(1)},
                                                                               {"P560=0", done(0)},
                                                                               {"P560?", done(0)},
                                                                               {"P102=5", done(5)},
                                                                               {"P560=1", kLost},
                                                                               {"P560=1", done(1)},
                                                                               {"P560?", done(1)},
                                                                               {"P102?", done(5)}});
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_STREQ(kToggled, result.note);
  EXPECT_FALSE(session_.owesEepromSwitch());
  EXPECT_EQ(3u, session_.eepromWrites()) << "the lost one may have been stored, too";
}

// P150 to P199 are a module's, which has no P560 (BU 0280 4.1.1: it stores them in an EEPROM of its own): switching the
// inverter's would spare nothing, and does not keep the module from saving.
TEST_F(EepromSwitchTest, OfTheInverterSaysNothingOfAModulesParameters) {
  const ParameterResult refused =
      resultOf(access(ParameterAction::kWriteRam, 151), {{"P151?", done(3)}, {"P151~5", kUnknownOrder}});
  EXPECT_EQ(ParameterOutcome::kRefused, refused.outcome);
  EXPECT_EQ(ParameterReason::kDriver, refused.reason);
  EXPECT_STREQ(kModuleSaves, refused.note);
  EXPECT_EQ(0u, session_.eepromWrites());
  EXPECT_EQ(ParameterOutcome::kDone,
            resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)}, {"P102~5", done(5)}, {"P102?", done(5)}})
                .outcome)
      << "the inverter has the order that the module has not";
  EXPECT_EQ(ParameterOutcome::kDone, resultOf(access(ParameterAction::kWritePersistent, 151),
                                              {{"P151?", done(3)}, {"P151=5", done(5)}, {"P151?", done(5)}})
                                         .outcome);
  EXPECT_EQ(1u, session_.eepromWrites());
}

// P506 is taken to have sets, and has none (PKW error 4): in the RAM by one set, it is by all.
TEST_F(EepromSwitchTest, AValueWithoutSetsIsSavedByWhicheverSetItIsAddressed) {
  const ParameterResult not_indexed = FakeParameters::refusal(ParameterReason::kNotIndexed);
  const auto bySet = [](ParameterAction action, std::uint8_t set) {
    ParameterRequest request = access(action, 506);
    request.shape = profile::ParameterShape::kPerSet;
    request.parameter_set = set;
    return request;
  };
  resultOf(bySet(ParameterAction::kWriteRam, 1),
           {{"P506?", done(3)}, {"P506~5", not_indexed}, {"P506~5", done(5)}, {"P506?", done(5)}});
  const Answers saved{
      {"P506?", done(5)}, {"P560?", done(1)}, {"P506=5", not_indexed}, {"P506=5", done(5)}, {"P506?", done(5)}};
  EXPECT_EQ(ParameterOutcome::kDone, resultOf(bySet(ParameterAction::kWritePersistent, 2), saved).outcome);
  EXPECT_STREQ(kSame, resultOf(bySet(ParameterAction::kWritePersistent, 3), {{"P506?", done(5)}}).note);
}

// The other way round as well: an inverter without that order.
TEST_F(EepromSwitchTest, IsNotUsedForAModuleBehindAnInverterThatNeedsIt) {
  owe();
  EXPECT_EQ(ParameterOutcome::kDone, resultOf(access(ParameterAction::kWriteRam, 151), {{"P560?", done(0)},
                                                                                        {"P560=1", done(1)},
                                                                                        {"P560?", done(1)},
                                                                                        {"P151?", done(3)},
                                                                                        {"P151~5", done(5)},
                                                                                        {"P151?", done(5)}})
                                         .outcome);
}

// Two tries, each looked at: what reads back 0 has not been put back.
TEST_F(EepromSwitchTest, ThatStaysZeroIsOwed) {
  const ParameterResult result = resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)},
                                                                               {"P102~5", kUnknownOrder},
                                                                               {"P560?", done(1)},
                                                                               {"P560=0", done(0)},
                                                                               {"P560?", done(0)},
                                                                               {"P102=5", done(5)},
                                                                               {"P560=1", done(1)},
                                                                               {"P560?", done(0)},
                                                                               {"P560=1", done(1)},
                                                                               {"P560?", done(0)}});
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_STREQ(kNotPutBack, result.note);
  EXPECT_TRUE(session_.owesEepromSwitch());
}

// The write has failed before: that is the answer, and P560 the note beside it.
TEST_F(EepromSwitchTest, OwedAfterARefusedWriteLeavesTheRefusalItsReason) {
  const ParameterResult result =
      resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)},
                                                    {"P102~5", kUnknownOrder},
                                                    {"P560?", done(1)},
                                                    {"P560=0", done(0)},
                                                    {"P560?", done(0)},
                                                    {"P102=5", FakeParameters::refusal(ParameterReason::kOutOfLimits)},
                                                    {"P560=1", kLost},
                                                    {"P560=1", kLost}});
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kOutOfLimits, result.reason);
  EXPECT_EQ(102, result.refused_number);
  EXPECT_STREQ(kNotPutBack, result.note);
}

// Taken by the inverter, and read back as 1: the value would have gone into the EEPROM.
TEST_F(EepromSwitchTest, ThatDoesNotBecomeZeroKeepsTheValueFromBeingWritten) {
  const ParameterResult result = resultOf(access(ParameterAction::kWriteRam), {{"P102?", done(3)},
                                                                               {"P102~5", kUnknownOrder},
                                                                               {"P560?", done(1)},
                                                                               {"P560=0", done(0)},
                                                                               {"P560?", done(1)},
                                                                               {"P560=1", done(1)},
                                                                               {"P560?", done(1)}});
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_STREQ(kNotSet, result.note);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

TEST_F(EepromSwitchTest, ThatCannotBeReadKeepsTheValueFromBeingWritten) {
  const ParameterResult result =
      resultOf(access(ParameterAction::kWritePersistent), {{"P102?", done(3)}, {"P560?", kLost}});
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_STREQ(kSwitchUnread, result.note);
  EXPECT_EQ(0u, session_.eepromWrites());
}

TEST_F(EepromSwitchTest, IsItselfWrittenPersistentlyOnly) {
  const ParameterResult result =
      resultOf(access(ParameterAction::kWriteRam, 560, 0), {{"P560?", done(1)}, {"P560~0", kUnknownOrder}});
  EXPECT_EQ(ParameterOutcome::kRefused, result.outcome);
  EXPECT_EQ(ParameterReason::kDriver, result.reason);
  EXPECT_STREQ(kSwitchItself, result.note);
}

// Somebody else has put it back meanwhile: nothing is written for that.
TEST_F(EepromSwitchTest, OwedAndFoundPutBackIsOwedNoMore) {
  owe();
  EXPECT_EQ(9, resultOf(access(ParameterAction::kRead, 105), {{"P560?", done(1)}, {"P105?", done(9)}}).raw);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

// The look before the task had no answer, the one for the task has: it stands at 1.
TEST_F(EepromSwitchTest, OwedAndFoundPutBackByTheWriteItselfIsOwedNoMore) {
  owe();
  const std::uint64_t before = session_.eepromWrites();
  const ParameterResult result = resultOf(
      access(ParameterAction::kWritePersistent, 105, 700),
      {{"P560?", kLost}, {"P105?", done(500)}, {"P560?", done(1)}, {"P105=700", done(700)}, {"P105?", done(700)}});
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_TRUE(result.eeprom_written);
  EXPECT_EQ(before + 1, session_.eepromWrites());
  EXPECT_FALSE(session_.owesEepromSwitch());
}

// A user who writes it decides over it: it is put back no more.
TEST_F(EepromSwitchTest, OwedAndWrittenByAUserIsTheUsers) {
  owe();
  const ParameterResult result =
      resultOf(access(ParameterAction::kWritePersistent, 560, 1),
               {{"P560?", kLost}, {"P560?", done(0)}, {"P560=1", done(1)}, {"P560?", done(1)}});
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

// Not by a write that may not have arrived: the session still puts it back to 1, as it owes.
TEST_F(EepromSwitchTest, OwedAndAUsersOneIsLostIsPutBackAllTheSame) {
  owe();
  const std::uint64_t before = session_.eepromWrites();
  const ParameterResult result =
      resultOf(access(ParameterAction::kWritePersistent, 560, 1),
               {{"P560?", kLost}, {"P560?", done(0)}, {"P560=1", kLost}, {"P560=1", done(1)}, {"P560?", done(1)}});
  EXPECT_EQ(ParameterOutcome::kTimeout, result.outcome);
  EXPECT_FALSE(session_.owesEepromSwitch());
  EXPECT_EQ(before + 2, session_.eepromWrites());
}

TEST_F(EepromSwitchTest, OwedAndAUsersOneIsRefusedIsStillOwed) {
  owe();
  const ParameterResult busy = FakeParameters::failure(ParameterOutcome::kBusy);
  resultOf(access(ParameterAction::kWritePersistent, 560, 1),
           {{"P560?", kLost}, {"P560?", done(0)}, {"P560=1", busy}, {"P560=1", busy}, {"P560=1", busy}});
  EXPECT_TRUE(session_.owesEepromSwitch());
}

// To look at it is not to decide over it.
TEST_F(EepromSwitchTest, OwedAndReadByAUserIsStillOwed) {
  owe();
  EXPECT_EQ(0, resultOf(access(ParameterAction::kRead, 560), {{"P560?", kLost}, {"P560?", done(0)}}).raw);
  EXPECT_TRUE(session_.owesEepromSwitch());
}

// A user's 0 stays, whether it was there already or its answer is missing.
TEST_F(EepromSwitchTest, OwedAndAUsersZeroStays) {
  owe();
  EXPECT_STREQ(
      kSame, resultOf(access(ParameterAction::kWritePersistent, 560, 0), {{"P560?", kLost}, {"P560?", done(0)}}).note);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

TEST_F(EepromSwitchTest, AUsersZeroWhoseAnswerIsMissingIsNotUndone) {
  owe();
  session_.handleOffline();
  ASSERT_TRUE(session_.submit(access(ParameterAction::kWritePersistent, 560, 0)));
  answer({{"P560?", kLost}, {"P560?", done(1)}});
  ASSERT_TRUE(session_.pollRequest().has_value());
  session_.handleOffline();
  EXPECT_STREQ(kWriteUnanswered, session_.pollResult().value().note);
  EXPECT_FALSE(session_.owesEepromSwitch());
}

// Of a plain write as of one that spares the EEPROM: a parameter that has no sets here is written without one.
TEST_F(EepromSwitchTest, APlainWriteIsRetriedWithoutASet) {
  ParameterRequest request = access(ParameterAction::kWritePersistent);
  request.shape = profile::ParameterShape::kPerSet;
  request.parameter_set = 3;
  ASSERT_TRUE(session_.submit(request));
  answer({{"P102?", done(3)}, {"P560?", done(1)}});
  EXPECT_EQ(profile::ParameterShape::kPerSet, session_.pollRequest()->shape);
  session_.handleResult(FakeParameters::refusal(ParameterReason::kNotIndexed));
  EXPECT_EQ(profile::ParameterShape::kPlain, session_.pollRequest()->shape);
  session_.handleResult(done(5));
  answer({{"P102?", done(5)}});
  EXPECT_EQ(ParameterOutcome::kDone, session_.pollResult().value().outcome);
}

// An array has its elements: "not indexed" is the answer.
TEST_F(EepromSwitchTest, AnElementIsNotRetriedWithoutItsIndex) {
  ParameterRequest request = access(ParameterAction::kWriteRam, 613, 70'000);
  request.shape = profile::ParameterShape::kArray;
  request.index = 3;
  request.double_word = true;
  ASSERT_TRUE(session_.submit(request));
  answer({{"P613?", done(3)}});
  const auto write = session_.pollRequest();
  EXPECT_EQ(3, write->index);
  EXPECT_TRUE(write->double_word);
  EXPECT_EQ(70'000, write->raw);
  session_.handleResult(FakeParameters::refusal(ParameterReason::kNotIndexed));
  EXPECT_EQ(ParameterReason::kNotIndexed, session_.pollResult().value().reason);
  EXPECT_FALSE(session_.pollRequest().has_value());
}

// --- the inverter goes -----------------------------------------------------------------------------------------------

// The write was out: whether the value stands in the RAM nobody knows, so that "the same" is no reason to save nothing.
TEST_F(EepromSwitchTest, ARamWriteThatWasOutMayHaveBeenCarriedOut) {
  ASSERT_TRUE(session_.submit(access(ParameterAction::kWriteRam)));
  answer({{"P102?", done(3)}});
  ASSERT_TRUE(session_.pollRequest().has_value());
  session_.handleOffline();
  EXPECT_STREQ(kWriteUnanswered, session_.pollResult().value().note);
  const ParameterResult result =
      resultOf(access(ParameterAction::kWritePersistent),
               {{"P102?", done(5)}, {"P560?", done(1)}, {"P102=5", done(5)}, {"P102?", done(5)}});
  EXPECT_TRUE(result.eeprom_written);
}

TEST_F(EepromSwitchTest, AReadThatWasOutHasPutNothingAnywhere) {
  ASSERT_TRUE(session_.submit(access(ParameterAction::kWriteRam)));
  ASSERT_TRUE(session_.pollRequest().has_value());
  session_.handleOffline();
  EXPECT_STREQ("", session_.pollResult().value().note) << "nothing was to be written yet";
  EXPECT_STREQ(kSame, resultOf(access(ParameterAction::kWritePersistent), {{"P102?", done(5)}}).note);
}

TEST_F(EepromSwitchTest, APersistentWriteThatWasOutIsNotKnown) {
  ASSERT_TRUE(session_.submit(access(ParameterAction::kWritePersistent)));
  answer({{"P102?", done(3)}, {"P560?", done(1)}});
  ASSERT_TRUE(session_.pollRequest().has_value());
  session_.handleOffline();
  const ParameterResult result = session_.pollResult().value();
  EXPECT_STREQ(kWriteUnanswered, result.note);
  EXPECT_EQ(0, result.refused_number);
}

// Another inverter may come back, which knows the order that spares the EEPROM.
TEST_F(EepromSwitchTest, WhatAnInverterDoesNotKnowIsForgottenWithIt) {
  owe();
  session_.handleOffline();
  const ParameterResult result =
      resultOf(access(ParameterAction::kWriteRam),
               {{"P560?", done(1)}, {"P102?", done(3)}, {"P102~5", done(5)}, {"P102?", done(5)}});
  EXPECT_EQ(ParameterOutcome::kDone, result.outcome);
}

}  // namespace
}  // namespace nord_driver::drive

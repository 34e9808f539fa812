// Parameters as records of eight bytes: written as an order, read as its answer.
#include <gtest/gtest.h>

#include "transport/profibus/a_record_channel.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

// P151 of the module: slot 0, index 100 (BU 0220 4.2.1); order label 1, PNU 1151 = 47Fh; 200 ms = 00C8h.
TEST_F(Records, ReadsAParameterOfTheModule) {
  ASSERT_TRUE(submit(151));
  expectWrite("14 7F 00 00 00 00 00 00");
  EXPECT_EQ(0, last_.slot);
  EXPECT_EQ(100, last_.index);
  EXPECT_FALSE(channel_.pollRecord(now_)) << "one at a time";
  answer(RecordOutcome::kDone);
  expectRead();
  EXPECT_EQ(100, last_.index);
  answer(RecordOutcome::kDone, "14 7F 00 00 00 00 00 C8");
  const auto read = result();
  EXPECT_EQ(7u, read.id);
  EXPECT_EQ(ParameterOutcome::kDone, read.outcome);
  EXPECT_EQ(200, read.raw);
  EXPECT_FALSE(next());
  EXPECT_FALSE(channel_.holdsStation());
}

// The order is written once: an answer that is still the one before is read again, nothing is executed twice.
TEST_F(Records, ReadsAgainUntilTheAnswerIsTheOneToTheOrder) {
  ASSERT_TRUE(submit(151));
  expectWrite("14 7F 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  for (const char* other : {"00 00 00 00 00 00 00 00", "14 7E 00 00 00 00 00 01", ""}) {
    expectRead();
    answer(RecordOutcome::kDone, other);
    EXPECT_TRUE(channel_.holdsStation());
  }
  expectRead();
  answer(RecordOutcome::kDone, "14 7F 00 00 00 00 00 C8");
  EXPECT_EQ(200, result().raw);
}

// The same question twice is two orders. Until the unit has executed the second it repeats its answer to the first
// (BU 2700 6.5.1.1), and nobody could tell the two apart.
TEST_F(Records, AnEqualOrderIsWrittenAnewBehindATakenBackAnswer) {
  ASSERT_TRUE(submit(173, 1));
  ASSERT_TRUE(submit(173, 2));
  expectWrite("14 95 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "14 95 00 00 00 00 02 02");
  EXPECT_EQ(0x0202, result().raw);
  expectTakenBack("14 95 00 00 00 00 02 02");
  expectWrite("14 95 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "14 95 00 00 00 00 03 02");
  const auto second = result();
  EXPECT_EQ(2u, second.id);
  EXPECT_EQ(0x0302, second.raw);
  EXPECT_FALSE(next());
  EXPECT_FALSE(channel_.holdsStation());
}

// However much later it is asked for.
TEST_F(Records, AnEqualOrderNeedsItAfterAPauseToo) {
  ASSERT_TRUE(submit(173, 1));
  expectWrite("14 95 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "14 95 00 00 00 00 02 02");
  EXPECT_EQ(0x0202, result().raw);
  EXPECT_FALSE(next());
  ASSERT_TRUE(submit(173, 2));
  expectTakenBack();
  expectWrite("14 95 00 00 00 00 00 00");
}

// Another parameter, and another element of the same one: no answer fits both, and no telegram is spent.
TEST_F(Records, OtherOrdersAreWrittenAtOnce) {
  ASSERT_TRUE(submitElement(701, 1));
  ASSERT_TRUE(submitElement(701, 2));
  ASSERT_TRUE(submit(151));
  expectWrite("66 A5 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "46 A5 00 00 00 00 00 05");
  EXPECT_EQ(5, result().raw);
  expectWrite("66 A5 01 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "46 A5 01 00 00 00 00 06");
  EXPECT_EQ(6, result().raw);
  expectWrite("14 7F 00 00 00 00 00 00");
}

// P700 is an array from firmware V1.9 on (BU 0020 8): error 4, and it is read as a plain parameter. The error stands until
// the unit has executed that, and would be the answer to it: 76 A4 fits any order for P700.
TEST_F(Records, AnErrorIsNotTheAnswerToTheNextOrderForItsParameter) {
  ASSERT_TRUE(submitElement(700, 1));
  expectWrite("66 A4 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "76 A4 00 00 00 00 00 04");
  expectTakenBack("76 A4 00 00 00 00 00 04");
  expectWrite("16 A4 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "16 A4 00 00 00 00 00 66");
  const auto read = result();
  EXPECT_EQ(ParameterOutcome::kDone, read.outcome);
  EXPECT_EQ(0x66, read.raw);
}

// Its answer may come still, and is older than the question.
TEST_F(Records, AnOrderThatWasGivenUpIsTakenBackBeforeItsEqual) {
  ASSERT_TRUE(submit(173, 1));
  expectWrite("14 95 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  now_ += std::chrono::seconds{2};
  answer(RecordOutcome::kDone, kNone);
  EXPECT_FALSE(next());
  EXPECT_EQ(ParameterOutcome::kTimeout, result().outcome);
  ASSERT_TRUE(submit(173, 2));
  expectTakenBack("14 95 00 00 00 00 02 02");
  expectWrite("14 95 00 00 00 00 00 00");
}

// One whose answer does not go is told, not believed.
TEST_F(Records, AnAnswerThatIsNotTakenBackIsATimeout) {
  ASSERT_TRUE(submit(173, 1));
  ASSERT_TRUE(submit(173, 2));
  expectWrite("14 95 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "14 95 00 00 00 00 02 02");
  EXPECT_EQ(0x0202, result().raw);
  expectWrite(kNone);
  answer(RecordOutcome::kDone);
  int reads = 0;
  for (int i = 0; i < 300; ++i, now_ += milliseconds{10}) {
    const auto request = channel_.pollRecord(now_);
    if (!request) continue;
    EXPECT_FALSE(request->write);
    last_ = *request;
    ++reads;
    answer(RecordOutcome::kDone, "14 95 00 00 00 00 02 02");
  }
  EXPECT_GT(reads, 10);
  const auto timed_out = result();
  EXPECT_EQ(ParameterOutcome::kTimeout, timed_out.outcome);
  EXPECT_NE(std::string::npos, timed_out.text.str().find("the answer to the order before is repeated"));
  EXPECT_FALSE(channel_.holdsStation());
}

// The module's own refusal, PKW error 2: beyond the limits.
TEST_F(Records, PassesARefusalOn) {
  ASSERT_TRUE(submit(151));
  expectWrite("14 7F 00 00 00 00 00 00");
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "74 7F 00 00 00 00 00 02");
  const auto refused = result();
  EXPECT_EQ(ParameterOutcome::kRefused, refused.outcome);
  EXPECT_EQ(profile::ParameterReason::kOutOfLimits, refused.reason);
  EXPECT_EQ(profile::pkwErrorText(2).str(), refused.text.str());
}

// DF 80 B0: the record itself is refused; told with the code of DP-V1.
TEST_F(Records, TellsWhenTheRecordIsRefused) {
  ASSERT_TRUE(submit(151));
  expectWrite("14 7F 00 00 00 00 00 00");
  answer(RecordOutcome::kRefused, "", 0xB0);
  const auto refused = result();
  EXPECT_EQ(ParameterOutcome::kRefused, refused.outcome);
  EXPECT_EQ("DP-V1 error B0, invalid index (80 B0 00)", refused.text.str());
}

// The order was taken, and its answer cannot be read: what became of it nobody knows. Of a read nothing can have become.
TEST_F(Records, OfAWriteWhoseAnswerIsRefusedNobodyKnows) {
  for (const RecordOutcome outcome :
       {RecordOutcome::kRefused, RecordOutcome::kNotActivated, RecordOutcome::kNotSupported}) {
    for (const bool writes : {true, false}) {
      RecordParameterChannel channel{RecordParameterChannel::kModule, {}, milliseconds{1000}};
      profile::ParameterRequest request;
      request.id = 7;
      request.number = 151;
      request.shape = profile::ParameterShape::kArray;
      request.index = 1;
      request.action = writes ? profile::ParameterAction::kWritePersistent : profile::ParameterAction::kRead;
      request.raw = 200;
      ASSERT_TRUE(channel.submit(request, now_));
      const auto polled = [&] {
        auto record = channel.pollRecord(now_);
        for (int i = 0; i < 5 && !record; ++i) record = channel.pollRecord(now_ += milliseconds{10});
        return record;
      };
      const auto order = polled();
      ASSERT_TRUE(order && order->write);
      RecordResult taken;
      taken.write = true;
      taken.outcome = RecordOutcome::kDone;
      channel.handleRecord(taken, now_);
      const auto read = polled();
      ASSERT_TRUE(read && !read->write);
      RecordResult refused;
      refused.outcome = outcome;
      refused.error = {0x80, 0xA2, 0};
      channel.handleRecord(refused, now_);
      const auto result = channel.pollResult();
      ASSERT_TRUE(result);
      EXPECT_EQ(writes, result->outcome == ParameterOutcome::kTimeout);
      EXPECT_FALSE(result->text.empty());
    }
  }
}

// DF 80 B5: busy. Nothing was taken, so it is written again; not for ever.
TEST_F(Records, ABusyModuleIsAskedAgainUntilTheTimeIsOver) {
  ASSERT_TRUE(submit(151));
  int written = 0;
  for (int i = 0; i < 300; ++i, now_ += milliseconds{10}) {
    if (const auto request = channel_.pollRecord(now_)) {
      EXPECT_TRUE(request->write);
      last_ = *request;
      ++written;
      answer(RecordOutcome::kRefused, "", 0xB5);
    }
  }
  EXPECT_GT(written, 10);
  EXPECT_EQ(ParameterOutcome::kTimeout, result().outcome);
  EXPECT_FALSE(channel_.holdsStation());
}

struct Ending {
  RecordOutcome record;
  ParameterOutcome parameter;
};
class RecordEndings : public Records, public ::testing::WithParamInterface<Ending> {};

TEST_P(RecordEndings, BecomeTheOutcomeOfTheParameter) {
  ASSERT_TRUE(submit(151));
  expectWrite("14 7F 00 00 00 00 00 00");
  answer(GetParam().record);
  EXPECT_EQ(GetParam().parameter, result().outcome);
  EXPECT_FALSE(next());
  EXPECT_FALSE(channel_.holdsStation());
}

INSTANTIATE_TEST_SUITE_P(All, RecordEndings,
                         ::testing::Values(Ending{RecordOutcome::kTimedOut, ParameterOutcome::kTimeout},
                                           Ending{RecordOutcome::kNoAnswer, ParameterOutcome::kTimeout},
                                           Ending{RecordOutcome::kNotSupported, ParameterOutcome::kNoChannel},
                                           Ending{RecordOutcome::kNotActivated, ParameterOutcome::kNoChannel},
                                           Ending{RecordOutcome::kOffline, ParameterOutcome::kOffline}));

// The drive went while its record was under way: the late result belongs to nobody.
TEST_F(Records, ALateResultIsNotTheNextOnes) {
  ASSERT_TRUE(submit(151, 1));
  expectWrite("14 7F 00 00 00 00 00 00");
  channel_.handleOffline(now_);
  EXPECT_EQ(ParameterOutcome::kOffline, result().outcome);
  ASSERT_TRUE(submit(173, 2));
  EXPECT_FALSE(next()) << "the station's one record is still under way";
  answer(RecordOutcome::kDone);
  expectWrite("14 95 00 00 00 00 00 00");
}

// Inverter 3 by BU 2700 6.5, and numbers as they are (BU 0220 5 speaks of cyclic access only): P508 = 1FCh.
TEST_F(Records, AddressingAndNumbersCanBeSwitched) {
  RecordAddressing addressing;
  addressing.by_slot = true;
  addressing.number_offset = false;
  channel_ = RecordParameterChannel{3, addressing, std::chrono::seconds{2}};
  ASSERT_TRUE(submit(508));
  expectWrite("11 FC 00 00 00 00 00 00");
  EXPECT_EQ(4, last_.slot);
  EXPECT_EQ(103, last_.index);
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "11 FC 00 00 00 00 00 08");
  EXPECT_EQ(8, result().raw);
}

}  // namespace
}  // namespace nord_driver

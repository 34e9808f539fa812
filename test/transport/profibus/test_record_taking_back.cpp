// A unit that takes "no order", and has another way to say that there is no answer any more than eight zeros.
#include "transport/profibus/a_record_channel.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

class TakingBack : public Records {
 protected:
  /// P173 has been read, and is asked for again.
  void begin() {
    channel_ = RecordParameterChannel{RecordParameterChannel::kModule, addressing_, std::chrono::seconds{2}};
    ASSERT_TRUE(submit(173, 1));
    ASSERT_TRUE(submit(173, 2));
    expectAnswer(1, "02 02", 0x0202);
    began_ = now_;
  }
  /// The order goes out and is answered.
  void expectAnswer(std::uint32_t id, const std::string& value, std::int32_t raw) {
    const std::string order = addressing_.number_offset ? "14 95" : "10 AD";
    expectWrite(order + " 00 00 00 00 00 00");
    answer(RecordOutcome::kDone);
    expectRead();
    answer(RecordOutcome::kDone, order + " 00 00 00 00 " + value);
    const auto read = result();
    EXPECT_EQ(id, read.id);
    EXPECT_EQ(ParameterOutcome::kDone, read.outcome) << read.text.c_str();
    EXPECT_EQ(raw, read.raw);
  }
  void expectReadOfNone() {
    expectWrite(kNone);
    answer(RecordOutcome::kDone);
    expectRead();
  }
  /// The second order, and a third one behind it: nothing is left of the first answer.
  void expectGoesOn() {
    EXPECT_FALSE(channel_.pollResult());
    expectAnswer(2, "03 02", 0x0302);
    EXPECT_LT(now_ - began_, std::chrono::seconds{2});
  }

  RecordAddressing addressing_;
  Instant began_{};
};

// No manual says that a unit takes "no order" in a record. One that refuses it is asked all the same.
TEST_F(TakingBack, AUnitThatRefusesItIsAskedAllTheSame) {
  begin();
  expectWrite(kNone);
  answer(RecordOutcome::kRefused, "", 0xB7);
  expectGoesOn();
}

// An inverter that is not there (101), and an error 9, of no parameter: the answer to "no order".
TEST_F(TakingBack, AnErrorOfNoParameterIsNoAnswer) {
  for (const char* none : {"70 00 00 00 00 00 00 65", "70 00 00 00 00 00 00 09"}) {
    begin();
    expectReadOfNone();
    answer(RecordOutcome::kDone, none);
    expectGoesOn();
  }
}

// Read error, invalid range, read constraint conflict: there is nothing to read, and what is not shown is not mistaken.
TEST_F(TakingBack, ARefusedReadIsNoAnswer) {
  for (const int code : {0xA0, 0xB7, 0xC0}) {
    begin();
    expectReadOfNone();
    answer(RecordOutcome::kRefused, "", static_cast<std::uint8_t>(code));
    expectGoesOn();
  }
}

// State conflict and resource busy, repeated by MS1 and MS2 until their time is over.
TEST_F(TakingBack, AReadThatStaysBusyIsNoAnswer) {
  for (const int code : {0xB5, 0xC2}) {
    begin();
    expectReadOfNone();
    now_ += std::chrono::seconds{1};
    answer(RecordOutcome::kTimedOut, "", static_cast<std::uint8_t>(code));
    expectGoesOn();
  }
}

// Longer than the order may take: this one fails, and says why; it is written at once when it is asked for again.
TEST_F(TakingBack, AReadThatIsBusyForTooLongLeavesNothingBehind) {
  begin();
  expectReadOfNone();
  now_ += std::chrono::seconds{2};
  answer(RecordOutcome::kTimedOut, "", 0xB5);
  EXPECT_FALSE(next());
  const auto failed = result();
  EXPECT_EQ(ParameterOutcome::kTimeout, failed.outcome);
  EXPECT_EQ("DP-V1 error B5, state conflict, or busy (80 B5 00)", failed.text.str());
  ASSERT_TRUE(submit(173, 3));
  expectAnswer(3, "03 02", 0x0302);
}

// A read that nobody has answered says nothing of what the unit has to say.
TEST_F(TakingBack, AReadWithoutAnAnswerIsATimeout) {
  begin();
  expectReadOfNone();
  answer(RecordOutcome::kTimedOut);
  EXPECT_EQ(ParameterOutcome::kTimeout, result().outcome);
  ASSERT_TRUE(submit(173, 3));
  expectWrite(kNone);
}

// Busy is asked again at first, and for a second; half of the time is left to the order.
TEST_F(TakingBack, AWriteThatStaysBusyIsGivenUp) {
  begin();
  int busy = 0;
  for (;; ++busy, now_ += milliseconds{10}) {
    const auto request = next();
    ASSERT_TRUE(request && request->write);
    last_ = *request;
    if (toHex(request->data) != kNone) break;
    ASSERT_LT(busy, 300);
    answer(RecordOutcome::kRefused, "", 0xC2);
  }
  EXPECT_GT(busy, 10);
  EXPECT_GE(now_ - began_, std::chrono::seconds{1});
  answer(RecordOutcome::kDone);
  expectRead();
  answer(RecordOutcome::kDone, "14 95 00 00 00 00 03 02");
  EXPECT_EQ(0x0302, result().raw);
  EXPECT_LT(now_ - began_, std::chrono::seconds{2});
}

// "A READ without a WRITE before it" (BU 2700 6.5.1.1; BU 0220 8.3.4.4), with the number of the last order.
TEST_F(TakingBack, AReadWithoutAnOrderIsNoAnswer) {
  begin();
  expectReadOfNone();
  answer(RecordOutcome::kDone, "74 95 00 00 00 00 00 09");
  expectGoesOn();
}

TEST_F(TakingBack, AReadWithoutAnOrderIsNoAnswerInPlainNumbersEither) {
  addressing_.number_offset = false;
  begin();
  expectReadOfNone();
  answer(RecordOutcome::kDone, "70 AD 00 00 00 00 00 09");
  expectGoesOn();
}

// The same error was the answer to the order before: it is repeated, as far as anybody can tell. Another error is one.
TEST_F(TakingBack, AnErrorThatMayBeTheLastAnswerIsReadAgain) {
  for (const bool offset : {true, false}) {
    addressing_.number_offset = offset;
    channel_ = RecordParameterChannel{RecordParameterChannel::kModule, addressing_, std::chrono::seconds{2}};
    const std::string number = offset ? "4 95" : "0 AD";
    ASSERT_TRUE(submit(173, 1));
    ASSERT_TRUE(submit(173, 2));
    expectWrite("1" + number + " 00 00 00 00 00 00");
    answer(RecordOutcome::kDone);
    expectRead();
    answer(RecordOutcome::kDone, "7" + number + " 00 00 00 00 00 09");
    EXPECT_EQ(ParameterOutcome::kRefused, result().outcome);
    expectReadOfNone();
    for (const char* error : {"09", "02"}) {
      answer(RecordOutcome::kDone, "7" + number + " 00 00 00 00 00 " + error);
      expectRead();
    }
    answer(RecordOutcome::kDone, kNone);
    expectWrite("1" + number + " 00 00 00 00 00 00");
  }
}

}  // namespace
}  // namespace nord_driver

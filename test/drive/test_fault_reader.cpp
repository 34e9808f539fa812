// Which fault an inverter has, read when its fault bit rises.
#include <gtest/gtest.h>

#include "drive/fake_parameters.h"
#include "drive/fault_reader.h"

namespace nord_driver::drive {
namespace {

using profile::ParameterOutcome;

class FaultReaderTest : public ::testing::Test {
 protected:
  void status(Word word) { reader_.handleStatus(profile::StatusWord(word)); }
  /// One cycle: the element of P700 that is asked for, 0 for none.
  int poll(Duration later = seconds(0.01)) {
    now_ += later;
    const auto request = reader_.pollRequest(now_);
    if (!request.has_value()) return 0;
    EXPECT_EQ(700, request->number);
    EXPECT_EQ(profile::ParameterShape::kArray, request->shape);
    EXPECT_EQ(profile::ParameterAction::kRead, request->action);
    return request->index;
  }
  void answer(std::int32_t raw) {
    profile::ParameterResult result = FakeParameters::failure(ParameterOutcome::kDone);
    result.raw = raw;
    reader_.handleResult(result);
  }
  void fail(ParameterOutcome outcome = ParameterOutcome::kTimeout) {
    reader_.handleResult(FakeParameters::failure(outcome));
  }

  FaultReader reader_;
  Instant now_ = Instant{} + seconds(100.0);
};

TEST_F(FaultReaderTest, AsksNothingWithoutAFault) {
  status(0x0B31);
  EXPECT_EQ(0, poll());
  EXPECT_EQ(0, reader_.number());
  EXPECT_EQ(0, reader_.lastNumber());
}

// Unknown until read, then the number; after the fault has gone the number stays as the last one.
TEST_F(FaultReaderTest, ReadsTheNumberWhenTheBitRises) {
  status(0x0B31);
  status(0x0B38);
  EXPECT_EQ(65535, reader_.number());
  EXPECT_EQ(1, poll());
  EXPECT_EQ(0, poll());  // one at a time
  answer(102);
  EXPECT_EQ(102, reader_.number());
  EXPECT_EQ(0, poll(seconds(5.0)));  // once
  status(0x0B31);
  EXPECT_EQ(0, reader_.number());
  EXPECT_EQ(102, reader_.lastNumber());
}

TEST_F(FaultReaderTest, TriesAgainEverySecond) {
  status(0x0B38);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(1, poll()) << i;
    fail();
    EXPECT_EQ(65535, reader_.number());
    EXPECT_EQ(0, poll(seconds(0.9))) << i;
    now_ += seconds(0.1);
  }
  ASSERT_EQ(1, poll());
  answer(0);  // the fault bit is set, so this is no number
  EXPECT_EQ(65535, reader_.number());
  EXPECT_EQ(0, poll());
  EXPECT_EQ(1, poll(seconds(1.0)));
  answer(30);
  EXPECT_EQ(30, reader_.number());
}

// A second fault does not wait for the second that belongs to the first, and is not given the first one's number.
TEST_F(FaultReaderTest, KeepsTwoFaultsApart) {
  status(0x0B38);
  EXPECT_EQ(1, poll());
  status(0x0B31);
  status(0x0B38);
  answer(102);
  EXPECT_EQ(65535, reader_.number());
  EXPECT_EQ(65535, reader_.lastNumber());
  EXPECT_EQ(1, poll());
  answer(30);
  EXPECT_EQ(30, reader_.number());
}

// The answer that comes after the fault has gone is still the last fault's; without one, its number stays unknown.
TEST_F(FaultReaderTest, NamesAFaultThatVanishedBeforeItWasRead) {
  status(0x0B38);
  EXPECT_EQ(1, poll());
  status(0x0B31);
  EXPECT_EQ(65535, reader_.lastNumber());
  answer(102);
  EXPECT_EQ(0, reader_.number());
  EXPECT_EQ(102, reader_.lastNumber());
  status(0x0B38);
  EXPECT_EQ(1, poll());
  status(0x0B31);
  fail();
  EXPECT_EQ(65535, reader_.lastNumber());
}

TEST_F(FaultReaderTest, TellsWhetherANumberMayStillCome) {
  status(0x0B31);
  EXPECT_FALSE(reader_.awaitsNumber());
  status(0x0B38);
  EXPECT_TRUE(reader_.awaitsNumber());
  EXPECT_EQ(1, poll());
  status(0x0B31);
  EXPECT_TRUE(reader_.awaitsNumber()) << "the answer is under way";
  answer(0);
  EXPECT_FALSE(reader_.awaitsNumber());
  status(0x0B38);
  EXPECT_EQ(1, poll());
  answer(0);
  EXPECT_TRUE(reader_.awaitsNumber()) << "it is asked for again";
  status(0x0B31);
  EXPECT_FALSE(reader_.awaitsNumber());
  status(0x0B38);
  EXPECT_EQ(1, poll(seconds(1.0)));
  answer(102);
  EXPECT_FALSE(reader_.awaitsNumber());
}

TEST_F(FaultReaderTest, ReadsAnewWhatComesBackWithAFault) {
  status(0x0B38);
  EXPECT_EQ(1, poll());
  answer(102);
  reader_.handleOffline();
  EXPECT_EQ(102, reader_.number());
  EXPECT_EQ(0, poll());
  status(0x0B38);
  EXPECT_EQ(65535, reader_.number());
  EXPECT_EQ(1, poll());
  reader_.handleOffline();
  answer(30);  // late: belongs to nobody
  EXPECT_EQ(65535, reader_.number());
}

// Mains off and on takes a fault away without a status word that says so.
TEST_F(FaultReaderTest, ForgetsTheFaultOfAnInverterThatComesBackHealthy) {
  status(0x0B38);
  EXPECT_EQ(1, poll());
  answer(21);
  reader_.handleOffline();
  EXPECT_EQ(21, reader_.number()) << "the last one, until it says something else";
  status(0x0B31);
  EXPECT_EQ(0, reader_.number());
  EXPECT_EQ(21, reader_.lastNumber());
  EXPECT_EQ(0, poll(seconds(5.0)));
  status(0x0B38);  // this one is never read
  reader_.handleOffline();
  status(0x0B31);
  EXPECT_EQ(0, reader_.number());
  EXPECT_EQ(65535, reader_.lastNumber());
}

// P700 [-03], only when asked for, and not again where the firmware has none (before V1.9, BU 0020 8).
TEST_F(FaultReaderTest, ReadsTheReasonOnRequest) {
  status(0x0B70);
  EXPECT_EQ(0, poll());
  EXPECT_EQ(ReasonState::kNotAsked, reader_.reasonState());
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  EXPECT_EQ(ReasonState::kReading, reader_.reasonState());
  answer(7);
  EXPECT_EQ(ReasonState::kKnown, reader_.reasonState());
  EXPECT_EQ(7, reader_.reason());
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  fail();
  EXPECT_EQ(0, poll());
  EXPECT_EQ(3, poll(seconds(1.0)));
  fail(ParameterOutcome::kRefused);
  EXPECT_EQ(ReasonState::kNotAvailable, reader_.reasonState());
  reader_.requestReason();
  EXPECT_EQ(0, poll(seconds(5.0)));
  reader_.handleOffline();
  reader_.requestReason();
  EXPECT_EQ(3, poll());
}

// What it was of the last hold says nothing about the next one; nor does an answer that comes late.
TEST_F(FaultReaderTest, ForgetsTheReasonOfAHoldThatHasEnded) {
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  answer(7);
  reader_.forgetReason();
  EXPECT_EQ(ReasonState::kNotAsked, reader_.reasonState());
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  reader_.forgetReason();
  answer(7);
  EXPECT_EQ(ReasonState::kNotAsked, reader_.reasonState());
  EXPECT_EQ(0, poll(seconds(5.0)));
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  reader_.forgetReason();
  reader_.requestReason();
  answer(7);
  EXPECT_EQ(ReasonState::kReading, reader_.reasonState()) << "asked before the end of the last one";
  EXPECT_EQ(3, poll(seconds(1.0)));
  answer(8);
  EXPECT_EQ(ReasonState::kKnown, reader_.reasonState());
  EXPECT_EQ(8, reader_.reason());
}

TEST_F(FaultReaderTest, ThatThereIsNoReasonToReadStaysKnownUntilALoss) {
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  fail(ParameterOutcome::kNoChannel);
  reader_.forgetReason();
  EXPECT_EQ(ReasonState::kNotAvailable, reader_.reasonState());
  reader_.handleOffline();
  EXPECT_EQ(ReasonState::kNotAsked, reader_.reasonState());
}

TEST_F(FaultReaderTest, ForgetsTheReasonWithALoss) {
  reader_.requestReason();
  EXPECT_EQ(3, poll());
  answer(7);
  reader_.handleOffline();
  EXPECT_EQ(ReasonState::kNotAsked, reader_.reasonState());
}

// Another participant may block it for a moment: it has the element all the same.
TEST_F(FaultReaderTest, AsksAgainForAReasonThatWasRefusedForTheMoment) {
  using profile::ParameterReason;
  reader_.requestReason();
  for (const auto reason : {ParameterReason::kNotNow, ParameterReason::kNoInverter, ParameterReason::kDeviceFailure}) {
    EXPECT_EQ(3, poll(seconds(1.0)));
    reader_.handleResult(FakeParameters::refusal(reason));
    EXPECT_EQ(ReasonState::kReading, reader_.reasonState());
    EXPECT_EQ(0, poll(seconds(0.9)));
  }
  EXPECT_EQ(3, poll(seconds(1.0)));
  answer(7);
  EXPECT_EQ(7, reader_.reason());
}

// The fault comes first: the reason can wait.
TEST_F(FaultReaderTest, ReadsTheFaultBeforeTheReason) {
  reader_.requestReason();
  status(0x0B38);
  EXPECT_EQ(1, poll());
  answer(102);
  EXPECT_EQ(3, poll());
}

}  // namespace
}  // namespace nord_driver::drive

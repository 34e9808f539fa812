// What the inverter remembers of its faults (P701), read once when it has a new one.
#include <gtest/gtest.h>

#include "cycle/fault_history.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;
using profile::ParameterResult;

constexpr std::uint16_t kUnknown = 65535, kMotorHot = 21;

class FaultHistoryTest : public ::testing::Test {
 protected:
  /// The element that is asked for; 0: none.
  int poll() {
    const auto request = reader_.pollRequest();
    if (!request) return 0;
    EXPECT_EQ(701, request->number);
    EXPECT_EQ(profile::ParameterShape::kArray, request->shape);
    EXPECT_EQ(profile::ParameterAction::kRead, request->action);
    return request->index;
  }
  void answer(std::int32_t raw) {
    ParameterResult result;
    result.outcome = ParameterOutcome::kDone;
    result.raw = raw;
    reader_.handleResult(result);
  }
  void fail(ParameterOutcome outcome) {
    ParameterResult result;
    result.outcome = outcome;
    reader_.handleResult(result);
  }
  /// All five elements, the first of them `first`.
  void readAll(std::int32_t first) {
    for (int i = 1; i <= 5; ++i) {
      ASSERT_EQ(i, poll());
      EXPECT_FALSE(reader_.history().asked);
      answer(i == 1 ? first : 102);
    }
  }

  void handleFault(bool fault, std::uint16_t last_number, bool number_awaited = true) {
    reader_.handleFault(fault, last_number, number_awaited);
  }

  FaultHistoryReader reader_;
};

TEST_F(FaultHistoryTest, IsReadOnceWhenTheNumberIsKnown) {
  handleFault(false, 0);
  EXPECT_EQ(0, poll());
  handleFault(true, kUnknown);
  EXPECT_EQ(0, poll()) << "the inverter may not have filled it in yet";
  handleFault(true, kMotorHot);
  readAll(kMotorHot);
  EXPECT_TRUE(reader_.history().asked);
  ASSERT_EQ(5u, reader_.history().numbers.size());
  EXPECT_EQ(kMotorHot, reader_.history().numbers[0]);
  EXPECT_EQ(102, reader_.history().numbers[4]);
  handleFault(true, kMotorHot);
  handleFault(false, kMotorHot);
  EXPECT_EQ(0, poll());
  handleFault(true, kUnknown);
  EXPECT_FALSE(reader_.history().asked);
  EXPECT_TRUE(reader_.history().numbers.empty());
}

// The first idle word may take it away at once.
TEST_F(FaultHistoryTest, IsReadOfAFaultThatVanished) {
  handleFault(true, kUnknown);
  handleFault(false, kUnknown);
  EXPECT_EQ(0, poll());
  handleFault(false, kMotorHot);
  readAll(kMotorHot);
  EXPECT_TRUE(reader_.history().asked);
}

// The first idle word has taken it away, and P700 says "no fault" by now: its number stands in P701 only.
TEST_F(FaultHistoryTest, IsReadOfAFaultThatVanishedWithoutANumber) {
  handleFault(true, kUnknown, true);
  handleFault(false, kUnknown, true);
  EXPECT_EQ(0, poll()) << "the answer to P700 is under way";
  handleFault(false, kUnknown, false);
  readAll(102);
  EXPECT_TRUE(reader_.history().asked);
  handleFault(false, kUnknown, false);
  EXPECT_EQ(0, poll());
}

// 0 with the fault bit set: P700 is not filled in yet, and so may be P701.
TEST_F(FaultHistoryTest, IsNotReadWhileAFaultWithoutANumberStands) {
  handleFault(true, kUnknown, false);
  handleFault(true, kUnknown, true);
  EXPECT_EQ(0, poll());
}

TEST_F(FaultHistoryTest, EndsWhereTheInverterRefuses) {
  handleFault(true, kMotorHot);
  EXPECT_EQ(1, poll());
  answer(kMotorHot);
  EXPECT_EQ(2, poll());
  fail(ParameterOutcome::kRefused);
  EXPECT_EQ(0, poll());
  EXPECT_TRUE(reader_.history().asked);
  EXPECT_EQ(1u, reader_.history().numbers.size());
}

TEST_F(FaultHistoryTest, ATimeOutIsAskedForThreeTimes) {
  handleFault(true, kMotorHot);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(reader_.history().asked);
    EXPECT_EQ(1, poll());
    fail(ParameterOutcome::kTimeout);
  }
  EXPECT_EQ(0, poll());
  EXPECT_TRUE(reader_.history().asked);
}

TEST_F(FaultHistoryTest, WhatDidNotReachTheDriveIsAskedAgain) {
  handleFault(true, kMotorHot);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(1, poll());
    EXPECT_EQ(0, poll()) << "one at a time";
    fail(ParameterOutcome::kBusy);
  }
}

TEST_F(FaultHistoryTest, ADriveThatIsAwayIsNotAsked) {
  handleFault(true, kMotorHot);
  EXPECT_EQ(1, poll());
  reader_.handleOffline();
  answer(40);
  EXPECT_EQ(0, poll());
  EXPECT_TRUE(reader_.history().numbers.empty());
  handleFault(true, kMotorHot);
  EXPECT_EQ(1, poll()) << "it comes back with one";
}

// Three tries for each element, not for all of them.
TEST_F(FaultHistoryTest, EachElementIsAskedForThreeTimes) {
  handleFault(true, kMotorHot);
  for (int element = 1; element <= 5; ++element) {
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(element, poll());
      fail(ParameterOutcome::kTimeout);
    }
    EXPECT_EQ(element, poll());
    answer(100 + element);
  }
  ASSERT_EQ(5u, reader_.history().numbers.size());
  EXPECT_EQ(105, reader_.history().numbers[4]);
}

// 0 is no number of a fault, and an answer nobody waits for is none of P701.
TEST_F(FaultHistoryTest, NothingIsReadOfNoFault) {
  handleFault(true, 0);
  EXPECT_EQ(0, poll());
  handleFault(true, kMotorHot);
  answer(40);
  EXPECT_TRUE(reader_.history().numbers.empty());
  EXPECT_EQ(1, poll());
  fail(ParameterOutcome::kOffline);
  EXPECT_EQ(1, poll()) << "it did not reach the drive";
}

// What was asked for of the fault before may be answered late: it is nothing of this one, whose elements have their own tries.
TEST_F(FaultHistoryTest, OfANewFaultBeginsAnew) {
  handleFault(true, kMotorHot);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(1, poll());
    fail(ParameterOutcome::kTimeout);
  }
  EXPECT_EQ(1, poll());
  handleFault(false, kMotorHot);
  handleFault(true, kUnknown);
  answer(40);
  EXPECT_TRUE(reader_.history().numbers.empty());
  handleFault(true, kMotorHot);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(1, poll());
    fail(ParameterOutcome::kTimeout);
  }
  readAll(kMotorHot);
}

}  // namespace
}  // namespace nord_driver::cycle

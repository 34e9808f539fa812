// What was read of a drive counts no longer when it was lost, or when somebody writes what it means: another inverter may
// have taken its place, and 100 % may be another speed.
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "cycle/parameters_bench.h"

namespace nord_driver::cycle {
namespace {

using drive::Refusal;
using profile::ParameterOutcome;

class ParametersAfterLoss : public ::testing::Test, protected ParametersBench {
 protected:
  /// Within a cycle: it answers again, or still.
  void lose() { parameters.handleLoss(drive); }
  Refusal refusal() const { return drive.enableRefusal(); }
};

TEST_F(ParametersAfterLoss, TheScaleOfAllSetsIsForgotten) {
  run(80);
  for (std::uint8_t set = 1; set <= 4; ++set) ASSERT_TRUE(drive.maxFrequency(set)) << unsigned{set};
  lose();
  for (std::uint8_t set = 1; set <= 4; ++set) EXPECT_FALSE(drive.maxFrequency(set)) << unsigned{set};
}

TEST_F(ParametersAfterLoss, NothingIsEnabledAtOnce) {
  run(80);
  ASSERT_EQ(Refusal::kNone, refusal());
  lose();
  EXPECT_EQ(Refusal::kParametersAwaited, refusal());
  run(80);
  EXPECT_EQ(Refusal::kNone, refusal());
}

// What kept it from being enabled is told of the drive that had it alone.
TEST_F(ParametersAfterLoss, WhatKeptItFromBeingEnabledIsForgotten) {
  values[104] = 25;
  values[509] = 9;
  values[546] = 3;
  run(80);
  ASSERT_EQ(2.5, drive.report().minimum_frequency.value);
  ASSERT_TRUE(drive.report().unexpected_function);
  ASSERT_TRUE(drive.report().unexpected_source);
  lose();
  EXPECT_EQ(0.0, drive.report().minimum_frequency.value);
  EXPECT_FALSE(drive.report().unexpected_function);
  EXPECT_FALSE(drive.report().unexpected_source);
}

// The drive of before answered in the cycle before its connection was reset.
TEST_F(ParametersAfterLoss, AnAnswerOfBeforeIsNoScale) {
  run(10);
  ASSERT_TRUE(drive.maxFrequency(1));
  exchange();
  answer();
  lose();
  exchange();
  EXPECT_FALSE(drive.maxFrequency(1));
}

TEST_F(ParametersAfterLoss, WhoWaitsIsToldThatItDoesNotAnswer) {
  held = {102};
  run(80);
  cycle::Request read = test::writeRequest(kDrive, 102, 0);
  read.kind = RequestKind::kReadParameter;
  submit(read);
  run(3);
  ASSERT_TRUE(completions.empty());
  lose();
  const auto completion = parameters.pollCompletion();
  ASSERT_TRUE(completion);
  EXPECT_EQ(ParameterOutcome::kOffline, completion->parameter.outcome);
}

// More than could wait: none of them is told that too many do.
TEST_F(ParametersAfterLoss, WhileItIsAwayEachIsToldSo) {
  run(80);
  inverter.silent = true;
  run(20);
  for (int i = 0; i < 12; ++i) {
    submit(test::writeRequest(kDrive, 102, 250));
    const auto completion = parameters.pollCompletion();
    ASSERT_TRUE(completion);
    EXPECT_EQ(ParameterOutcome::kOffline, completion->parameter.outcome);
  }
}

TEST_F(ParametersAfterLoss, WhatItRemembersOfItsFaultIsAskedForAnew) {
  values[700] = 21;
  values[701] = 102;
  held = {701};
  run(80);
  inverter.fault = true;
  run(5);
  ASSERT_EQ(1, reads(701));
  lose();
  open.clear();
  held.clear();
  run(100);
  EXPECT_TRUE(parameters.faultHistory().asked);
  EXPECT_EQ(5u, parameters.faultHistory().numbers.size());
}

// Nobody goes where an element of the array of another drive is.
TEST_F(ParametersAfterLoss, AChosenElementIsNotChosenAnyMore) {
  run(80);
  parameters.askElement(5);
  lose();
  EXPECT_FALSE(parameters.elements().isAsked());
}

class WrittenScale : public ParametersAfterLoss {
 protected:
  static cycle::Request write() {
    cycle::Request request = test::writeRequest(kDrive, 105, 1000);
    request.parameter.parameter_set = 1;
    return request;
  }
};

// In the cycle of the request: what comes after it in the same cycle must not enable.
TEST_F(WrittenScale, CountsNoLongerFromTheRequestOn) {
  run(80);
  submit(write());
  EXPECT_FALSE(drive.maxFrequency(1));
  EXPECT_EQ(Refusal::kParametersAwaited, refusal());
}

TEST_F(WrittenScale, NorIsADriveEnabledWhoseMotionIsAboutToBeWritten) {
  run(80);
  submit(test::writeRequest(kDrive, 301, 1));
  EXPECT_TRUE(drive.maxFrequency(1));
  EXPECT_EQ(Refusal::kParametersAwaited, refusal());
}

// The reading goes on beside the write; what it learned of the drive before the write is no scale after it.
TEST_F(WrittenScale, IsTheOneReadAfterTheWrite) {
  run(10);
  ASSERT_EQ(50.0, drive.maxFrequency(1)->value);
  submit(write());
  bool answered = false;
  for (int i = 0; i < 10 && !answered; ++i) {
    held = {105};
    exchange();
    poll();
    answer();  // to the reading
    held.clear();
    answer();  // to the write
    answered = parameters.pollCompletion().has_value();
  }
  ASSERT_TRUE(answered);
  for (int i = 0; i < 3; ++i) {  // a transport that is full takes no question
    exchange();
    EXPECT_FALSE(drive.maxFrequency(1));
  }
  run(100);
  ASSERT_TRUE(drive.maxFrequency(1));
  EXPECT_EQ(100.0, drive.maxFrequency(1)->value);
  EXPECT_EQ(Refusal::kNone, refusal());
}

}  // namespace
}  // namespace nord_driver::cycle

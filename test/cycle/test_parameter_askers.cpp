// Who asks a drive for parameters: each has one question under way, gets its own answers, and asks again in time.
#include <gtest/gtest.h>

#include "cycle/parameter_requests.h"
#include "cycle/parameters_bench.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;

class ParameterAskers : public ::testing::Test, protected ParametersBench {
 protected:
  explicit ParameterAskers(const ParameterChannelUse& channel = {}) : ParametersBench{channel} {}

  static cycle::Request read(std::uint16_t number) {
    cycle::Request request = test::writeRequest(kDrive, number, 0);
    request.kind = RequestKind::kReadParameter;
    return request;
  }
  /// All that is read at start.
  void runUntilComplete() {
    for (int i = 0; i < 300 && !parameters.device().complete; ++i) step();
    ASSERT_TRUE(parameters.device().complete);
  }
};

// Wanted or not: nobody else has to be asked whose it is.
TEST_F(ParameterAskers, AResultIsThatOfItsDrive) {
  exchange();
  poll();
  ASSERT_FALSE(open.empty());
  Result result = resultOf(open.front());
  EXPECT_TRUE(parameters.handleResult(result));
  EXPECT_TRUE(parameters.handleResult(result)) << "not wanted any more";
  result.id += 1;
  EXPECT_FALSE(parameters.handleResult(result)) << "of another drive";
}

// The fault vanished and came again while the history of before was asked for.
TEST_F(ParameterAskers, HaveOneQuestionUnderWay) {
  values[700] = 21;
  values[701] = 102;
  held = {701};
  runUntilComplete();
  for (int i = 0; i < 3; ++i) {
    inverter.fault = true;
    run(5);
    inverter.fault = false;
    run(5);
  }
  EXPECT_EQ(1u, open.size());
  EXPECT_EQ(1, reads(701));
}

// The answer to an earlier choice, which comes late, is not what stands in the element chosen last. That is asked for
// behind it: choices many times in a second must not take the places of all other requests.
TEST_F(ParameterAskers, AskForTheElementThatWasChosenLast) {
  runUntilComplete();
  held = {613};
  parameters.askElement(5);
  step();
  ASSERT_EQ(1u, open.size());
  EXPECT_EQ(5, open[0].index);
  for (const std::uint8_t element : {std::uint8_t{7}, std::uint8_t{6}}) {
    parameters.askElement(element);
    step();
    ASSERT_EQ(1u, open.size()) << unsigned{element};
  }
  values[613] = 5000;
  EXPECT_TRUE(parameters.handleResult(resultOf(open[0])));
  EXPECT_FALSE(parameters.elements().poll());
  open.clear();
  step();
  ASSERT_EQ(1u, open.size());
  EXPECT_EQ(6, open[0].index);
  values[613] = 6000;
  EXPECT_TRUE(parameters.handleResult(resultOf(open[0])));
  const auto element = parameters.elements().poll();
  ASSERT_TRUE(element);
  EXPECT_EQ(6, element->element);
  EXPECT_EQ(6000, element->raw);
}

TEST_F(ParameterAskers, WhoIsOverdueIsAnsweredOnce) {
  runUntilComplete();
  held = {102};
  submit(read(102), std::chrono::milliseconds{50});
  run(20);
  ASSERT_EQ(1u, completions.size());
  EXPECT_EQ(ParameterOutcome::kTimeout, completions[0].parameter.outcome);
  held.clear();
  run(5);
  EXPECT_EQ(1u, completions.size());
}

// P510 timed out: it is asked for again two seconds later, three times, and so on.
TEST_F(ParameterAskers, AskForWhatIsMissingEveryTwoSeconds) {
  silent = {510};
  runUntilComplete();
  for (int round = 0; round < 3; ++round) {
    asked.clear();
    run(190);
    EXPECT_EQ(0, reads(510)) << "round " << round;
    for (int i = 0; i < 20 && reads(510) < 3; ++i) step();
    EXPECT_EQ(3, reads(510)) << "round " << round;
  }
}

// And what is refused for the moment once: the channel is there for others, too.
TEST_F(ParameterAskers, AskForWhatIsRefusedForTheMomentEveryTwoSeconds) {
  not_now = {510};
  runUntilComplete();
  asked.clear();
  run(1000);
  EXPECT_GE(reads(510), 4);
  EXPECT_LE(reads(510), 5);
}

// What was missing before a loss was missing of another drive.
TEST_F(ParameterAskers, WaitTwoSecondsAfterALossToo) {
  silent = {510};
  runUntilComplete();
  run(150);
  parameters.handleLoss(drive);
  step();
  ASSERT_FALSE(parameters.device().complete);
  runUntilComplete();
  asked.clear();
  run(190);
  EXPECT_EQ(0, reads(510));
}

class MonitoredPerSet : public ParameterAskers {
 protected:
  MonitoredPerSet() : ParameterAskers{monitoring()} {}
  static ParameterChannelUse monitoring() {
    ParameterChannelUse channel;
    Request limit;
    limit.number = 112;
    limit.shape = profile::ParameterShape::kPerSet;
    limit.parameter_set = 0;
    channel.monitor = {limit};
    return channel;
  }
};

TEST_F(MonitoredPerSet, IsReadOfTheSetInForce) {
  values[1112] = 100;
  values[2112] = 60;
  runUntilComplete();
  run(100);
  EXPECT_EQ(100, parameters.monitored().at(0).raw);
  drive.requestParameterSet(2, now);
  run(210);
  EXPECT_EQ(60, parameters.monitored().at(0).raw);
}

/// P560 is switched off for each write that is to spare the EEPROM.
class WithoutRamWrites : public ParameterAskers {
 protected:
  WithoutRamWrites() : ParameterAskers{plain()} {}
  static ParameterChannelUse plain() {
    ParameterChannelUse channel;
    channel.capabilities.ram_writes = false;
    return channel;
  }
};

// It is told whether the drive saves as it is now, not as it was while P560 was off for a write.
TEST_F(WithoutRamWrites, TheSwitchIsReadAgainWhenItWasPutBack) {
  step();
  submit(test::writeRequest(kDrive, 102, 250));
  for (int i = 0; i < 20 && values[560] != 0; ++i) step();
  ASSERT_EQ(0, values[560]);
  held = {102};
  run(100);
  ASSERT_EQ(false, parameters.device().saves_in_eeprom) << "as it met it";
  held.clear();
  runUntilComplete();
  run(10);
  ASSERT_EQ(1u, completions.size());
  EXPECT_TRUE(completions[0].success) << completions[0].message.c_str();
  EXPECT_EQ(1, values[560]);
  EXPECT_EQ(true, parameters.device().saves_in_eeprom);
  asked.clear();
  submit(read(102));
  run(10);
  EXPECT_EQ(1, reads(102));
  EXPECT_EQ(0, reads(560)) << "once";
}

class BehindAModule : public ParameterAskers {
 protected:
  BehindAModule() : ParameterAskers{behindModule()} {
    values[150] = 0;
    values[151] = 1000;
  }
  static ParameterChannelUse behindModule() {
    ParameterChannelUse channel;
    channel.timeout_owner = TimeoutOwner::kModule;
    return channel;
  }
};

// P151 is one for all drives behind it: who writes it for one has written it for each.
TEST_F(BehindAModule, AWriteOfItsTimeoutIsTold) {
  runUntilComplete();
  submit(test::writeRequest(kDrive, 513, 10));
  run(10);
  ASSERT_EQ(1u, completions.size());
  EXPECT_FALSE(parameters.takeModuleWrite());
  submit(read(151));
  run(10);
  EXPECT_FALSE(parameters.takeModuleWrite());
  submit(test::writeRequest(kDrive, 151, 500));
  run(10);
  ASSERT_EQ(3u, completions.size());
  EXPECT_TRUE(parameters.takeModuleWrite());
  EXPECT_FALSE(parameters.takeModuleWrite()) << "once";
}

TEST_F(BehindAModule, ItsTimeoutIsReadAgainWhenAnotherDriveHasWrittenIt) {
  runUntilComplete();
  asked.clear();
  values[151] = 500;
  parameters.readModuleAgain();
  run(5);
  EXPECT_EQ(1, reads(151));
  EXPECT_EQ(0.5, parameters.device().module_timeout);
}

// On a silent channel once, however long the answer is awaited; what is missing meanwhile waits for it, and has its three
// attempts for itself.
TEST_F(BehindAModule, ItsTimeoutIsAskedForOnceWhileNothingIsAnswered) {
  silent = {151, 510};
  runUntilComplete();
  asked.clear();
  for (int i = 0; i < 250 && reads(510) < 3; ++i) step();
  ASSERT_EQ(3, reads(510));
  run(2);
  held = {151};
  parameters.readModuleAgain();
  asked.clear();
  run(300);
  EXPECT_EQ(1u, open.size());
  EXPECT_EQ(0, reads(510));
  held.clear();
  run(30);
  EXPECT_EQ(1, reads(151));
  EXPECT_EQ(3, reads(510));
}

TEST_F(BehindAModule, WhatAUserReadsIsNotReadAgain) {
  runUntilComplete();
  asked.clear();
  for (const int number : {151, 513, 560}) {
    submit(read(static_cast<std::uint16_t>(number)));
    run(10);
    EXPECT_EQ(1, reads(number)) << number;
  }
}

// Only what the module has is that of the others, too; to read it changes nothing.
TEST_F(BehindAModule, HoldsTheOtherDrivesForAWriteOfItsOwnAlone) {
  runUntilComplete();
  held = {150, 301};
  submit(read(150));
  EXPECT_FALSE(parameters.writesForModule());
  submit(test::writeRequest(kDrive, 301, 1));
  EXPECT_FALSE(parameters.writesForModule());
  submit(test::writeRequest(kDrive, 150, 1));
  EXPECT_TRUE(parameters.writesForModule());
}

}  // namespace
}  // namespace nord_driver::cycle

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cycle/device_reader.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;

ParameterResult done(std::int32_t raw) {
  ParameterResult result;
  result.outcome = ParameterOutcome::kDone;
  result.raw = raw;
  return result;
}

ParameterResult failed(ParameterOutcome outcome) {
  ParameterResult result;
  result.outcome = outcome;
  return result;
}

/// More than there are parameters to read: said once, for a loop that would never end.
bool asksForEver(std::size_t requests) {
  constexpr std::size_t kFarTooMany = 500;
  if (requests <= kFarTooMany) return false;
  ADD_FAILURE() << "the device is asked for ever: " << requests << " requests";
  return true;
}

/// Answers all requests with one value and returns the numbers that were asked for.
std::vector<std::uint16_t> answerAll(DeviceReader& reader, std::int32_t raw) {
  std::vector<std::uint16_t> numbers;
  while (const auto request = reader.pollRequest()) {
    numbers.push_back(request->number);
    reader.handleResult(done(raw));
    if (asksForEver(numbers.size())) break;
  }
  return numbers;
}

TEST(DeviceReader, ReadsMaximumFrequencyOfAllSetsFirst) {
  DeviceReader reader{profile::Series::kSk5xxe};
  for (std::uint8_t set = 1; set <= 4; ++set) {
    const auto request = reader.pollRequest();
    ASSERT_TRUE(request);
    EXPECT_EQ(105, request->number);
    EXPECT_EQ(set, request->parameter_set);
    EXPECT_EQ(profile::ParameterAction::kRead, request->action);
    EXPECT_FALSE(reader.pollRequest()) << "one at a time";
    reader.handleResult(done(500 + set));  // 0.1 Hz steps
    EXPECT_DOUBLE_EQ(50.0 + 0.1 * set, *reader.data().max_frequency[set - 1u]);
  }
  EXPECT_FALSE(reader.data().complete);
}

// What did not reach the drive was not asked.
TEST(DeviceReader, PutsAQuestionAgainThatDidNotReachTheDrive) {
  DeviceReader reader{profile::Series::kSk5xxe};
  for (int i = 0; i < 10; ++i) {
    const auto request = reader.pollRequest();
    ASSERT_TRUE(request);
    EXPECT_EQ(105, request->number);
    EXPECT_EQ(1, request->parameter_set);
    reader.handleResult(failed(i % 2 == 0 ? ParameterOutcome::kBusy : ParameterOutcome::kOffline));
  }
}

TEST(DeviceReader, TellsWhenP105OfEverySetWasAskedFor) {
  DeviceReader reader{profile::Series::kSk5xxe};
  for (int set = 1; set <= 4; ++set) {
    EXPECT_FALSE(reader.maxFrequenciesAsked());
    ASSERT_TRUE(reader.pollRequest());
    reader.handleResult(failed(ParameterOutcome::kRefused));
  }
  EXPECT_TRUE(reader.maxFrequenciesAsked());
  reader.handleOffline();
  EXPECT_FALSE(reader.maxFrequenciesAsked());
}

TEST(DeviceReader, ReadsVersionTimeoutAndFunctions) {
  DeviceReader reader{profile::Series::kSk5xxe};
  const auto numbers = answerAll(reader, 1);
  EXPECT_TRUE(reader.data().complete);
  EXPECT_DOUBLE_EQ(0.1, *reader.data().telegram_timeout);
  EXPECT_EQ(1, *reader.data().software_version);
  EXPECT_TRUE(*reader.data().saves_in_eeprom);
  EXPECT_THAT(reader.data().word_functions[0].setpoints, ::testing::Each(1));
  EXPECT_THAT(reader.data().word_functions[0].actual_values, ::testing::Each(1));
  // On SK 5xxE the functions are three parameters each (BU 2700 6.4.4).
  for (const int number : {544, 545, 547, 548}) {
    EXPECT_EQ(1, std::count(numbers.begin(), numbers.end(), number)) << "P" << number;
  }
}

// What decides motion, of every set the driver may use, before all the rest.
TEST(DeviceReader, ReadsWhatDecidesMotionOfAllSetsFirst) {
  DeviceReader reader{profile::Series::kSk5xxe};
  std::vector<std::pair<int, int>> asked;
  while (!reader.motionAsked()) {
    const auto request = reader.pollRequest();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->number == 105, request->scales);
    asked.emplace_back(request->number, request->parameter_set);
    reader.handleResult(done(10 * request->parameter_set + (request->number == 543 ? 1 : 0)));
  }
  const std::vector<std::pair<int, int>> expected{
      {105, 1}, {105, 2}, {105, 3}, {105, 4}, {104, 1}, {104, 2}, {104, 3}, {104, 4}, {543, 1}, {543, 2}, {543, 3},
      {543, 4}, {546, 1}, {546, 2}, {546, 3}, {546, 4}, {600, 1}, {600, 2}, {600, 3}, {600, 4}, {509, 1}, {510, 1}};
  EXPECT_EQ(expected, asked);
  for (std::size_t set = 0; set < 4; ++set) {
    const double number = static_cast<double>(set) + 1.0;
    EXPECT_DOUBLE_EQ(number, reader.data().min_frequency[set].value_or(-1.0));
    EXPECT_EQ(10.0 * number + 1.0, reader.data().word_functions[set].actual_values[0]);
    EXPECT_EQ(10.0 * number, reader.data().word_functions[set].setpoints[0]);
    EXPECT_EQ(10.0 * number, reader.data().position_control[set]);
  }
  reader.handleOffline();
  EXPECT_FALSE(reader.motionAsked());
}

// P607 and P608 decide nothing: they come later, and one that is refused is left out.
TEST(DeviceReader, ReadsTheGearOfTheCountOfADriveThatPositions) {
  DeviceReader reader{profile::Series::kSk5xxe, TimeoutOwner::kInverter, true, true};
  bool before_motion = false;
  std::string controls;  // P600, by set
  while (const auto request = reader.pollRequest()) {
    before_motion = before_motion || (request->number == 607 && !reader.motionAsked());
    controls += request->number == 600 ? std::to_string(request->parameter_set) : "";
    const bool refused = request->number == 608 && request->parameter_set > 2;
    reader.handleResult(refused ? failed(ParameterOutcome::kRefused) : done(request->parameter_set));
  }
  EXPECT_FALSE(before_motion);
  EXPECT_EQ("1234", controls);
  EXPECT_TRUE(reader.data().complete);
  EXPECT_THAT(reader.data().speed_ratio, ::testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(reader.data().reduction, ::testing::ElementsAre(1, 2, std::nullopt, std::nullopt));
}

TEST(DeviceReader, ReadsNoGearOfTheCountOfOthers) {
  DeviceReader velocity{profile::Series::kSk5xxe, TimeoutOwner::kInverter, true, false};
  DeviceReader without{profile::Series::kSk700e, TimeoutOwner::kInverter, true, true};
  for (DeviceReader* reader : {&velocity, &without}) {
    const auto numbers = answerAll(*reader, 1);
    EXPECT_EQ(0, std::count(numbers.begin(), numbers.end(), 607));
    EXPECT_EQ(0, std::count(numbers.begin(), numbers.end(), 608));
  }
}

// SK 540E and above, 1x0E and 2xxE: [-01] of an array.
TEST(DeviceReader, ReadsTheFirstElementWhereTheyAreArrays) {
  for (const profile::Series series : {profile::Series::kSk54xe, profile::Series::kSk2xxe}) {
    DeviceReader reader{series};
    while (const auto request = reader.pollRequest()) {
      const bool function = request->number == 543 || request->number == 546;
      reader.handleResult(done(function ? 10 * request->index + request->parameter_set : 0));
    }
    for (std::size_t set = 0; set < 4; ++set) {
      EXPECT_EQ(11 + set, reader.data().word_functions[set].actual_values[0]);
      EXPECT_EQ(11 + set, reader.data().word_functions[set].setpoints[0]);
    }
    EXPECT_EQ(31, reader.data().word_functions[0].actual_values[2]);
  }
}

// BU 0020 6.1.1: eight on SK 300E and 7x0E, twelve on the others.
TEST(DeviceReader, ReadsTheFunctionsOfTheBusBits) {
  for (const auto& [series, count] : {std::pair{profile::Series::kSk300e, 8u}, {profile::Series::kSk2xxe, 12u}}) {
    DeviceReader reader{series};
    while (const auto request = reader.pollRequest()) {
      const bool refused = request->number == 480 && request->index == 2;
      reader.handleResult(refused ? failed(ParameterOutcome::kRefused) : done(request->index));
    }
    ASSERT_EQ(count, reader.data().bus_bit_functions.size());
    EXPECT_EQ(1, reader.data().bus_bit_functions[0]);
    EXPECT_EQ(kUnknownFunction, reader.data().bus_bit_functions[1]);
    EXPECT_EQ(3, reader.data().bus_bit_functions[2]);
  }
}

// Twenty-two questions of three attempts each would keep a drive with a typed P105 from being enabled for a minute.
TEST(DeviceReader, AsksADeadChannelOnceForEachOfTheOthers) {
  DeviceReader reader{profile::Series::kSk5xxe};
  int asked = 0;
  while (!reader.motionAsked()) {
    ASSERT_TRUE(reader.pollRequest());
    reader.handleResult(failed(ParameterOutcome::kTimeout));
    ++asked;
  }
  EXPECT_EQ(3 + 21, asked);
}

// The drive's ramps last: nothing waits for them. P103 comes in the steps of P102.
TEST(DeviceReader, ReadsTheRampsOfAllSetsLast) {
  DeviceReader reader{profile::Series::kSk5xxe};
  std::vector<std::uint16_t> numbers;
  while (const auto request = reader.pollRequest()) {
    numbers.push_back(request->number);
    reader.handleResult(done(request->number * 10 + request->parameter_set));
  }
  ASSERT_GE(numbers.size(), 10u);
  EXPECT_EQ((std::vector<std::uint16_t>{102, 103, 102, 103, 102, 103, 102, 103}),
            std::vector<std::uint16_t>(numbers.end() - 8, numbers.end()));
  EXPECT_EQ(5091, reader.data().control_word_source);
  EXPECT_EQ(5101, reader.data().setpoint_source);
  for (std::size_t set = 1; set <= 4; ++set) {
    EXPECT_DOUBLE_EQ(10.2 + 0.01 * static_cast<double>(set), reader.data().acceleration_time[set - 1].value());
    EXPECT_DOUBLE_EQ(10.3 + 0.01 * static_cast<double>(set), reader.data().deceleration_time[set - 1].value());
  }
}

// P513 = -0.1 (raw FFFFh): the inverter ignores all bus errors. Read unsigned it would look like a long time-out.
TEST(DeviceReader, ReadsTheTelegramTimeoutSigned) {
  DeviceReader reader{profile::Series::kSk5xxe};
  answerAll(reader, 0xFFFF);
  EXPECT_DOUBLE_EQ(-0.1, *reader.data().telegram_timeout);
}

TEST(DeviceReader, ATimeoutIsAskedForAgainARefusalIsLeftOut) {
  DeviceReader reader{profile::Series::kSk5xxe};
  reader.pollRequest();
  reader.handleResult(failed(ParameterOutcome::kTimeout));
  auto again = reader.pollRequest();
  ASSERT_TRUE(again);
  EXPECT_EQ(1, again->parameter_set);
  reader.handleResult(failed(ParameterOutcome::kRefused));
  auto next = reader.pollRequest();
  ASSERT_TRUE(next);
  EXPECT_EQ(2, next->parameter_set);
  EXPECT_FALSE(reader.data().max_frequency[0]);
  for (int i = 0; i < 3; ++i) {
    reader.handleResult(failed(ParameterOutcome::kTimeout));
    next = reader.pollRequest();
    ASSERT_TRUE(next);
  }
  EXPECT_EQ(3, next->parameter_set) << "three attempts, then the next one";
}

// Nothing can be driven without P105: the one that stayed away is asked for again when its owner wants to, alone.
TEST(DeviceReader, AMaximumFrequencyThatTimedOutCanBeAskedForAgain) {
  DeviceReader reader{profile::Series::kSk5xxe};
  EXPECT_FALSE(reader.missesMotion());
  std::size_t requests = 0;
  while (const auto request = reader.pollRequest()) {
    if (asksForEver(++requests)) break;
    if (request->number == 105 && request->parameter_set == 2) {
      reader.handleResult(failed(ParameterOutcome::kTimeout));
    } else if (request->number == 105 && request->parameter_set == 3) {
      reader.handleResult(failed(ParameterOutcome::kRefused));
    } else {
      reader.handleResult(done(500));
    }
  }
  EXPECT_TRUE(reader.data().complete);
  ASSERT_TRUE(reader.missesMotion());
  EXPECT_FALSE(reader.missesMotion(false));
  reader.askMissingAgain();
  EXPECT_TRUE(reader.maxFrequenciesAsked());
  const auto again = reader.pollRequest();
  ASSERT_TRUE(again);
  EXPECT_EQ(105, again->number);
  EXPECT_EQ(2, again->parameter_set);
  EXPECT_DOUBLE_EQ(50.0, *reader.data().max_frequency[0]) << "what was read stays";
  reader.handleResult(done(250));
  EXPECT_FALSE(reader.pollRequest());
  EXPECT_DOUBLE_EQ(25.0, *reader.data().max_frequency[1]);
  EXPECT_FALSE(reader.missesMotion());
}

// An inverter that is off for a moment, behind a module that lives: nobody has said that there is no P105.
TEST(DeviceReader, WhatIsRefusedForTheMomentCanBeAskedForAgain) {
  using Reason = profile::ParameterReason;
  for (const Reason reason : {Reason::kNoInverter, Reason::kDeviceFailure, Reason::kNotNow}) {
    DeviceReader reader{profile::Series::kSk5xxe};
    std::size_t requests = 0;
    while (const auto request = reader.pollRequest()) {
      if (asksForEver(++requests)) break;
      ParameterResult result = done(500);
      if (request->number == 105 && request->parameter_set == 2) {
        result = failed(ParameterOutcome::kRefused);
        result.reason = reason;
      }
      reader.handleResult(result);
    }
    ASSERT_TRUE(reader.missesMotion()) << profile::toString(reason);
    reader.askMissingAgain();
    const auto again = reader.pollRequest();
    ASSERT_TRUE(again);
    EXPECT_EQ(105, again->number);
    EXPECT_EQ(2, again->parameter_set);
    reader.handleResult(done(250));
    EXPECT_FALSE(reader.pollRequest());
    EXPECT_FALSE(reader.missesMotion());
  }
}

// Where P105 was typed in, another one could be a step of the speed; P104 and the functions are asked for all the same.
TEST(DeviceReader, ATypedMaximumFrequencyIsNotAskedForAgain) {
  DeviceReader reader{profile::Series::kSk5xxe};
  while (reader.pollRequest()) reader.handleResult(failed(ParameterOutcome::kTimeout));
  ASSERT_TRUE(reader.missesMotion(false));
  reader.askMissingAgain(false);
  for (int i = 0; i < 18; ++i) {
    const auto request = reader.pollRequest();
    ASSERT_TRUE(request);
    EXPECT_NE(105, request->number);
    reader.handleResult(done(1));
  }
  EXPECT_FALSE(reader.pollRequest());
  EXPECT_EQ(1, reader.data().word_functions[3].actual_values[0]);
}

TEST(DeviceReader, AMaximumFrequencyOfZeroIsNoScale) {
  DeviceReader reader{profile::Series::kSk5xxe};
  answerAll(reader, 0);
  EXPECT_FALSE(reader.data().max_frequency[0]);
  EXPECT_TRUE(reader.data().complete);
}

TEST(DeviceReader, BeginsAgainWhenTheDriveHasComeBack) {
  DeviceReader reader{profile::Series::kSk5xxe};
  answerAll(reader, 500);
  EXPECT_FALSE(reader.pollRequest());
  reader.handleOffline();
  EXPECT_TRUE(reader.data().max_frequency[0]) << "what was read is kept until the drive is back";
  const auto request = reader.pollRequest();
  ASSERT_TRUE(request);
  EXPECT_EQ(105, request->number);
  EXPECT_FALSE(reader.data().complete);
}

// Attempts of before do not count.
TEST(DeviceReader, BeginsAgainWithAllItsAttempts) {
  DeviceReader reader{profile::Series::kSk5xxe};
  const auto timesOut = [&reader] {
    reader.pollRequest();
    reader.handleResult(failed(ParameterOutcome::kTimeout));
  };
  timesOut();
  timesOut();
  reader.handleOffline();
  timesOut();
  timesOut();
  const auto third = reader.pollRequest();
  ASSERT_TRUE(third);
  EXPECT_EQ(1, third->parameter_set) << "the third attempt";
}

TEST(DeviceReader, AResultNobodyWaitsForChangesNothing) {
  DeviceReader reader{profile::Series::kSk5xxe};
  reader.pollRequest();
  reader.handleOffline();
  reader.handleResult(done(1));
  EXPECT_FALSE(reader.data().max_frequency[0]);
}

// A function the drive refuses leaves a gap: the later ones must not move up, or `current` would be another value.
TEST(DeviceReader, AFunctionThatIsRefusedKeepsItsPlace) {
  DeviceReader reader{profile::Series::kSk5xxe};
  std::size_t requests = 0;
  while (const auto request = reader.pollRequest()) {
    if (asksForEver(++requests)) break;
    if (request->number == 544 || request->number == 546) {
      reader.handleResult(failed(ParameterOutcome::kRefused));
    } else {
      reader.handleResult(done(request->number == 545 ? 3 : 1));
    }
  }
  EXPECT_EQ(1, reader.data().word_functions[0].actual_values[0]);
  EXPECT_EQ(kUnknownFunction, reader.data().word_functions[0].actual_values[1]);
  EXPECT_EQ(3, reader.data().word_functions[0].actual_values[2]) << "current stays actual value 3";
  EXPECT_EQ(kUnknownFunction, reader.data().word_functions[0].setpoints[0]);
  EXPECT_EQ(1, reader.data().word_functions[0].setpoints[1]);
}

// Behind a module SK CU4/TU4 its own time-out counts, and the inverter's watch over it (BU 2700 8.1).
TEST(DeviceReader, ReadsTheTimeoutsOfABusModule) {
  DeviceReader reader{profile::Series::kSk2xxe, TimeoutOwner::kModule};
  const auto numbers = answerAll(reader, 0xFFFF);
  EXPECT_EQ(1, std::count(numbers.begin(), numbers.end(), 151));
  EXPECT_DOUBLE_EQ(-0.001, *reader.data().module_timeout);
  EXPECT_EQ(0xFFFF, *reader.data().option_monitoring);
  DeviceReader without{profile::Series::kSk2xxe};
  answerAll(without, 1);
  EXPECT_FALSE(without.data().module_timeout);
  EXPECT_FALSE(without.data().option_monitoring);
}

}  // namespace
}  // namespace nord_driver::cycle

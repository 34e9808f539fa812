// Which parameters a device is asked for, each of them once, and where its answers go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <set>
#include <tuple>
#include <vector>

#include "cycle/device_reader.h"
#include "profile/cycle_parameters.h"
#include "profile/parameter_shape.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::Series;
using ::testing::ElementsAre;

constexpr Series kAllSeries[] = {Series::kSk5xxe, Series::kSk54xe, Series::kSk300e, Series::kSk700e,
                                 Series::kSk750e, Series::kSk1x0e, Series::kSk2xxe};

ParameterResult done(std::int32_t raw) {
  ParameterResult result;
  result.outcome = ParameterOutcome::kDone;
  result.raw = raw;
  return result;
}

ParameterResult timedOut() {
  ParameterResult result;
  result.outcome = ParameterOutcome::kTimeout;
  return result;
}

/// All that is asked for now, each answered by what `answer` makes of it.
template <typename Answer>
std::vector<ParameterRequest> askAll(DeviceReader& reader, Answer answer) {
  std::vector<ParameterRequest> asked;
  while (const auto request = reader.pollRequest()) {
    asked.push_back(*request);
    reader.handleResult(answer(*request));
    if (asked.size() < 500) continue;
    ADD_FAILURE() << "the device is asked for ever";
    break;
  }
  return asked;
}

std::vector<std::uint16_t> numbersOf(const std::vector<ParameterRequest>& requests) {
  std::vector<std::uint16_t> numbers;
  for (const ParameterRequest& request : requests) numbers.push_back(request.number);
  return numbers;
}

std::vector<ParameterRequest> askAll(DeviceReader& reader) {
  return askAll(reader, [](const ParameterRequest&) { return done(1); });
}

// An inverter refuses what it has not, and a question that is put twice costs the others their time. A bus carries three
// words at most, so that no function beyond the third is of use.
TEST(WhatIsRead, IsWhatTheInverterHasAndEachOnce) {
  for (const Series series : kAllSeries) {
    for (const bool further : {false, true}) {
      DeviceReader reader{series, TimeoutOwner::kModule, further, true, 1};
      std::set<std::tuple<int, int, int>> asked;
      for (const ParameterRequest& request : askAll(reader)) {
        const auto* const info = profile::findCycleParameter(request.number, series);
        ASSERT_NE(nullptr, info) << request.number;
        EXPECT_LE(request.index, info->elements) << request.number;
        const int set = profile::hasSets(request.shape) ? request.parameter_set : 0;
        EXPECT_TRUE(asked.insert({request.number, set, request.index}).second) << request.number << " is asked twice";
        const bool function = request.number >= 543 && request.number <= 548;
        EXPECT_LE(request.index, function ? 3 : 12) << request.number;
      }
    }
  }
}

// SK 1x0E and 300E have no POSICON (BU 2700 6.4.4, BU 0020 7.3.5); P610 decides nothing of a drive that is not to position.
TEST(WhatIsRead, IsThePositionControlOfEverySeriesThatMayHaveIt) {
  for (const Series series : kAllSeries) {
    DeviceReader reader{series};
    const std::vector<std::uint16_t> numbers = numbersOf(askAll(reader));
    const int sets = series == Series::kSk1x0e || series == Series::kSk300e ? 0 : 4;
    EXPECT_EQ(sets, std::count(numbers.begin(), numbers.end(), 600)) << profile::toString(series);
    EXPECT_EQ(0, std::count(numbers.begin(), numbers.end(), 610)) << profile::toString(series);
  }
}

// P120 [-01] is the watch over the first module, P510 [-01] the source of the main setpoint.
TEST(WhatIsRead, OfAnArrayIsItsFirstElement) {
  DeviceReader reader{Series::kSk54xe, TimeoutOwner::kModule};
  int found = 0;
  for (const ParameterRequest& request : askAll(reader)) {
    if (request.number != 120 && request.number != 510) continue;
    ++found;
    EXPECT_EQ(1, request.index) << request.number;
  }
  EXPECT_EQ(2, found);
}

// P707 [-01] and [-02].
TEST(WhatIsRead, AreVersionAndRevisionOfTheSoftware) {
  DeviceReader reader{Series::kSk5xxe};
  askAll(reader, [](const ParameterRequest& request) { return done(request.number == 707 ? 20 + request.index : 1); });
  EXPECT_EQ(21, reader.data().software_version);
  EXPECT_EQ(22, reader.data().software_revision);
}

// With further words in use, those of every set the driver may be in.
TEST(WhatIsRead, AreTheFurtherFunctionsOfAllFourSets) {
  for (const Series series : {Series::kSk5xxe, Series::kSk2xxe}) {
    DeviceReader reader{series, TimeoutOwner::kInverter, true};
    askAll(reader, [](const ParameterRequest& request) {
      return done(1000 * request.parameter_set + request.number + request.index - 1);
    });
    for (std::uint16_t set = 1; set <= 4; ++set) {
      const auto first = static_cast<std::uint16_t>(1000 * set + 543);
      const WordFunctions& words = reader.data().word_functions[set - 1u];
      EXPECT_THAT(words.actual_values, ElementsAre(first, first + 1, first + 2)) << set;
      EXPECT_THAT(words.setpoints, ElementsAre(first + 3, first + 4, first + 5)) << set;
    }
  }
}

// What stops the drive when this computer dies, and whether it saves.
TEST(ReadAgainByNumber, IsWhatMayHaveBecomeAnother) {
  DeviceReader reader{Series::kSk54xe, TimeoutOwner::kModule};
  askAll(reader);
  for (const std::uint16_t number : std::initializer_list<std::uint16_t>{120, 151, 513, 560}) {
    reader.askAgain(number);
    EXPECT_THAT(numbersOf(askAll(reader)), ElementsAre(number));
  }
}

TEST(ReadAgainByNumber, AreNoOthers) {
  DeviceReader reader{Series::kSk54xe, TimeoutOwner::kModule};
  askAll(reader);
  for (const std::uint16_t number : std::initializer_list<std::uint16_t>{102, 103, 105, 480, 509, 543, 707}) {
    reader.askAgain(number);
    EXPECT_FALSE(reader.pollRequest()) << number;
  }
}

// The answer of before was not stored; the one of after the drive's return is.
TEST(ReadAgainByNumber, HoldsNoAnswerBackAfterALoss) {
  DeviceReader reader{Series::kSk5xxe};
  askAll(reader);
  reader.askAgain(513);
  ASSERT_TRUE(reader.pollRequest());
  reader.askAgain(513);
  reader.handleOffline();
  const auto first = reader.pollRequest();
  ASSERT_TRUE(first);
  EXPECT_EQ(105, first->number);
  reader.handleResult(done(500));
  EXPECT_EQ(50.0, reader.data().max_frequency[0]);
}

/// A device of which one parameter times out.
class MissingMotion : public ::testing::Test {
 protected:
  void runRound(std::uint16_t silent) {
    askAll(reader_, [silent](const ParameterRequest& request) {
      return request.number == silent && request.parameter_set == 1 ? timedOut() : done(500);
    });
  }
  DeviceReader reader_{Series::kSk5xxe};
};

// P510 is the last of those that enabling waits for: P513, which refuses nothing, comes behind it.
TEST_F(MissingMotion, IsAwaitedNoLongerWhenAnotherParameterIsReadAgain) {
  runRound(510);
  for (int again = 0; again < 3; ++again) {
    reader_.askMissingAgain();
    runRound(510);
  }
  ASSERT_TRUE(reader_.motionKnown());
  reader_.askAgain(513);
  EXPECT_TRUE(reader_.motionKnown());
}

// It has been asked for often enough: a drive that may be enabled stays so while it is asked for once more.
TEST_F(MissingMotion, IsAwaitedNoLongerWhileItIsAskedForOnceMore) {
  runRound(104);
  for (int again = 0; again < 3; ++again) {
    reader_.askMissingAgain();
    runRound(104);
  }
  for (int more = 0; more < 3; ++more) {
    reader_.askMissingAgain();
    ASSERT_TRUE(reader_.pollRequest());
    EXPECT_TRUE(reader_.motionKnown());
    reader_.handleResult(timedOut());
    runRound(104);
  }
}

// First all others are read, and what is under way again is not asked for beside itself.
TEST_F(MissingMotion, IsToldWhenAllHasBeenAskedFor) {
  while (const auto request = reader_.pollRequest()) {
    EXPECT_FALSE(reader_.missesMotion()) << request->number;
    const bool silent = request->number == 104 && request->parameter_set == 1;
    reader_.handleResult(silent ? timedOut() : done(500));
  }
  EXPECT_TRUE(reader_.missesMotion());
  reader_.askMissingAgain();
  EXPECT_FALSE(reader_.missesMotion());
  ASSERT_TRUE(reader_.pollRequest());
  EXPECT_FALSE(reader_.missesMotion());
}

// The last question before has timed out to its end; the channel may be free by now.
TEST_F(MissingMotion, IsAskedForThreeTimesAgain) {
  askAll(reader_, [](const ParameterRequest&) { return timedOut(); });
  reader_.askMissingAgain();
  for (int attempt = 0; attempt < 3; ++attempt) {
    const auto request = reader_.pollRequest();
    ASSERT_TRUE(request);
    EXPECT_EQ(1, request->parameter_set) << "attempt " << attempt;
    reader_.handleResult(timedOut());
  }
}

}  // namespace
}  // namespace nord_driver::cycle

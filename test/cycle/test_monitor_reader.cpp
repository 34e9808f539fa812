// Parameters somebody wants to look at: in turn, once a second, and not for ever where the drive refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "cycle/monitor_reader.h"

namespace nord_driver::cycle {
namespace {

using profile::ParameterOutcome;
using profile::ParameterReason;
using profile::ParameterRequest;
using profile::ParameterResult;
using profile::ParameterShape;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using State = MonitoredValue::State;

constexpr Duration kCycle = std::chrono::milliseconds{10};

ParameterRequest plain(std::uint16_t number) {
  ParameterRequest request;
  request.number = number;
  return request;
}

ParameterResult result(ParameterOutcome outcome, ParameterReason reason = ParameterReason::kNone,
                       std::int32_t raw = 0) {
  ParameterResult result;
  result.outcome = outcome;
  result.reason = reason;
  result.raw = raw;
  return result;
}

const ParameterResult kDone7 = result(ParameterOutcome::kDone, ParameterReason::kNone, 7);
const ParameterResult kRefused = result(ParameterOutcome::kRefused, ParameterReason::kNoSuchParameter);
const ParameterResult kTimeout = result(ParameterOutcome::kTimeout);

struct Monitor {
  explicit Monitor(const std::vector<std::uint16_t>& numbers) : reader{requests(numbers)} {}

  static std::vector<ParameterRequest> requests(const std::vector<std::uint16_t>& numbers) {
    std::vector<ParameterRequest> list;
    for (const std::uint16_t number : numbers) list.push_back(plain(number));
    return list;
  }
  /// Every question of the next `span`, each answered in the cycle after it.
  std::vector<std::uint16_t> asked(Duration span, const ParameterResult& answer) {
    std::vector<std::uint16_t> numbers;
    for (const Instant end = now + span; now < end; now += kCycle) {
      const auto request = reader.pollRequest(1, now);
      if (!request) continue;
      EXPECT_FALSE(reader.pollRequest(1, now)) << "one question at a time";
      numbers.push_back(request->number);
      reader.handleResult(answer, "left");
    }
    return numbers;
  }
  State state(std::size_t index) const { return reader.values()[index].state; }

  MonitorReader reader;
  Instant now{std::chrono::hours{1}};
};

constexpr Duration kSecond = std::chrono::seconds{1};

TEST(MonitorReader, AsksForAllInTurnOnceASecond) {
  Monitor monitor{{719, 728, 700}};
  EXPECT_THAT(monitor.asked(kSecond, kDone7), ElementsAre(719, 728, 700));
  EXPECT_THAT(monitor.asked(kSecond, kDone7), ElementsAre(719, 728, 700));
  for (const MonitoredValue& value : monitor.reader.values()) {
    EXPECT_EQ(State::kKnown, value.state);
    EXPECT_EQ(7, value.raw);
  }
}

TEST(MonitorReader, WithoutParametersAsksNothing) {
  Monitor monitor{{}};
  EXPECT_THAT(monitor.asked(3 * kSecond, kDone7), IsEmpty());
}

// Until the drive has been away: another one may have taken its place.
TEST(MonitorReader, ARefusedParameterIsNotAskedForAgain) {
  Monitor monitor{{719, 728}};
  EXPECT_THAT(monitor.asked(kSecond / 2, kRefused), ElementsAre(719, 728));
  EXPECT_THAT(monitor.asked(5 * kSecond, kRefused), IsEmpty());
  EXPECT_EQ(State::kRefused, monitor.state(0));
  EXPECT_THAT(monitor.reader.values()[0].why.str(), HasSubstr("drive left refuses P719"));
  monitor.reader.handleOffline();
  EXPECT_EQ(State::kNotRead, monitor.state(0));
  EXPECT_THAT(monitor.asked(kSecond / 2, kDone7), ElementsAre(719, 728));
}

// What a passing state of the device forbids is asked for in the next turn.
TEST(MonitorReader, WhatOnlyTheMomentForbidsIsAskedForAgain) {
  const ParameterResult not_now = result(ParameterOutcome::kRefused, ParameterReason::kNotNow);
  Monitor monitor{{719}};
  EXPECT_THAT(monitor.asked(kSecond, not_now), ElementsAre(719));
  EXPECT_EQ(State::kRefused, monitor.state(0));
  EXPECT_THAT(monitor.asked(kSecond, kDone7), ElementsAre(719));
  EXPECT_EQ(State::kKnown, monitor.state(0));
}

TEST(MonitorReader, WithoutAChannelItAsksOnce) {
  ParameterResult none = result(ParameterOutcome::kNoChannel);
  none.text = "PPO 4 carries no parameters";
  Monitor monitor{{719}};
  EXPECT_THAT(monitor.asked(5 * kSecond, none), ElementsAre(719));
  EXPECT_EQ("no parameter channel reaches P719 of drive left: PPO 4 carries no parameters",
            monitor.reader.values()[0].why.str());
}

// A channel that is silent is given a second, and the next one its turn.
TEST(MonitorReader, AfterATimeOutItPauses) {
  Monitor monitor{{719, 728}};
  EXPECT_THAT(monitor.asked(kSecond / 2, kTimeout), ElementsAre(719));
  EXPECT_EQ(State::kNoAnswer, monitor.state(0));
  EXPECT_EQ("drive left gave no answer for P719", monitor.reader.values()[0].why.str());
  EXPECT_THAT(monitor.asked(kSecond, kTimeout), ElementsAre(728));
  EXPECT_THAT(monitor.asked(kSecond, kTimeout), ElementsAre(719));
}

// The question was not put at all.
TEST(MonitorReader, WhatDidNotReachTheDriveIsAskedAgainAtOnce) {
  Monitor monitor{{719, 728}};
  ASSERT_TRUE(monitor.reader.pollRequest(1, monitor.now));
  monitor.reader.handleResult(result(ParameterOutcome::kBusy), "left");
  EXPECT_EQ(State::kNotRead, monitor.state(0));
  EXPECT_THAT(monitor.asked(kSecond / 2, kDone7), ElementsAre(719, 728));
}

TEST(MonitorReader, SetZeroIsTheOneInForce) {
  ParameterRequest in_force;
  in_force.number = 105;
  in_force.shape = ParameterShape::kPerSet;
  in_force.parameter_set = 0;
  ParameterRequest third = in_force;
  third.parameter_set = 3;
  MonitorReader reader{{in_force, third}};
  Instant now{std::chrono::hours{1}};
  // Not known yet: the one with a set of its own is asked for all the same.
  auto request = reader.pollRequest(0, now);
  ASSERT_TRUE(request);
  EXPECT_EQ(3, request->parameter_set);
  reader.handleResult(kDone7, "left");
  now += kSecond;
  EXPECT_FALSE(reader.pollRequest(2, now));  // the end of the turn
  request = reader.pollRequest(2, now);
  ASSERT_TRUE(request);
  EXPECT_EQ(2, request->parameter_set);
}

TEST(MonitorReader, AnAnswerNobodyWaitsForChangesNothing) {
  Monitor monitor{{719}};
  ASSERT_TRUE(monitor.reader.pollRequest(1, monitor.now));
  monitor.reader.handleOffline();
  monitor.reader.handleResult(kDone7, "left");
  EXPECT_EQ(State::kNotRead, monitor.state(0));
}

TEST(MonitorReader, BeginsAgainWithTheFirstWhenTheDriveIsBack) {
  Monitor monitor{{719, 728}};
  ASSERT_TRUE(monitor.reader.pollRequest(1, monitor.now));
  monitor.reader.handleResult(kDone7, "left");
  monitor.reader.handleOffline();
  EXPECT_THAT(monitor.asked(kSecond / 2, kDone7), ElementsAre(719, 728));
}

// The silence was that of the drive before it was away.
TEST(MonitorReader, TheSilenceOfBeforeIsForgottenWhenTheDriveIsBack) {
  Monitor monitor{{719, 728}};
  EXPECT_THAT(monitor.asked(kSecond / 2, kTimeout), ElementsAre(719));
  monitor.reader.handleOffline();
  EXPECT_THAT(monitor.asked(kSecond / 2, kDone7), ElementsAre(719, 728));
}

TEST(MonitorReader, AValueThatIsKnownHasNoReasonNotToBe) {
  Monitor monitor{{719}};
  monitor.asked(kSecond, result(ParameterOutcome::kRefused, ParameterReason::kNotNow));
  EXPECT_FALSE(monitor.reader.values()[0].why.empty());
  monitor.asked(kSecond, kDone7);
  EXPECT_TRUE(monitor.reader.values()[0].why.empty());
  monitor.asked(kSecond, kTimeout);
  EXPECT_EQ(0, monitor.reader.values()[0].raw) << "what was known is not";
}

}  // namespace
}  // namespace nord_driver::cycle

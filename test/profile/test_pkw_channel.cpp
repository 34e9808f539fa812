#include <gtest/gtest.h>

#include <vector>

#include "profile/pkw_channel.h"

namespace nord_driver::profile {
namespace {

constexpr Duration kTimeout = seconds(0.5);
constexpr Duration kCycle = seconds(0.01);
constexpr PkwWords kNothing{};

ParameterRequest read(std::uint16_t number, ParameterShape shape, std::uint32_t id = 1) {
  ParameterRequest request;
  request.id = id;
  request.number = number;
  request.shape = shape;
  return request;
}

ParameterRequest writeP102(ParameterAction action) {
  ParameterRequest request = read(102, ParameterShape::kPerSet);
  request.parameter_set = 3;
  request.action = action;
  request.raw = 1000;
  return request;
}

class PkwChannelTest : public ::testing::Test {
 protected:
  /// One exchange: returns what was asked, answers with `words`.
  PkwWords exchange(const PkwWords& words) {
    const PkwWords asked = channel_.pollWords(now_);
    now_ += kCycle;
    channel_.handleWords(words, now_);
    return asked;
  }
  /// The pause the channel begins with.
  void clear() { EXPECT_EQ(kNothing, exchange(kNothing)); }

  PkwChannel channel_{kTimeout};
  Instant now_{};
};

// BU 2700 6.6.3 on the wire, the order repeated until its answer is there, and not once more.
TEST_F(PkwChannelTest, WritesTheManualsExample) {
  ASSERT_TRUE(channel_.submit(writeP102(ParameterAction::kWritePersistent), now_));
  clear();
  const PkwWords order{0x744E, 0x0200, 0x0000, 0x03E8};
  EXPECT_EQ(order, exchange(kNothing));
  EXPECT_EQ(order, exchange(kNothing));
  EXPECT_FALSE(channel_.pollResult().has_value());
  EXPECT_EQ(order, exchange({0x444E, 0x0200, 0x0000, 0x03E8}));
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kDone, result->outcome);
  EXPECT_EQ(1000, result->raw);
  // A write left standing would be executed again and again (BU 2700 6.5, 100 000 cycles).
  EXPECT_EQ(kNothing, exchange({0x444E, 0x0200, 0x0000, 0x03E8}));
  EXPECT_EQ(kNothing, exchange(kNothing));
}

// RAM writes are AK 12 with an index, 14 without, 11 and 13 for double words.
TEST_F(PkwChannelTest, WritesToRamWithLabelsOfTheirOwn) {
  ParameterRequest request = writeP102(ParameterAction::kWriteRam);
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  EXPECT_EQ((PkwWords{0xC44E, 0x0200, 0, 0x03E8}), exchange({0x444E, 0x0200, 0, 0x03E8}));
  request.shape = ParameterShape::kPlain;
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  EXPECT_EQ((PkwWords{0xE44E, 0, 0, 0x03E8}), exchange({0x144E, 0, 0, 0x03E8}));
  request.double_word = true;
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  EXPECT_EQ((PkwWords{0xD44E, 0, 0, 0x03E8}), exchange({0x244E, 0, 0, 0x03E8}));
  request.shape = ParameterShape::kPerSet;
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  EXPECT_EQ((PkwWords{0xB44E, 0x0200, 0, 0x03E8}), exchange({0x544E, 0x0200, 0, 0x03E8}));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(ParameterOutcome::kDone, channel_.pollResult()->outcome) << i;
}

// Into the EEPROM they are AK 8 with an index and 3 without.
TEST_F(PkwChannelTest, WritesDoubleWordsPersistently) {
  ParameterRequest request = writeP102(ParameterAction::kWritePersistent);
  request.double_word = true;
  request.raw = 0x00018ABC;
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  const PkwWords indexed{0x844E, 0x0200, 0x0001, 0x8ABC};
  EXPECT_EQ(indexed, exchange({0x544E, 0x0200, 0x0002, 0x8ABC})) << "answered with another high word";
  EXPECT_FALSE(channel_.pollResult().has_value());
  EXPECT_EQ(indexed, exchange({0x544E, 0x0200, 0x0001, 0x8ABC}));
  EXPECT_EQ(0x00018ABC, channel_.pollResult()->raw);
  request.shape = ParameterShape::kPlain;
  ASSERT_TRUE(channel_.submit(request, now_));
  clear();
  EXPECT_EQ((PkwWords{0x344E, 0, 0x0001, 0x8ABC}), exchange({0x244E, 0, 0x0001, 0x8ABC}));
  EXPECT_EQ(ParameterOutcome::kDone, channel_.pollResult()->outcome);
}

// The time of the first in the queue begins when it is submitted, whether or not words are exchanged.
TEST_F(PkwChannelTest, TimePassesWithoutAnExchange) {
  ASSERT_TRUE(channel_.submit(read(508, ParameterShape::kPlain), now_));
  now_ += kTimeout;
  EXPECT_EQ(kNothing, channel_.pollWords(now_));
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kTimeout, result->outcome);
}

// What carries the words says no, or fails: that ends the request that runs, and the next one begins with a pause.
TEST_F(PkwChannelTest, IsToldThatItsWordsAreNotCarried) {
  Sentence why;
  why = "the words of the carrier";
  for (const bool refused : {true, false}) {
    ASSERT_TRUE(channel_.submit(read(508, ParameterShape::kPlain, 1), now_));
    ASSERT_TRUE(channel_.submit(read(507, ParameterShape::kPlain, 2), now_));
    clear();
    ASSERT_EQ((PkwWords{0x15E4, 0, 0, 0}), exchange(kNothing));
    if (refused) {
      channel_.handleRefusal(ParameterReason::kNotSupported, why);
    } else {
      channel_.handleFailure(ParameterOutcome::kNoChannel, why);
    }
    const auto result = channel_.pollResult();
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(1u, result->id);
    EXPECT_EQ(refused ? ParameterOutcome::kRefused : ParameterOutcome::kNoChannel, result->outcome);
    EXPECT_EQ(refused ? ParameterReason::kNotSupported : ParameterReason::kNone, result->reason);
    EXPECT_EQ("the words of the carrier", result->text.str());
    const PkwWords late{0x15E4, 0, 0, 3};
    EXPECT_EQ(kNothing, exchange(late)) << "the order may have arrived: its answer is waited out";
    EXPECT_EQ(kNothing, exchange(late));
    EXPECT_EQ(kNothing, exchange(kNothing));
    EXPECT_EQ((PkwWords{0x15E3, 0, 0, 0}), exchange({0x15E3, 0, 0, 1}));
    EXPECT_EQ(2u, channel_.pollResult()->id);
  }
}

TEST_F(PkwChannelTest, IsToldSoWhileNothingRuns) {
  Sentence why;
  why = "nobody asked";
  clear();
  channel_.handleRefusal(ParameterReason::kNotSupported, why);
  channel_.handleFailure(ParameterOutcome::kTimeout, why);
  EXPECT_FALSE(channel_.pollResult().has_value());
  ASSERT_TRUE(channel_.submit(read(508, ParameterShape::kPlain, 1), now_));
  EXPECT_EQ((PkwWords{0x15E4, 0, 0, 0}), exchange({0x15E4, 0, 0, 3})) << "the pause before it was answered";
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kDone, result->outcome);
  EXPECT_EQ(3, result->raw);
  EXPECT_TRUE(result->text.empty());
}

// Two equal reads in a row: the answer to the first, still repeated, is never taken for the second.
TEST_F(PkwChannelTest, NeverTakesTheOldAnswerForAnEqualOrder) {
  channel_.submit(read(508, ParameterShape::kPlain, 1), now_);
  channel_.submit(read(508, ParameterShape::kPlain, 2), now_);
  clear();
  const PkwWords order{0x15E4, 0, 0, 0};
  const PkwWords old{0x15E4, 0, 0, 3};
  EXPECT_EQ(order, exchange(old));
  EXPECT_EQ(3, channel_.pollResult()->raw);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(kNothing, exchange(old)) << i;
  EXPECT_EQ(kNothing, exchange(kNothing));
  EXPECT_EQ(order, exchange({0x15E4, 0, 0, 4}));
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(2u, result->id);
  EXPECT_EQ(4, result->raw);
}

// An order that cannot be mistaken starts after one exchange of "no order". While a slow inverter has not executed it,
// the answer before it stands on: that is no error, and not counted as one.
TEST_F(PkwChannelTest, TakesTheStandingAnswerForPatience) {
  channel_.submit(read(508, ParameterShape::kPlain, 1), now_);
  channel_.submit(read(507, ParameterShape::kPlain, 2), now_);
  clear();
  exchange(kNothing);
  exchange({0x15E4, 0, 0, 3});
  EXPECT_EQ(kNothing, exchange({0x15E4, 0, 0, 3}));
  const PkwWords order{0x15E3, 0, 0, 0};
  EXPECT_EQ(order, exchange({0x15E4, 0, 0, 3}));
  EXPECT_EQ(order, exchange({0x15E4, 0, 0, 3}));
  EXPECT_EQ(order, exchange(kNothing));
  EXPECT_EQ(order, exchange({0x15E3, 0, 0, 1}));
  EXPECT_EQ(0u, channel_.stale());
  EXPECT_EQ(3, channel_.pollResult()->raw);
  EXPECT_EQ(1, channel_.pollResult()->raw);
}

// An answer to no order of ours is somebody else's: never taken, and counted once however often it is repeated.
TEST_F(PkwChannelTest, CountsAnswersThatBelongToNoOrder) {
  channel_.submit(read(508, ParameterShape::kPlain, 1), now_);
  clear();
  const PkwWords foreign{0x15E3, 0, 0, 1};
  exchange(foreign);
  exchange(foreign);
  EXPECT_EQ(1u, channel_.stale());
  exchange({0x44E8, 0x0100, 0, 1});
  EXPECT_EQ(2u, channel_.stale());
  EXPECT_FALSE(channel_.pollResult().has_value());
  exchange({0x15E4, 0, 0, 3});
  EXPECT_EQ(3, channel_.pollResult()->raw);
  EXPECT_EQ(2u, channel_.stale());
}

// The answer to an order that was given up may still come: only an answered pause makes room for the next.
TEST_F(PkwChannelTest, WaitsForAnAnsweredPauseAfterATimeout) {
  channel_.submit(read(508, ParameterShape::kPlain, 1), now_);
  channel_.submit(read(507, ParameterShape::kPlain, 2), now_);
  clear();
  const PkwWords late{0x1000 | 1900, 0, 0, 9};
  const Instant start = now_;
  while (!channel_.pollResult().has_value()) {
    ASSERT_LE(now_ - start, kTimeout + kCycle) << "the first order is not given up";
    exchange(late);
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(kNothing, exchange(late)) << i;
  EXPECT_EQ(kNothing, exchange(kNothing));
  EXPECT_EQ((PkwWords{0x15E3, 0, 0, 0}), exchange({0x15E3, 0, 0, 1}));
  EXPECT_EQ(ParameterOutcome::kDone, channel_.pollResult()->outcome);
}

// A fresh channel does not trust what stands in the inverter from a master before.
TEST_F(PkwChannelTest, DoesNotTrustAnAnswerThatWasThereBeforeIt) {
  channel_.submit(read(508, ParameterShape::kPlain), now_);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(kNothing, exchange({0x15E4, 0, 0, 77})) << i;
  EXPECT_FALSE(channel_.pollResult().has_value());
  exchange(kNothing);
  exchange({0x15E4, 0, 0, 3});
  EXPECT_EQ(3, channel_.pollResult()->raw);
}

// Each order has its own deadline, from the moment it is the first; the order is withdrawn with it.
TEST_F(PkwChannelTest, GivesUpAtTheDeadline) {
  channel_.submit(writeP102(ParameterAction::kWritePersistent), now_);
  const Instant start = now_;
  clear();
  while (!channel_.pollResult().has_value()) {
    ASSERT_LE(now_ - start, kTimeout + kCycle);
    exchange(kNothing);
  }
  EXPECT_GE(now_ - start, kTimeout);
  EXPECT_EQ(kNothing, exchange(kNothing));
}

TEST_F(PkwChannelTest, ReportsTheInvertersRefusal) {
  channel_.submit(writeP102(ParameterAction::kWriteRam), now_);
  clear();
  exchange({0x744E, 0x0200, 0, 201});
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kRefused, result->outcome);
  EXPECT_EQ(ParameterReason::kNotSupported, result->reason);
  EXPECT_EQ(pkwErrorText(201).str(), result->text.str());
}

// Error 4, "no array": the parameter has no sets in this inverter; read once more without an index.
TEST_F(PkwChannelTest, FallsBackToTheReadWithoutIndexOnce) {
  channel_.submit(read(112, ParameterShape::kPerSet), now_);
  clear();
  EXPECT_EQ((PkwWords{0x6458, 0, 0, 0}), exchange({0x7458, 0, 0, 4}));
  EXPECT_EQ(kNothing, exchange({0x7458, 0, 0, 4}));
  EXPECT_EQ(kNothing, exchange(kNothing));
  EXPECT_EQ((PkwWords{0x1458, 0, 0, 0}), exchange({0x7458, 0, 0, 4}));
  const auto result = channel_.pollResult();
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(ParameterOutcome::kRefused, result->outcome);
}

// AK 1 ignores the index (BU 0020 7.5.2), and its answer has none.
TEST_F(PkwChannelTest, FallsBackFromAnySetToNoIndex) {
  ParameterRequest request = read(112, ParameterShape::kPerSet);
  request.parameter_set = 3;
  channel_.submit(request, now_);
  clear();
  EXPECT_EQ((PkwWords{0x6458, 0x0200, 0, 0}), exchange({0x7458, 0x0200, 0, 4}));
  EXPECT_EQ(kNothing, exchange(kNothing));
  EXPECT_EQ((PkwWords{0x1458, 0, 0, 0}), exchange({0x1458, 0, 0, 25}));
  EXPECT_EQ(25, channel_.pollResult()->raw);
}

// P700 is an array only from firmware V1.9 on: error 3 or 4 leads to the plain read, of its first element only.
TEST_F(PkwChannelTest, FallsBackForP700OfOldFirmware) {
  ParameterRequest request = read(700, ParameterShape::kArray);
  channel_.submit(request, now_);
  clear();
  EXPECT_EQ((PkwWords{0x66A4, 0, 0, 0}), exchange({0x76A4, 0, 0, 3}));
  clear();
  EXPECT_EQ((PkwWords{0x16A4, 0, 0, 0}), exchange({0x16A4, 0, 0, 102}));
  EXPECT_EQ(102, channel_.pollResult()->raw);
  request.index = 3;
  channel_.submit(request, now_);
  clear();
  EXPECT_EQ((PkwWords{0x66A4, 0x0200, 0, 0}), exchange({0x76A4, 0x0200, 0, 3}));
  EXPECT_EQ(ParameterOutcome::kRefused, channel_.pollResult()->outcome);
}

TEST_F(PkwChannelTest, EndsEverythingWhenTheInverterIsGone) {
  for (std::uint32_t id = 1; id <= 3; ++id) channel_.submit(read(508, ParameterShape::kPlain, id), now_);
  clear();
  channel_.pollWords(now_);
  channel_.handleOffline(now_);
  for (std::uint32_t id = 1; id <= 3; ++id) {
    const auto result = channel_.pollResult();
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(id, result->id);
    EXPECT_EQ(ParameterOutcome::kOffline, result->outcome);
  }
  EXPECT_EQ(kNothing, channel_.pollWords(now_));
}

TEST_F(PkwChannelTest, HoldsEightRequests) {
  for (std::uint32_t id = 0; id < 8; ++id) EXPECT_TRUE(channel_.submit(read(508, ParameterShape::kPlain, id), now_));
  EXPECT_FALSE(channel_.submit(read(508, ParameterShape::kPlain, 8), now_));
  channel_.handleOffline(now_);
  EXPECT_FALSE(channel_.submit(read(508, ParameterShape::kPlain, 8), now_));
  channel_.pollResult();
  EXPECT_TRUE(channel_.submit(read(508, ParameterShape::kPlain, 8), now_));
}

TEST_F(PkwChannelTest, RefusesWhatNoOrderCanSay) {
  ParameterRequest request = read(1000, ParameterShape::kPlain);
  channel_.submit(request, now_);
  EXPECT_EQ(ParameterOutcome::kRefused, channel_.pollResult()->outcome);
  request = read(105, ParameterShape::kPerSet);
  request.parameter_set = 5;
  channel_.submit(request, now_);
  EXPECT_EQ(ParameterReason::kNoSuchElement, channel_.pollResult()->reason);
  request = read(546, ParameterShape::kArrayPerSet);
  request.index = 65;
  channel_.submit(request, now_);
  EXPECT_EQ(ParameterReason::kNoSuchElement, channel_.pollResult()->reason);
}

// A request that is refused at once takes nothing from the one that runs: neither its time nor its fall-back.
TEST_F(PkwChannelTest, ARefusalAtOnceLeavesTheRunningRequestItsDeadline) {
  channel_.submit(read(105, ParameterShape::kPerSet, 1), now_);
  const Instant start = now_;
  std::optional<ParameterResult> ended;
  while (!ended) {
    ASSERT_LE(now_ - start, kTimeout + kCycle);
    exchange(kNothing);
    channel_.submit(read(1000, ParameterShape::kPlain, 2), now_);
    while (const auto result = channel_.pollResult()) {
      if (result->id == 1) ended = result;
    }
  }
  EXPECT_EQ(ParameterOutcome::kTimeout, ended->outcome);
}

// An order that went out before the inverter was lost may still be answered: nothing is asked before "no answer".
TEST_F(PkwChannelTest, WaitsForAnAnsweredPauseAfterALoss) {
  ASSERT_TRUE(channel_.submit(read(105, ParameterShape::kPerSet, 1), now_));
  clear();
  const PkwWords order{0x6451, 0x0000, 0x0000, 0x0000};
  ASSERT_EQ(order, exchange(kNothing));
  channel_.handleOffline(now_);
  ASSERT_EQ(ParameterOutcome::kOffline, channel_.pollResult()->outcome);
  ASSERT_TRUE(channel_.submit(read(105, ParameterShape::kPerSet, 2), now_));
  const PkwWords somebody_elses{0x14E8, 0x0000, 0x0000, 0x0001};
  EXPECT_EQ(kNothing, exchange(somebody_elses));
  EXPECT_EQ(kNothing, exchange(somebody_elses));
  EXPECT_EQ(kNothing, exchange({0x4451, 0x0000, 0x0000, 0x01F4})) << "P105 as it was before the loss";
  EXPECT_FALSE(channel_.pollResult().has_value());
  EXPECT_EQ(kNothing, exchange(kNothing));
  EXPECT_EQ(order, exchange({0x4451, 0x0000, 0x0000, 0x03E8}));
  EXPECT_EQ(1000, channel_.pollResult()->raw);
}

}  // namespace
}  // namespace nord_driver::profile

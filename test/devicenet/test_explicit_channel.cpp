#include <gtest/gtest.h>

#include "devicenet/connect_requests.h"
#include "devicenet/explicit_channel.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

// The engine and the layer above take turns, however many requests wait.
TEST(ExplicitChannel, TakesTurns) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  for (std::uint8_t i = 1; i <= 4; ++i) ASSERT_TRUE(channel.submit(getAttribute(i, 101, 1, i), now));
  std::string asked;
  bool xid = true;
  for (int i = 0; i < 6; ++i) {
    if (i % 2 == 0) channel.ask(getAttribute(0, 5, 2, 1), ExplicitPort::kConnected, milliseconds{100}, now);
    CanFrame frame;
    ASSERT_TRUE(channel.pollTransmit(frame, now));
    asked += frame.data[2] == 5 ? 'e' : 'u';
    channel.handle(nord_driver::frame(xid ? "42B#408E03" : "42B#008E03"), now);
    xid = !xid;
  }
  EXPECT_EQ("ueueue", asked);
}

// What the device answers, under the transaction id it was asked with.
void answerWord(ExplicitChannel& channel, bool xid, std::uint8_t value, Instant now) {
  channel.handle(frame(std::string{xid ? "42B#408E" : "42B#008E"} + (value == 1 ? "0100" : "0200")), now);
}
bool xidOfNext(ExplicitChannel& channel, Instant now) {
  CanFrame asked;
  EXPECT_TRUE(channel.pollTransmit(asked, now));
  return (asked.data[0] & 0x40u) != 0;
}
// Asked twice and given up.
bool giveUp(ExplicitChannel& channel, Instant& now) {
  const bool xid = xidOfNext(channel, now);
  for (int i = 0; i < 2; ++i) {
    now += milliseconds{500};
    channel.poll(now);
    if (i == 0 && xid != xidOfNext(channel, now)) ADD_FAILURE() << "repeated under another transaction id";
  }
  const auto answer = channel.pollAnswer();
  EXPECT_TRUE(answer && answer->end == ExplicitEnd::kTimedOut);
  return xid;
}

// The third waits: both transaction ids are owed answers.
void giveUpTwoOfThree(ExplicitChannel& channel, Instant& now) {
  channel.open();
  for (std::uint8_t i = 1; i <= 3; ++i) channel.submit(getAttribute(i, 101, 1, i), now);
  giveUp(channel, now);
  giveUp(channel, now);
}

// A parameter is given up, a keep-alive has its answer, and the answer to the parameter comes while the next one is asked for:
// its value is not the next one's.
TEST(ExplicitChannel, ALateAnswerIsNotTakenForAnotherRequest) {
  for (const bool error : {false, true}) {
    ExplicitChannel channel{0, 5, milliseconds{500}};
    Instant now{std::chrono::hours{1}};
    channel.open();
    channel.submit(getAttribute(1, 101, 1, 4), now);
    const bool first = giveUp(channel, now);
    channel.ask(getAttribute(0, 5, 2, 1), ExplicitPort::kConnected, milliseconds{200}, now);
    const bool alive = xidOfNext(channel, now);
    channel.handle(frame(alive ? "42B#408E03" : "42B#008E03"), now);
    ASSERT_TRUE(channel.takeOwnAnswer());
    channel.submit(getAttribute(2, 101, 1, 3), now);
    const bool second = xidOfNext(channel, now);
    if (error) {
      channel.handle(frame(first ? "42B#409414FF" : "42B#009414FF"), now);
    } else {
      answerWord(channel, first, 1, now);
    }
    EXPECT_FALSE(channel.pollAnswer()) << "the late answer, error " << error;
    answerWord(channel, second, 2, now);
    const auto answer = channel.pollAnswer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(2u, answer->number());
  }
}

// Both transaction ids are owed an answer: the next request waits for one of them, or for the longest time.
TEST(ExplicitChannel, WhereBothTransactionIdsAreOwedAnAnswerTheNextRequestWaits) {
  for (const bool comes : {true, false}) {
    ExplicitChannel channel{0, 5, milliseconds{500}};
    Instant now{std::chrono::hours{1}};
    channel.open();
    channel.submit(getAttribute(1, 101, 1, 4), now);
    const bool first = giveUp(channel, now);
    const Instant given_up = now;
    channel.submit(getAttribute(2, 101, 1, 3), now);
    EXPECT_NE(first, giveUp(channel, now));
    channel.submit(getAttribute(3, 101, 1, 2), now);
    CanFrame asked;
    EXPECT_FALSE(channel.pollTransmit(asked, now));
    ASSERT_TRUE(channel.nextDeadline());
    EXPECT_EQ(given_up + std::chrono::seconds{5}, *channel.nextDeadline());
    if (comes) {
      answerWord(channel, first, 1, now);
      EXPECT_FALSE(channel.pollTransmit(asked, now)) << "it was asked twice";
      answerWord(channel, first, 1, now);
    } else {
      now = given_up + std::chrono::seconds{5};
      channel.poll(now);
    }
    EXPECT_EQ(first, xidOfNext(channel, now));
    EXPECT_FALSE(channel.pollAnswer());
    answerWord(channel, first, 2, now);
    const auto answer = channel.pollAnswer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(2u, answer->number());
  }
}

// A keep-alive that shares its transaction id with a request that was given up, and is given up as well: four answers may come.
TEST(ExplicitChannel, AsManyAnswersAreAwaitedAsWereAskedFor) {
  ExplicitChannel channel{0, 5, milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  giveUpTwoOfThree(channel, now);
  channel.ask(getAttribute(0, 5, 2, 1), ExplicitPort::kConnected, milliseconds{200}, now);
  const bool shared = xidOfNext(channel, now);
  for (int i = 0; i < 2; ++i) {
    now += milliseconds{200};
    channel.poll(now);
    if (i == 0) {
      EXPECT_EQ(shared, xidOfNext(channel, now));
    }
  }
  ASSERT_TRUE(channel.takeOwnAnswer());
  CanFrame asked;
  for (int i = 0; i < 2; ++i) {
    answerWord(channel, shared, 1, now);
    EXPECT_FALSE(channel.pollTransmit(asked, now));
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_FALSE(channel.pollTransmit(asked, now));
    channel.handle(frame(shared ? "42B#408E03" : "42B#008E03"), now);
    EXPECT_FALSE(channel.pollAnswer()) << "the state of the connection is no value of a parameter";
  }
  EXPECT_EQ(shared, xidOfNext(channel, now));
  answerWord(channel, shared, 2, now);
  const auto answer = channel.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(2u, answer->number());
}

// What was asked over a connection that is gone is not answered over the one that takes its place: nothing waits for it.
TEST(ExplicitChannel, WithANewConnectionNothingIsOwedAnyMore) {
  ExplicitChannel channel{0, 5, milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  giveUpTwoOfThree(channel, now);
  CanFrame asked;
  ASSERT_FALSE(channel.pollTransmit(asked, now));
  channel.handleNewConnection(now);
  answerWord(channel, xidOfNext(channel, now), 2, now);
  const auto answer = channel.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(2u, answer->number());
}

// Asked twice and answered twice: the second answer is not the next but one's.
TEST(ExplicitChannel, TheSecondAnswerToARepeatedRequestIsNotTakenForAnother) {
  ExplicitChannel channel{0, 5, milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  channel.open();
  for (std::uint8_t i = 1; i <= 3; ++i) channel.submit(getAttribute(i, 101, 1, i), now);
  const bool first = xidOfNext(channel, now);
  now += milliseconds{500};
  channel.poll(now);
  EXPECT_EQ(first, xidOfNext(channel, now));
  answerWord(channel, first, 1, now);
  answerWord(channel, xidOfNext(channel, now), 1, now);
  ASSERT_TRUE(channel.pollAnswer());
  ASSERT_TRUE(channel.pollAnswer());
  const bool third = xidOfNext(channel, now);
  answerWord(channel, first, 1, now);
  EXPECT_FALSE(channel.pollAnswer());
  answerWord(channel, third, 2, now);
  const auto answer = channel.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(2u, answer->number());
}

/// The engine allocates the explicit connection anew, and asks twice for the answer; its transaction id.
bool askTwiceToReopen(ExplicitChannel& channel, Instant& now) {
  const ConnectRequest reopen = allocateRequest(0x01, 0);
  channel.ask(reopen.request, reopen.port, milliseconds{200}, now);
  const bool xid = xidOfNext(channel, now);
  now += milliseconds{200};
  channel.poll(now);
  EXPECT_EQ(xid, xidOfNext(channel, now));
  return xid;
}
void answerReopening(ExplicitChannel& channel, bool xid, const char* what, Instant now) {
  channel.handle(frame(std::string{xid ? "42B#40" : "42B#00"} + what), now);
}

// An error names no service. That of an allocation may come after the allocation was given up, or after the second time it was
// asked for was answered: it is not the answer to what the layer above has asked since, over the new connection or that of before.
TEST(ExplicitChannel, ALateRefusalOfAnAllocationIsNotTakenForTheAnswerToAnotherRequest) {
  for (const bool reopened : {false, true}) {
    ExplicitChannel channel{0, 5, milliseconds{500}};
    Instant now{std::chrono::hours{1}};
    channel.open();
    const bool first = askTwiceToReopen(channel, now);
    if (reopened) {
      answerReopening(channel, first, "CB00", now);
      channel.handleNewConnection(now);
    } else {
      now += milliseconds{200};
      channel.poll(now);
    }
    ASSERT_TRUE(channel.takeOwnAnswer());
    for (std::uint8_t i = 1; i <= 3; ++i) channel.submit(getAttribute(i, 101, 1, i), now);
    answerWord(channel, xidOfNext(channel, now), 1, now);
    ASSERT_TRUE(channel.pollAnswer());
    const bool second = xidOfNext(channel, now);
    now += milliseconds{50};
    answerReopening(channel, first, "940B02", now);
    EXPECT_FALSE(channel.pollAnswer()) << reopened;
    answerWord(channel, second, 2, now);
    const auto answer = channel.pollAnswer();
    ASSERT_TRUE(answer) << reopened;
    EXPECT_EQ(2u, answer->number()) << reopened;
  }
}

// The module itself answers an allocation: it is not awaited for as long as a value of an inverter.
TEST(ExplicitChannel, ALateRefusalOfAnAllocationIsAwaitedForASecond) {
  ExplicitChannel channel{0, 5, milliseconds{500}};
  Instant now{std::chrono::hours{1}};
  channel.open();
  channel.submit(getAttribute(1, 101, 1, 4), now);
  const bool parameter = giveUp(channel, now);
  EXPECT_NE(parameter, askTwiceToReopen(channel, now));
  now += milliseconds{200};
  channel.poll(now);
  const Instant given_up = now;
  ASSERT_TRUE(channel.takeOwnAnswer());
  channel.submit(getAttribute(2, 101, 1, 3), now);
  CanFrame asked;
  EXPECT_FALSE(channel.pollTransmit(asked, now));
  ASSERT_TRUE(channel.nextDeadline());
  EXPECT_EQ(given_up + std::chrono::seconds{1}, *channel.nextDeadline());
  channel.poll(given_up + std::chrono::seconds{1});
  EXPECT_NE(parameter, xidOfNext(channel, given_up + std::chrono::seconds{1}));
}

// Both answers of it have come: its transaction id is free, and that of a parameter that was given up is not.
TEST(ExplicitChannel, AnAnswerToAnAllocationFreesNoOtherRequest) {
  for (const char* late : {"CB00", "940B02"}) {
    ExplicitChannel channel{0, 5, milliseconds{500}};
    Instant now{std::chrono::hours{1}};
    channel.open();
    for (std::uint8_t i = 1; i <= 3; ++i) channel.submit(getAttribute(i, 101, 1, i), now);
    giveUp(channel, now);
    giveUp(channel, now);
    const bool shared = askTwiceToReopen(channel, now);
    now += milliseconds{200};
    channel.poll(now);
    ASSERT_TRUE(channel.takeOwnAnswer());
    answerReopening(channel, shared, late, now);
    answerReopening(channel, shared, late, now);
    CanFrame asked;
    EXPECT_FALSE(channel.pollTransmit(asked, now)) << late << ": both are owed the answers of the parameters yet";
    answerWord(channel, shared, 1, now);
    answerWord(channel, shared, 1, now);
    EXPECT_EQ(shared, xidOfNext(channel, now)) << late;
  }
}

// A frame the link did not take comes again, first of all.
TEST(ExplicitChannel, NotSent) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  channel.submit(getAttribute(1, 101, 1, 1), now);
  CanFrame frame;
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  const CanFrame before = frame;
  channel.notSent(frame);
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  EXPECT_EQ(before, frame);
  EXPECT_FALSE(channel.pollTransmit(frame, now));
}

// The time for its answer begins when it has left: a request that waited is not repeated before the device can answer.
TEST(ExplicitChannel, TheTimeOfARequestThatWaitedBeginsWhenItLeaves) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  Instant now{std::chrono::hours{1}};
  channel.open();
  channel.submit(getAttribute(1, 101, 1, 1), now);
  CanFrame frame;
  for (int i = 0; i < 9; ++i) {
    ASSERT_TRUE(channel.pollTransmit(frame, now));
    channel.notSent(frame);
    now += milliseconds{10};
    channel.poll(now);
  }
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  now += milliseconds{99};
  channel.poll(now);
  EXPECT_FALSE(channel.pollTransmit(frame, now));
  now += milliseconds{1};
  channel.poll(now);
  EXPECT_TRUE(channel.pollTransmit(frame, now)) << "and is repeated then";
  EXPECT_FALSE(channel.pollAnswer());
}

// An acknowledge comes again too, ahead of anything else.
TEST(ExplicitChannel, AnAcknowledgeThatWasNotSentComesAgain) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  channel.submit(getAttribute(1, 101, 1, 1), now);
  CanFrame frame;
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  channel.handle(nord_driver::frame("42B#C0008E"), now);
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  EXPECT_EQ("42C#C0C000", text(frame));
  channel.notSent(frame);
  ASSERT_TRUE(channel.pollTransmit(frame, now));
  EXPECT_EQ("42C#C0C000", text(frame));
  EXPECT_FALSE(channel.pollTransmit(frame, now));
}

// What a device's format has no room for is answered at once, and holds nobody up.
TEST(ExplicitChannel, WhatDoesNotFitIsTooLong) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  ASSERT_TRUE(channel.submit(getAttribute(1, 0x165, 1, 3), now));
  ASSERT_TRUE(channel.submit(getAttribute(2, 101, 1, 3), now));
  const auto answer = channel.pollAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(1u, answer->id);
  EXPECT_EQ(ExplicitEnd::kTooLong, answer->end);
  CanFrame sent;
  ASSERT_TRUE(channel.pollTransmit(sent, now));
  EXPECT_EQ("42C#400E650103", text(sent));
  EXPECT_EQ(Heard::kTaken, channel.handle(frame("42B#408E03"), now));
  channel.ask(getAttribute(0, 0x165, 1, 3), ExplicitPort::kConnected, milliseconds{100}, now);
  const auto own = channel.takeOwnAnswer();
  ASSERT_TRUE(own);
  EXPECT_EQ(ExplicitEnd::kTooLong, own->end);
  EXPECT_FALSE(channel.takeOwnAnswer());
}

// Closed to the layer above, which may be answered late; the engine goes on asking.
TEST(ExplicitChannel, ClosingEndsWhatTheLayerAboveAsked) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  ASSERT_TRUE(channel.submit(getAttribute(1, 101, 1, 3), now));
  ASSERT_TRUE(channel.submit(getAttribute(2, 101, 1, 3), now));
  CanFrame sent;
  ASSERT_TRUE(channel.pollTransmit(sent, now));
  channel.close();
  for (const std::uint32_t id : {1u, 2u}) {
    const auto answer = channel.pollAnswer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(id, answer->id);
    EXPECT_EQ(ExplicitEnd::kNotConnected, answer->end);
  }
  EXPECT_EQ(Heard::kStale, channel.handle(frame("42B#408E03"), now));
  EXPECT_FALSE(channel.pollTransmit(sent, now));
  channel.ask(getAttribute(0, 1, 1, 1), ExplicitPort::kConnected, milliseconds{100}, now);
  ASSERT_TRUE(channel.pollTransmit(sent, now));
  channel.close();
  EXPECT_EQ(Heard::kTaken, channel.handle(frame("42B#008E8501"), now));
  const auto own = channel.takeOwnAnswer();
  ASSERT_TRUE(own);
  EXPECT_EQ(389u, own->number());
}

// An explicit connection lives by what is exchanged over it, not by what somebody else's answers look like.
TEST(ExplicitChannel, OnlyAnAnswerTakenIsUse) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  const Instant now{std::chrono::hours{1}};
  channel.open();
  ASSERT_TRUE(channel.submit(getAttribute(1, 101, 1, 3), now));
  CanFrame sent;
  ASSERT_TRUE(channel.pollTransmit(sent, now));
  for (const char* other : {"42B#008E03", "42B#418E03", "42B#40"}) channel.handle(frame(other), now);
  EXPECT_EQ(Instant{}, channel.usedAt());
  EXPECT_EQ(Heard::kTaken, channel.handle(frame("42B#408E03"), now));
  EXPECT_EQ(now, channel.usedAt());
}

}  // namespace
}  // namespace nord_driver::devicenet

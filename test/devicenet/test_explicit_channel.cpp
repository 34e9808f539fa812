#include <gtest/gtest.h>

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

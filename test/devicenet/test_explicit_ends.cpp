// Requests of the explicit connection that end although the device does not let them: what test/explore found.
#include <gtest/gtest.h>

#include "devicenet/explicit_channel.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

// A device that begins its answer anew before each end would keep the connection from everybody.
TEST(ExplicitEnds, AnAnswerBegunAgainAndAgain) {
  ExplicitClient client{0, 5};
  Instant now{std::chrono::hours{1}};
  ASSERT_TRUE(
      client.start(getAttribute(1, 101, 1, 1), ExplicitPort::kConnected, BodyFormat::k8Over8, milliseconds{100}, now));
  CanFrame sent;
  ASSERT_TRUE(client.pollTransmit(sent, now));
  int rounds = 0;
  for (; rounds < 10 && client.busy(); ++rounds) {
    for (const char* fragment : {"42B#C0008E0102030405", "42B#C0410102030405"}) {
      client.handle(frame(fragment), now);
      now += milliseconds{500};
      client.poll(now);
      while (client.pollTransmit(sent, now)) {
      }
      const auto answer = client.takeAnswer();
      EXPECT_TRUE(!answer || answer->end == ExplicitEnd::kTimedOut);
    }
  }
  EXPECT_EQ(2, rounds);  // 1.2 s from the second fragment of the first round on
}

// Each part of a fragmented answer that is new gives the next one its time, be it one byte long.
TEST(ExplicitEnds, AFirstFragmentOfOneByteIsAPart) {
  ExplicitClient client{0, 5};
  Instant now{std::chrono::hours{1}};
  ASSERT_TRUE(
      client.start(getAttribute(1, 101, 1, 1), ExplicitPort::kConnected, BodyFormat::k8Over8, milliseconds{100}, now));
  CanFrame sent;
  ASSERT_TRUE(client.pollTransmit(sent, now));
  now += milliseconds{90};
  EXPECT_EQ(Heard::kTaken, client.handle(frame("42B#C0008E"), now));
  now += milliseconds{1100};  // the device repeats after a second what was not acknowledged
  client.poll(now);
  EXPECT_EQ(Heard::kTaken, client.handle(frame("42B#C0810102"), now));
  const auto answer = client.takeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(ExplicitEnd::kDone, answer->end);
  EXPECT_EQ("01 02", toHex(answer->data));
}

// A frame that was put back is not sent when its request has ended meanwhile: a write would be done after its asker was
// told that it was not.
TEST(ExplicitEnds, WhatWasNotSentBeforeTheTimeOutIsNeverSent) {
  ExplicitChannel channel{0, 5, milliseconds{100}};
  Instant now{std::chrono::hours{1}};
  channel.open();
  ASSERT_TRUE(channel.submit(getAttribute(1, 101, 1, 1), now));
  CanFrame sent;
  for (int i = 0; i < 4; ++i) {
    if (channel.pollTransmit(sent, now)) channel.notSent(sent);
    now += milliseconds{101};
    channel.poll(now);
  }
  const auto answer = channel.pollAnswer();
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(ExplicitEnd::kTimedOut, answer->end);
  EXPECT_FALSE(channel.pollTransmit(sent, now));
}

}  // namespace
}  // namespace nord_driver::devicenet

// The process data of one device, beside its connecting: to the millisecond what is due, and what is not taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "devicenet/io_connection.h"
#include "devicenet/scanner_run.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;

constexpr Duration kCycle = milliseconds{10};
constexpr Duration kRate = milliseconds{30};
constexpr Duration kMoment = Duration{1};
constexpr const char* kSent = "42D#0102030405";

/// MAC id 5, five bytes each way; given up after 120 ms.
struct Connected {
  explicit Connected(IoKind kind, std::size_t out = 5, bool acknowledge = true) : config{nodeConfig(5, kind, 5, out)} {
    config.io.acknowledge = acknowledge;
  }
  void setOutput() { io.setOutput(std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}); }
  void establish() {
    io.establish(kRate, now);
    setOutput();
  }
  /// What a cycle that begins now sends.
  std::string cycle() {
    io.startCycle(now);
    CanFrame sent;
    return io.pollOutput(sent, now) ? text(sent) : "";
  }
  void hear(Group1 message, const std::string& candump) {
    io.handle(static_cast<std::uint8_t>(message), frame(candump), now);
  }
  const NodeCounters& counted() const { return report.status().counters; }

  NodeConfig config;
  Counters counters;
  DevicenetEvents events;
  NodeReport report{0, counters, events};
  IoConnection io{config, kCycle, report};
  Instant now{std::chrono::hours{1}};
};

// While it is being connected nothing is sent, taken or missed, and what was to be sent before is forgotten.
TEST(IoConnection, BeforeItIsEstablishedNothingHappens) {
  Connected one{IoKind::kPoll};
  one.setOutput();
  one.io.hurry();
  EXPECT_EQ("", one.cycle());
  EXPECT_TRUE(one.io.poll(one.now)) << "nobody can be lost";
  one.hear(Group1::kPollResponse, "3C5#0102030405");
  one.hear(Group1::kPollResponse, "3C5#01");
  EXPECT_EQ(0u, one.io.input().count);
  EXPECT_EQ(0u, one.counted().malformed);
  EXPECT_EQ(Instant{}, one.report.status().heard_at);
  EXPECT_FALSE(one.io.nextDeadline());
  one.io.establish(kRate, one.now);
  EXPECT_EQ("", one.cycle());
  one.setOutput();
  EXPECT_EQ(kSent, one.cycle());
}

// The bit that a device got before it was lost is not the first one it gets afterwards.
TEST(IoConnection, TheBitOfAStrobeIsForgottenWithTheConnection) {
  Connected one{IoKind::kStrobe, 0};
  one.io.establish(kRate, one.now);
  one.io.setOutput(std::array<std::uint8_t, 1>{1});
  ASSERT_TRUE(one.io.strobeBit());
  one.io.close();
  one.io.establish(kRate, one.now);
  EXPECT_FALSE(one.io.strobeBit());
}

TEST(IoConnection, TakesTheMessagesOfItsKind) {
  const auto taken = [](IoKind kind, std::size_t out, bool acknowledge) {
    const Connected one{kind, out, acknowledge};
    std::string all;
    if (one.io.takes(Group1::kMulticastPollResponse)) all += "C";
    if (one.io.takes(Group1::kChangeOfStateOrCyclic)) all += "D";
    if (one.io.takes(Group1::kStrobeResponse)) all += "E";
    if (one.io.takes(Group1::kPollResponse)) all += "F";
    return all;
  };
  EXPECT_EQ("", taken(IoKind::kNone, 5, true));
  EXPECT_EQ("F", taken(IoKind::kPoll, 5, true));
  EXPECT_EQ("E", taken(IoKind::kStrobe, 0, true));
  EXPECT_EQ("EF", taken(IoKind::kStrobe, 5, true)) << "its outputs are polled";
  for (const IoKind kind : {IoKind::kChangeOfState, IoKind::kCyclic}) {
    EXPECT_EQ("DF", taken(kind, 5, true));
    EXPECT_EQ("D", taken(kind, 5, false)) << "nobody acknowledges";
  }
}

// In the last cycle that begins within the rate, not in the one before.
TEST(IoConnection, ACyclicMessageGoesOutOnceARate) {
  Connected one{IoKind::kCyclic};
  one.establish();
  EXPECT_EQ(kSent, one.cycle());
  for (int i = 0; i < 2; ++i) {
    one.now += kCycle;
    EXPECT_EQ("", one.cycle());
  }
  one.now += kCycle;
  EXPECT_EQ(kSent, one.cycle());
  one.now += 2 * kCycle + kMoment;
  EXPECT_EQ(kSent, one.cycle()) << "the next one would be too late";
}

// From four times the rate on the device has given up, and nothing reaches it any more.
TEST(IoConnection, WhatIsLateIsNotSent) {
  Connected in_time{IoKind::kPoll}, late{IoKind::kPoll};
  for (Connected* one : {&in_time, &late}) {
    one->establish();
    EXPECT_EQ(kSent, one->cycle());
  }
  in_time.now += 4 * kRate - kMoment;
  EXPECT_EQ(kSent, in_time.cycle());
  EXPECT_EQ(1u, in_time.counted().missed);
  late.now += 4 * kRate;
  EXPECT_EQ("", late.cycle());
  EXPECT_FALSE(late.io.poll(late.now));
  EXPECT_STREQ("was sent nothing for more than 120 ms, four times its expected packet rate",
               late.io.lossText().c_str());
}

// The oldest command without an answer counts, and the patience that is configured.
TEST(IoConnection, ASilentDeviceIsLostAfterItsTimeOut) {
  Connected one{IoKind::kPoll};
  one.config.io.timeout = milliseconds{25};
  one.establish();
  EXPECT_EQ(kSent, one.cycle());
  for (int i = 0; i < 2; ++i) {
    one.now += kCycle;
    EXPECT_EQ(kSent, one.cycle());
  }
  one.now += milliseconds{5} - kMoment;
  EXPECT_TRUE(one.io.poll(one.now));
  one.now += kMoment;
  EXPECT_FALSE(one.io.poll(one.now));
  EXPECT_STREQ("gave no answer to our commands for 25 ms", one.io.lossText().c_str());
}

// A frame with data is none; without one for 20 ms the message goes out once more.
TEST(IoConnection, AnAcknowledgeHasNoData) {
  for (const bool right : {false, true}) {
    Connected one{IoKind::kChangeOfState};
    one.establish();
    EXPECT_EQ(kSent, one.cycle());
    one.hear(Group1::kPollResponse, right ? "3C5#" : "3C5#00");
    EXPECT_EQ(right ? 0u : 1u, one.counted().malformed);
    one.now += milliseconds{20} - kMoment;
    EXPECT_TRUE(one.io.poll(one.now));
    EXPECT_EQ(0u, one.counted().unacknowledged);
    one.now += kMoment;
    EXPECT_TRUE(one.io.poll(one.now));
    EXPECT_EQ(right ? 0u : 1u, one.counted().unacknowledged);
    CanFrame sent;
    EXPECT_EQ(!right, one.io.pollOutput(sent, one.now));
  }
}

// What changes in each cycle is never repeated: the message before it is one nobody acknowledged all the same.
TEST(IoConnection, AMessageThatANewerOneFollowsUnacknowledgedIsCounted) {
  for (const bool acknowledged : {false, true}) {
    Connected one{IoKind::kChangeOfState};
    one.establish();
    EXPECT_EQ(kSent, one.cycle());
    if (acknowledged) one.hear(Group1::kPollResponse, "3C5#");
    one.now += kCycle;
    one.io.setOutput(std::array<std::uint8_t, 5>{1, 2, 3, 4, 6});
    EXPECT_EQ("42D#0102030406", one.cycle());
    EXPECT_EQ(acknowledged ? 0u : 1u, one.counted().missed);
    EXPECT_EQ(0u, one.counted().unacknowledged);
  }
}

// Beside a bit strobe: empty or as long as the inputs, which are those of the strobe.
TEST(IoConnection, TheAnswerToAPollBesideAStrobe) {
  Connected one{IoKind::kStrobe};
  one.establish();
  for (const char* answer : {"3C5#", "3C5#0102030405"}) one.hear(Group1::kPollResponse, answer);
  EXPECT_EQ(0u, one.counted().malformed);
  EXPECT_EQ(one.now, one.report.status().heard_at);
  for (const char* wrong : {"3C5#01020304", "3C5#010203040506"}) one.hear(Group1::kPollResponse, wrong);
  EXPECT_EQ(2u, one.counted().malformed);
  EXPECT_EQ(0u, one.io.input().count);
}

// The strobe's answer brings the inputs, whether the one to the poll has come or not.
TEST(IoConnection, AnAnswerThatIsMissingBesideAStrobeIsCounted) {
  Connected one{IoKind::kStrobe};
  one.establish();
  for (const unsigned missed : {0u, 0u, 1u, 1u}) {
    EXPECT_EQ(kSent, one.cycle());
    EXPECT_EQ(missed, one.counted().missed);
    one.io.noteStrobed(one.now);
    one.hear(Group1::kStrobeResponse, "385#0102030405");
    const bool is_lost = one.now == Instant{std::chrono::hours{1}} + kCycle;
    if (!is_lost) one.hear(Group1::kPollResponse, "3C5#0102030405");
    one.now += kCycle;
  }
  EXPECT_TRUE(one.io.poll(one.now));
}

// Ours goes out once for each message, and again when the link had no room for it.
TEST(IoConnection, AcknowledgesWhatItHasTaken) {
  Connected one{IoKind::kChangeOfState};
  one.establish();
  CanFrame sent;
  EXPECT_FALSE(one.io.pollAcknowledge(sent));
  one.hear(Group1::kChangeOfStateOrCyclic, "345#01020304");
  EXPECT_FALSE(one.io.pollAcknowledge(sent)) << "too short";
  one.hear(Group1::kChangeOfStateOrCyclic, "345#0102030405");
  ASSERT_TRUE(one.io.pollAcknowledge(sent));
  EXPECT_EQ("42A#", text(sent));
  EXPECT_FALSE(one.io.pollAcknowledge(sent));
  one.io.acknowledgeNotSent();
  EXPECT_TRUE(one.io.pollAcknowledge(sent));
  Connected suppressed{IoKind::kChangeOfState, 5, false};
  suppressed.establish();
  suppressed.hear(Group1::kChangeOfStateOrCyclic, "345#0102030405");
  EXPECT_EQ(1u, suppressed.io.input().count);
  EXPECT_FALSE(suppressed.io.pollAcknowledge(sent));
}

// Given out and refused by the link: it does not count as sent, and the next cycle sends it, changed or not.
TEST(IoConnection, AMessageThatWasNotSentIsCountedBack) {
  Connected one{IoKind::kChangeOfState};
  one.establish();
  EXPECT_EQ(kSent, one.cycle());
  EXPECT_EQ(1u, one.counted().outputs);
  one.io.outputNotSent();
  EXPECT_EQ(0u, one.counted().outputs);
  EXPECT_EQ(1u, one.counted().superseded);
  EXPECT_EQ(1u, one.counters.superseded);
  one.now += kCycle;
  EXPECT_EQ(kSent, one.cycle());
  one.now += kCycle;
  EXPECT_EQ("", one.cycle()) << "unchanged";
}

// What was not sent needs no answer, and no acknowledge; what was sent before it still does.
TEST(IoConnection, OfAMessageThatWasNotSentNoAnswerIsMissed) {
  Connected polled{IoKind::kPoll};
  polled.establish();
  polled.cycle();
  polled.now += kCycle;
  polled.cycle();
  ASSERT_EQ(1u, polled.counted().missed) << "of the first poll";
  polled.io.outputNotSent();
  polled.now += kCycle;
  polled.cycle();
  EXPECT_EQ(1u, polled.counted().missed);
  polled.now += kCycle;
  polled.cycle();
  EXPECT_EQ(2u, polled.counted().missed) << "of the third";

  Connected told{IoKind::kChangeOfState};
  told.establish();
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(kSent, told.cycle());
    told.io.outputNotSent();
    told.now += kCycle;
  }
  EXPECT_EQ(0u, told.counted().missed);
  told.io.poll(told.now + kRate);
  EXPECT_EQ(0u, told.counted().unacknowledged);
}

// The device is not to be blamed for what did not reach it.
TEST(IoConnection, WithoutRoomForItsMessagesItIsLostForThat) {
  Connected one{IoKind::kPoll};
  one.establish();
  one.cycle();
  one.hear(Group1::kPollResponse, "3C5#0102030405");
  const Instant sent = one.now;
  while (one.now - sent < 4 * kRate) {
    one.now += kCycle;
    ASSERT_TRUE(one.io.poll(one.now));
    if (one.cycle() == kSent) one.io.outputNotSent();
  }
  EXPECT_EQ(0u, one.counted().missed);
  ASSERT_FALSE(one.io.poll(one.now));
  EXPECT_THAT(one.io.lossText().c_str(), testing::HasSubstr("was sent nothing"));
}

}  // namespace
}  // namespace nord_driver::devicenet

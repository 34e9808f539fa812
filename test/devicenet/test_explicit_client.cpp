#include <gtest/gtest.h>

#include "devicenet/explicit_client.h"
#include "support/can_text.h"

namespace nord_driver::devicenet {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A client with MAC id 10 of the device 9, as in the golden vectors of facts 3.3.
class ExplicitClientTest : public testing::Test {
 protected:
  static constexpr Duration kTimeout = milliseconds{200};

  std::string sent() {
    CanFrame out;
    return client.pollTransmit(out, now) ? text(out) : "";
  }
  Heard hear(const std::string& candump) { return client.handle(frame(candump), now); }
  void pass(Duration span) {
    now += span;
    client.poll(now);
  }
  /// Starts a request whose transaction id is 0 next.
  bool ask(const ExplicitRequest& request, ExplicitPort port = ExplicitPort::kConnected,
           BodyFormat format = BodyFormat::k8Over8) {
    return client.start(request, port, format, kTimeout, now);
  }
  /// Toggles the transaction id.
  void another() {
    ask(getAttribute(0, 1, 1, 1));
    client.cancel();
  }

  ExplicitClient client{10, 9};
  Instant now{std::chrono::hours{1}};
};

ExplicitRequest allocate() {
  ExplicitRequest request;
  request.service = service::kAllocate;
  request.class_id = 3;
  request.instance = 1;
  request.data = {0x07, 0x0A};
  return request;
}

ExplicitRequest longWrite() {
  const std::vector<std::uint8_t> data{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  return setAttribute(5, 4, 100, 3, ByteView{data});
}

// Facts 3.3, ICP DAS: 44E `0A 4B 03 01 07 0A` -> 44B `0A CB 00`.
TEST_F(ExplicitClientTest, Allocate) {
  another();
  ASSERT_TRUE(ask(allocate(), ExplicitPort::kUnconnected));
  EXPECT_EQ("44E#0A4B0301070A", sent());
  EXPECT_EQ("", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#0ACB00"));
  const auto answer = client.takeAnswer();
  ASSERT_TRUE(answer && answer->ok());
  EXPECT_EQ(0u, answer->number());
}

// 44C `0A 10 05 02 09 0A 0E` -> 44B `0A 90 10 0E`.
TEST_F(ExplicitClientTest, ExpectedPacketRateComesBackRounded) {
  another();
  const std::array<std::uint8_t, 2> rate{0x0A, 0x0E};
  ASSERT_TRUE(ask(setAttribute(1, 5, 2, 9, rate)));
  EXPECT_EQ("44C#0A100502090A0E", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#0A90100E"));
  EXPECT_EQ(0x0E10u, client.takeAnswer()->number());
}

// BU 0280 4.3.9: FI 1, P103, sub-index 0 is class 101, attribute 3, instance 1.
TEST_F(ExplicitClientTest, ParameterAndErrors) {
  ASSERT_TRUE(ask(getAttribute(3, 101, 1, 3)));
  EXPECT_EQ("44C#4A0E650103", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#4A9402FF"));
  const auto answer = client.takeAnswer();
  EXPECT_EQ(ExplicitEnd::kRefused, answer->end);
  EXPECT_EQ(3u, answer->id);
  EXPECT_EQ(0x02, answer->general);
  EXPECT_STREQ("refuses: a resource that is needed is unavailable (02h)",
               explicitText(*answer, service::kGetAttributeSingle).c_str());
}

TEST_F(ExplicitClientTest, OtherBodyFormats) {
  ASSERT_TRUE(ask(getAttribute(0, 0x165, 0x201, 3), ExplicitPort::kConnected, BodyFormat::k16Over16));
  EXPECT_EQ("44C#4A0E6501010203", sent());
  client.cancel();
  EXPECT_FALSE(ask(getAttribute(0, 0x165, 1, 3))) << "8/8 has no room for it";
}

// What does not belong to the question is not taken for its answer.
TEST_F(ExplicitClientTest, WhatIsNotItsAnswer) {
  EXPECT_EQ(Heard::kStale, hear("44B#4A8E00")) << "nobody asked";
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 1)));
  EXPECT_EQ(Heard::kStale, hear("44B#4A8E00")) << "not sent yet";
  sent();
  EXPECT_EQ(Heard::kStale, hear("44B#0A8E0000")) << "the transaction before";
  EXPECT_EQ(Heard::kForeign, hear("44B#4B8E0000")) << "to MAC id 11";
  EXPECT_EQ(Heard::kStale, hear("44B#4A900000")) << "another service";
  EXPECT_EQ(Heard::kMalformed, hear("44B#4A0E0101")) << "a request";
  EXPECT_EQ(Heard::kMalformed, hear("44B#4A94")) << "an error without its codes";
  EXPECT_EQ(Heard::kMalformed, hear("44B#4A9402"));
  EXPECT_EQ(Heard::kMalformed, hear("44B#4A940201FF"));
  EXPECT_EQ(Heard::kMalformed, hear("44B#4A"));
  EXPECT_EQ(Heard::kMalformed, hear("44B#"));
  EXPECT_EQ(Heard::kMalformed, hear("44B#CA00"));
  EXPECT_FALSE(client.takeAnswer());
  EXPECT_EQ(Heard::kTaken, hear("44B#4A8E8501"));
  EXPECT_EQ(389u, client.takeAnswer()->number());
  EXPECT_EQ(Heard::kStale, hear("44B#4A8E8501")) << "twice";
}

// Asked twice, then given up. A reset is never done twice.
TEST_F(ExplicitClientTest, RepeatsOnce) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 1)));
  EXPECT_EQ("44C#4A0E010101", sent());
  pass(milliseconds{199});
  EXPECT_EQ("", sent());
  pass(milliseconds{1});
  EXPECT_EQ("44C#4A0E010101", sent()) << "the same transaction";
  pass(milliseconds{199});
  EXPECT_FALSE(client.takeAnswer());
  pass(milliseconds{1});
  EXPECT_EQ(ExplicitEnd::kTimedOut, client.takeAnswer()->end);
  EXPECT_EQ("", sent());

  ExplicitRequest reset;
  reset.service = service::kReset;
  reset.class_id = reset.instance = 1;
  ASSERT_TRUE(ask(reset));
  EXPECT_EQ("44C#0A050101", sent());
  pass(kTimeout);
  EXPECT_EQ("", sent());
  EXPECT_EQ(ExplicitEnd::kTimedOut, client.takeAnswer()->end);
  EXPECT_EQ(1u, client.repeated());
}

// An answer that comes just before its question is repeated: the repetition is not sent.
TEST_F(ExplicitClientTest, LateAnswerStopsTheRepetition) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 1)));
  sent();
  pass(kTimeout);
  EXPECT_EQ(Heard::kTaken, hear("44B#4A8E8501"));
  EXPECT_EQ("", sent());
  EXPECT_TRUE(client.takeAnswer()->ok());
}

// More than a frame: six bytes of the message in each, each acknowledged.
TEST_F(ExplicitClientTest, FragmentedRequest) {
  ASSERT_TRUE(ask(longWrite()));
  EXPECT_EQ("44C#CA00100464030102", sent());
  EXPECT_EQ("", sent()) << "not before its acknowledge";
  EXPECT_EQ(Heard::kStale, hear("44B#CAC100")) << "of another fragment";
  EXPECT_EQ(Heard::kTaken, hear("44B#CAC000"));
  EXPECT_EQ("44C#CA41030405060708", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#CAC100"));
  EXPECT_EQ("44C#CA82090A0B", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#CAC200"));
  EXPECT_EQ(Heard::kTaken, hear("44B#4A90"));
  EXPECT_TRUE(client.takeAnswer()->ok());
}

// Seven bytes fit into one frame, eight are two fragments.
TEST_F(ExplicitClientTest, Borders) {
  const std::vector<std::uint8_t> data{1, 2, 3, 4};
  ASSERT_TRUE(ask(setAttribute(0, 4, 100, 3, ByteView{data}.sub(0, 3))));
  EXPECT_EQ("44C#4A10046403010203", sent());
  client.cancel();
  ASSERT_TRUE(ask(setAttribute(0, 4, 100, 3, ByteView{data})));
  EXPECT_EQ("44C#8A00100464030102", sent());
  hear("44B#8AC000");
  EXPECT_EQ("44C#8A810304", sent());
}

// An acknowledge that does not come: repeated after a second, once, then given up.
TEST_F(ExplicitClientTest, FragmentIsRepeatedOnce) {
  ASSERT_TRUE(ask(longWrite()));
  sent();
  pass(milliseconds{999});
  EXPECT_EQ("", sent());
  pass(milliseconds{1});
  EXPECT_EQ("44C#CA00100464030102", sent());
  hear("44B#CAC000");
  EXPECT_EQ("44C#CA41030405060708", sent()) << "each has a repetition of its own";
  pass(seconds{1});
  EXPECT_EQ("44C#CA41030405060708", sent());
  pass(seconds{1});
  EXPECT_EQ(ExplicitEnd::kTimedOut, client.takeAnswer()->end);
}

// The device has no room.
TEST_F(ExplicitClientTest, TooMuchData) {
  ASSERT_TRUE(ask(longWrite()));
  sent();
  EXPECT_EQ(Heard::kTaken, hear("44B#CAC001"));
  EXPECT_EQ(ExplicitEnd::kTooLong, client.takeAnswer()->end);
  EXPECT_EQ("", sent());
}

// The last acknowledge is lost; the answer says the same.
TEST_F(ExplicitClientTest, AnswerInPlaceOfTheLastAcknowledge) {
  const std::vector<std::uint8_t> data{1, 2, 3, 4};
  ASSERT_TRUE(ask(setAttribute(0, 4, 100, 3, ByteView{data})));
  sent();
  EXPECT_EQ(Heard::kStale, hear("44B#4A90")) << "not after the first of two";
  hear("44B#CAC000");
  sent();
  EXPECT_EQ(Heard::kTaken, hear("44B#4A90"));
  EXPECT_TRUE(client.takeAnswer()->ok());
}

// Each fragment of the answer is acknowledged, one that comes twice too, and stored once.
TEST_F(ExplicitClientTest, FragmentedAnswer) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 7)));
  sent();
  EXPECT_EQ(Heard::kTaken, hear("44B#CA008E0A534B2043"));
  EXPECT_EQ("44C#CAC000", sent());
  EXPECT_EQ(Heard::kStale, hear("44B#CA008E0A534B2043")) << "its acknowledge was lost";
  EXPECT_EQ("44C#CAC000", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#CA415534"));
  EXPECT_EQ("44C#CAC100", sent());
  EXPECT_EQ(Heard::kStale, hear("44B#CA83444556")) << "a gap is not acknowledged";
  EXPECT_EQ("", sent());
  EXPECT_EQ(Heard::kTaken, hear("44B#CA822D444556"));
  EXPECT_EQ("44C#CAC200", sent());
  const auto answer = client.takeAnswer();
  ASSERT_TRUE(answer && answer->ok());
  EXPECT_EQ("0A 53 4B 20 43 55 34 2D 44 45 56", toHex(ByteView{answer->data}));
  EXPECT_EQ(Heard::kStale, hear("44B#CA822D444556")) << "over, but its acknowledge was lost";
  EXPECT_EQ("44C#CAC200", sent());
}

// The device stops in the middle: over after the time in which it would have repeated.
TEST_F(ExplicitClientTest, AnswerThatStops) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 7)));
  sent();
  hear("44B#CA008E0A534B2043");
  sent();
  pass(milliseconds{1100});
  EXPECT_FALSE(client.takeAnswer());
  pass(milliseconds{100});
  EXPECT_EQ(ExplicitEnd::kTimedOut, client.takeAnswer()->end);
}

// An answer that never ends: refused with "too much data" when there is no room left, whatever else comes.
TEST_F(ExplicitClientTest, AnswerThatNeverEnds) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 7)));
  sent();
  hear("44B#CA008E0A534B2043");
  std::string last;
  for (unsigned count = 1; count < 100; ++count) {
    char fragment[32];
    std::snprintf(fragment, sizeof fragment, "44B#CA%02X010203040506", 0x40u | (count & 0x3Fu));
    hear(fragment);
    const std::string out = sent();
    if (!out.empty()) last = out;
  }
  EXPECT_EQ("01", last.substr(last.size() - 2)) << last;
  EXPECT_EQ(ExplicitEnd::kTooLong, client.takeAnswer()->end);
  EXPECT_FALSE(client.busy());
}

// The answer to an allocation has no fragments: what looks like one does not prolong the wait for it.
TEST_F(ExplicitClientTest, AnAllocationIsNotAnsweredInFragments) {
  ASSERT_TRUE(ask(allocate(), ExplicitPort::kUnconnected));
  EXPECT_EQ("44E#4A4B0301070A", sent());
  EXPECT_EQ(Heard::kStale, hear("44B#CA00CB0000000000"));
  pass(kTimeout);
  EXPECT_EQ("44E#4A4B0301070A", sent());
  pass(kTimeout);
  const auto answer = client.takeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(ExplicitEnd::kTimedOut, answer->end);
}

// Empty fragments could go on for ever without filling anything.
TEST_F(ExplicitClientTest, EmptyFragmentsKeepNothingAlive) {
  ASSERT_TRUE(ask(getAttribute(0, 1, 1, 7)));
  sent();
  hear("44B#CA008E0A");
  for (int i = 1; i < 63 && client.busy(); ++i) {
    char fragment[16];
    std::snprintf(fragment, sizeof fragment, "44B#CA%02X", 0x40u | static_cast<unsigned>(i));
    hear(fragment);
    pass(milliseconds{100});
    if (client.takeAnswer()) break;
  }
  EXPECT_FALSE(client.busy());
}

}  // namespace
}  // namespace nord_driver::devicenet

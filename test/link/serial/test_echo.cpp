#include "link/serial/echo_filter.h"
#include "link/serial/port_fixture.h"

namespace nord_driver::link {
namespace {

using std::chrono::milliseconds;

// Data exchange of master 1 with station 8: the request and the answer agree in their first four bytes.
const std::vector<std::uint8_t> kRequest = fromHex("68 05 05 68 08 01 5D 04 7E E8 16");
const std::vector<std::uint8_t> kAnswer = fromHex("68 05 05 68 01 08 08 0B 31 4D 16");

std::vector<std::uint8_t> joined(std::vector<std::uint8_t> first, const std::vector<std::uint8_t>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

class Echo : public PortFixture {
 protected:
  Bytes exchange(SerialPort& port, std::deque<Bytes> heard, std::size_t capacity = 64) {
    EXPECT_TRUE(port.write(kRequest));
    for (Bytes& chunk : heard) system.incoming.push_back(std::move(chunk));
    return everything(port, capacity);
  }
  SerialPort openPort(EchoMode mode) {
    settings.echo = mode;
    return SerialPort{settings, system};
  }
};

TEST_F(Echo, OffHandsEverythingOn) {
  SerialPort port = openPort(EchoMode::kOff);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(joined(kRequest, kAnswer), exchange(port, {kRequest, kAnswer}));
  EXPECT_EQ(0u, port.lineCounters().collisions);
}

// A simulated bus has none, whatever the robot's adapter does: no telegram is a collision there.
TEST_F(Echo, OnExpectsNoneOfAPty) {
  system.devices["/dev/ttyUSB0"] = DeviceKind::kPty;
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(0u, port.lineCounters().collisions);
}

// However the bytes come in, exactly the echo is taken out.
TEST_F(Echo, OnTakesTheEchoOutHoweverItIsCut) {
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  const Bytes heard = joined(kRequest, kAnswer);
  for (std::size_t cut = 1; cut < heard.size(); ++cut) {
    const auto at = heard.begin() + static_cast<std::ptrdiff_t>(cut);
    EXPECT_EQ(kAnswer, exchange(port, {Bytes(heard.begin(), at), Bytes(at, heard.end())})) << cut;
  }
  EXPECT_EQ(0u, port.lineCounters().collisions);
}

// An answer larger than the reader's buffer is handed out in pieces.
TEST_F(Echo, ASmallReaderGetsEverything) {
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(kAnswer, exchange(port, {joined(kRequest, kAnswer)}, 3));
}

// The echo alone wakes nobody: the answer does, or the end of the slot.
TEST_F(Echo, WaitingGoesOnBehindTheEcho) {
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  ASSERT_TRUE(port.write(kRequest));
  system.incoming = {kRequest};
  const Instant until = port.now() + milliseconds{3};
  EXPECT_FALSE(port.waitReadable(until));
  EXPECT_EQ(until, port.now());
  system.incoming = {kAnswer};
  EXPECT_TRUE(port.waitReadable(port.now() + milliseconds{3}));
}

// Somebody spoke into our telegram: one collision, and what was heard goes on unchanged.
TEST_F(Echo, ADifferenceIsACollision) {
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  Bytes heard = kRequest;
  heard[6] ^= 0x20;
  EXPECT_EQ(heard, exchange(port, {heard}));
  EXPECT_EQ(1u, port.lineCounters().collisions);
  EXPECT_EQ(kAnswer, exchange(port, {kRequest, kAnswer})) << "the next one is sound";
  EXPECT_EQ(1u, port.lineCounters().collisions);
}

// An answer without an echo is not lost, though it begins like one.
TEST_F(Echo, AMissingEchoIsACollisionToo) {
  SerialPort port = openPort(EchoMode::kOn);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(1u, port.lineCounters().collisions);
  EXPECT_EQ(Bytes{}, exchange(port, {}));
  EXPECT_EQ(kAnswer, exchange(port, {kRequest, kAnswer}));
  EXPECT_EQ(2u, port.lineCounters().collisions);
}

TEST_F(Echo, AutoFindsTheEcho) {
  SerialPort port = openPort(EchoMode::kAuto);
  ASSERT_TRUE(port.open());
  system.echoes = true;
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(0u, port.lineCounters().collisions);
  system.echoes = false;
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(1u, port.lineCounters().collisions) << "once found it is expected";
}

TEST_F(Echo, AutoFindsThatThereIsNone) {
  SerialPort port = openPort(EchoMode::kAuto);
  ASSERT_TRUE(port.open());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(kAnswer, exchange(port, {kAnswer})) << i;
  EXPECT_EQ(kRequest, exchange(port, {kRequest})) << "decided: everything is handed on";
  EXPECT_EQ(0u, port.lineCounters().collisions);
}

// Noise in the first answers does not hide an echo for good.
TEST_F(Echo, AutoSurvivesNoise) {
  SerialPort port = openPort(EchoMode::kAuto);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(joined({0xFF}, kRequest), exchange(port, {{0xFF}, kRequest}));
  EXPECT_EQ(Bytes{}, exchange(port, {})) << "silence says nothing";
  EXPECT_EQ(kAnswer, exchange(port, {kRequest, kAnswer}));
}

// Another adapter may have been plugged in.
TEST_F(Echo, AutoDecidesAgainAfterEveryOpening) {
  SerialPort port = openPort(EchoMode::kAuto);
  ASSERT_TRUE(port.open());
  EXPECT_EQ(kAnswer, exchange(port, {kRequest, kAnswer}));
  ASSERT_TRUE(port.open());
  EXPECT_EQ(kAnswer, exchange(port, {kAnswer}));
  EXPECT_EQ(0u, port.lineCounters().collisions);
}

// The longest telegram, whose last byte comes back wrong behind a full chunk.
TEST_F(Echo, TheLongestTelegramIsGivenBackWhole) {
  EchoFilter filter{EchoMode::kOn};
  Bytes telegram(EchoFilter::kLongestTelegram, 0x55);
  Bytes heard = telegram;
  heard.back() = 0x54;
  heard.resize(EchoFilter::kLongestTelegram + 1 + EchoFilter::kLongestChunk - 2, 0x77);
  filter.sent(telegram);
  filter.heard({heard.data(), EchoFilter::kLongestTelegram - 1});
  EXPECT_FALSE(filter.hasBytes());
  filter.heard({heard.data() + EchoFilter::kLongestTelegram - 1, EchoFilter::kLongestChunk});
  Bytes back(1000);
  back.resize(filter.take(back.data(), back.size()));
  EXPECT_EQ(heard, back);
  EXPECT_EQ(1u, filter.collisions());
}

}  // namespace
}  // namespace nord_driver::link

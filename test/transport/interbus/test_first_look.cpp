// What a gateway shows before the first word of DRIVECOM is written, which has none that the inverter ignores.
#include <gtest/gtest.h>

#include "profile/status_word.h"
#include "transport/interbus/fake_gateway.h"
#include "transport/interbus/interbus.h"
#include "transport/interbus/interbus_settings.h"

namespace nord_driver {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kCycle{10};
constexpr Word kFault = 0x0238, kReadyWord = 0x0231;

class FirstLookTest : public ::testing::Test {
 protected:
  FirstLookTest() : words{kReadyWord, 0, 0x0B31, 0} {
    gateway.ring = [this](const RegisterImage&) { return words; };
    settings.drive(0).set("profile", "drivecom");
  }
  void start() {
    transport.configure(settings.bus, settings.drives, 100.0);
    transport.setDriveTimeout(milliseconds{50});
    outputs.assign(settings.drives.size(), {});
    inputs.resize(settings.drives.size());
  }
  void cycle() {
    const Instant begin = transport.now();
    transport.exchange(outputs, inputs);
    transport.sleepUntil(begin + kCycle);
  }
  /// How many cycles until words are written; at most a hundred.
  int cyclesUntilWritten() {
    int count = 0;
    while (gateway.given.empty() && count < 100) {
      cycle();
      ++count;
    }
    return count;
  }

  test::InterbusSettings settings{2};
  test::FakeGateway gateway;
  RegisterImage words;  // what the ring answers
  InterbusTransport transport{
      [this](const link::ModbusSettings&) { return std::make_unique<test::FakeRegisterLink>(gateway); }};
  std::vector<profile::ProcessOutput> outputs;
  std::vector<DriveExchange> inputs;
};

TEST_F(FirstLookTest, TellsAFaultBeforeTheFirstWord) {
  words[0] = kFault;
  start();
  cycle();
  EXPECT_EQ(1u, gateway.looks);
  EXPECT_TRUE(gateway.given.empty());
  ASSERT_TRUE(inputs[0].inverter_answers);
  EXPECT_TRUE(profile::StatusWord{inputs[0].input.status_word}.fault());
  EXPECT_TRUE(inputs[1].inverter_answers);
  cycle();
  EXPECT_EQ(1u, gateway.looks);
  ASSERT_EQ(1u, gateway.given.size());
  EXPECT_EQ((RegisterImage{0x007E, 0, 0, 0}), gateway.given[0].outputs);
}

// The first word of NORD's is ignored by the inverter: nothing is to be waited for.
TEST_F(FirstLookTest, NordsWordsNeedNone) {
  settings.drive(0).set("profile", "nord");
  start();
  EXPECT_EQ(1, cyclesUntilWritten());
  EXPECT_EQ(0u, gateway.looks);
}

// Who was met before and is lost is a loss to the layers above: what stops it waits for nothing.
TEST_F(FirstLookTest, IsNotTakenAgainAfterALoss) {
  start();
  cycle();
  cycle();
  gateway.state = link::LinkState::kPausing;
  for (int i = 0; i < 20; ++i) cycle();
  gateway.state = link::LinkState::kConnected;
  const std::size_t before = gateway.given.size();
  cycle();
  EXPECT_EQ(before + 1, gateway.given.size());
  EXPECT_EQ(1u, gateway.looks);
}

TEST_F(FirstLookTest, AGatewayThatRefusesToBeReadIsWrittenTo) {
  start();
  gateway.stalled = true;
  gateway.exceptions = 1;  // to the register of the watchdog
  gateway.state = link::LinkState::kConnecting;
  cycle();
  gateway.state = link::LinkState::kConnected;
  cycle();
  cycle();
  EXPECT_EQ(3u, gateway.looks);
  gateway.exceptions = 2;
  gateway.refused_exchanges = 1;
  cycle();
  cycle();
  EXPECT_EQ(4u, gateway.looks);
  EXPECT_EQ(1u, gateway.given.size());
}

// The register of the watchdog was busy: no cycle sees the link connect, which takes a moment, but the pauses and then the
// connection that stands.
TEST_F(FirstLookTest, ARefusedWatchdogIsNoRefusedLook) {
  words[0] = kFault;
  start();
  gateway.state = link::LinkState::kPausing;
  for (gateway.exceptions = 1; gateway.exceptions < 3; ++gateway.exceptions) cycle();
  gateway.state = link::LinkState::kConnected;
  cycle();
  cycle();
  EXPECT_TRUE(gateway.given.empty());
  EXPECT_TRUE(profile::StatusWord{inputs[0].input.status_word}.fault());
  cycle();
  EXPECT_EQ(1u, gateway.given.size());
}

// `response_timeout`, 0.3 s: an inverter may still follow what a driver that was killed has left there.
TEST_F(FirstLookTest, AGatewayThatDoesNotAnswerIsWrittenTo) {
  start();
  gateway.stalled = true;
  const Instant begun = transport.now();
  cyclesUntilWritten();
  EXPECT_GE(gateway.given.at(0).at - begun, milliseconds{300});
  EXPECT_LE(gateway.given.at(0).at - begun, milliseconds{330});
}

// Before there is a connection nothing is looked at, and no time runs.
TEST_F(FirstLookTest, WaitsForAConnection) {
  start();
  gateway.state = link::LinkState::kConnecting;
  for (int i = 0; i < 50; ++i) cycle();
  EXPECT_TRUE(gateway.given.empty());
  gateway.state = link::LinkState::kConnected;
  words[0] = kFault;
  cycle();
  cycle();  // the first one did not wait: what was given before has no answer
  EXPECT_TRUE(gateway.given.empty());
  EXPECT_TRUE(profile::StatusWord{inputs[0].input.status_word}.fault());
  cycle();
  EXPECT_EQ(1u, gateway.given.size());
}

// Nobody can be read while it is gone, and no word would go out: the time begins anew with the next connection.
TEST_F(FirstLookTest, AConnectionThatWasClosedIsLookedAtAnew) {
  start();
  gateway.stalled = true;
  for (int i = 0; i < 20; ++i) cycle();
  gateway.state = link::LinkState::kPausing;
  gateway.lost = 1;
  for (int i = 0; i < 50; ++i) cycle();
  gateway.lost = 20;  // attempts to connect that were refused
  cycle();
  gateway.state = link::LinkState::kConnected;
  for (int i = 0; i < 20; ++i) cycle();
  EXPECT_TRUE(gateway.given.empty());
  gateway.stalled = false;
  words[0] = kFault;
  for (int i = 0; i < 3 && !inputs[0].inverter_answers; ++i) cycle();
  EXPECT_TRUE(gateway.given.empty());
  EXPECT_TRUE(profile::StatusWord{inputs[0].input.status_word}.fault());
  cycle();
  EXPECT_EQ(1u, gateway.given.size());
}

// It may close each connection because of the look.
TEST_F(FirstLookTest, AGatewayThatClosesEachConnectionIsWrittenTo) {
  start();
  gateway.stalled = true;
  for (int i = 0; i < 100 && gateway.given.empty(); ++i) {
    gateway.lost = static_cast<unsigned>(i / 10);
    gateway.state = i % 10 < 2 ? link::LinkState::kPausing : link::LinkState::kConnected;
    cycle();
  }
  EXPECT_TRUE(gateway.given.empty()) << "ten times it is looked at anew";
  for (int i = 100; i < 150 && gateway.given.empty(); ++i) {
    gateway.lost = static_cast<unsigned>(i / 10);
    gateway.state = i % 10 < 2 ? link::LinkState::kPausing : link::LinkState::kConnected;
    cycle();
  }
  EXPECT_FALSE(gateway.given.empty());
}

// The register of `running` comes over it, and without it there are no inputs: it is waited for, not for ever.
TEST_F(FirstLookTest, ASecondConnectionMayHaveToBeMadeFirst) {
  settings.bus.set("diagnosis", "192.168.0.10:502").set("running/address", 200);
  start();
  gateway.stalled = true;
  const Instant begun = transport.now();
  for (int i = 0; i < 2; ++i) cyclesUntilWritten();
  // `response_timeout` and the 0.8 s an attempt to connect takes.
  EXPECT_GE(gateway.given.at(0).at - begun, milliseconds{1100});
  EXPECT_LE(gateway.given.at(0).at - begun, milliseconds{1130});
}

TEST_F(FirstLookTest, ASecondConnectionThatSaysNothingOfTheRingIsNotWaitedFor) {
  settings.bus.set("diagnosis", "192.168.0.10:502");
  start();
  gateway.stalled = true;
  const Instant begun = transport.now();
  cyclesUntilWritten();
  EXPECT_LE(gateway.given.at(0).at - begun, milliseconds{330});
}

// A ring that stands shows nothing, and the word that stops lies ready for the moment it runs.
TEST_F(FirstLookTest, ARingThatStandsIsWrittenTo) {
  start();
  gateway.ring_runs = false;
  EXPECT_EQ(2, cyclesUntilWritten());
}

}  // namespace
}  // namespace nord_driver

// Words that stop, while a new connection's watchdog cannot be set.
#include <algorithm>

#include "link/modbus/link_fixture.h"

namespace nord_driver::link::test {
namespace {

using std::chrono::milliseconds;

constexpr std::uint16_t kWatchdog = 300;
constexpr Word kRuns = 0x047F, kDownTheRamp = 0x047E, kQuickStop = 0x047B;

class UnwatchedStops : public ModbusLinkTest {
 protected:
  void startWatched(const std::function<void(ModbusSettings&)>& change = {}) {
    ModbusSettings settings = fourWords(server.address());
    settings.control_words = {0, 2};
    settings.run_bits = 0x007F;
    settings.watchdog = WatchdogRegister{kWatchdog, 500};
    settings.first_pause = settings.longest_pause = milliseconds{10};
    if (change) change(settings);
    start(settings);
    ASSERT_TRUE(waitConnected()) << link->report().text.c_str();
  }
  /// The server ends the connection instead of answering `outputs`, which it has taken, and then says "busy" for its
  /// watchdog register.
  void loseWith(const RegisterImage& outputs) {
    const LinkCounters before = link->report().counters;
    server.refuse(kWatchdog);
    server.next({Reaction::kClose});
    link->give(outputs);
    ASSERT_TRUE(waitUntil([&] { return link->report().counters.connections > before.connections; }));
    ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions > before.exceptions; }))
        << link->report().text.c_str();
  }
  bool waitHeld(Word left, Word right) {
    return waitUntil([&] { return server.holding(100) == left && server.holding(102) == right; });
  }
  /// How many images with a control word that runs were written.
  long moved() const {
    const auto requests = server.requests();
    return std::count_if(requests.begin(), requests.end(), [](const Bytes& request) {
      return request[7] == 16 && request[9] == 100 && (request[14] == 0x7F || request[18] == 0x7F);
    });
  }
};

TEST_F(UnwatchedStops, AWordThatStopsDoesNotWaitForTheWatchdog) {
  startWatched();
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  loseWith({kRuns, 8, kRuns, 8});
  const long before = moved();
  const std::uint64_t number = link->take().number;
  link->give({kRuns, 9, kRuns, 9});
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  EXPECT_TRUE(waitHeld(kDownTheRamp, kDownTheRamp)) << link->report().text.c_str();
  // From the ramp to the quick stop is a stop, too.
  link->give({kQuickStop, 0, kQuickStop, 0});
  EXPECT_TRUE(waitHeld(kQuickStop, kQuickStop));
  // What moves waits on, and nobody is told of inputs.
  link->give({kRuns, 9, kRuns, 9});
  const std::uint64_t exceptions = link->report().counters.exceptions;
  EXPECT_TRUE(waitUntil([&] { return link->report().counters.exceptions >= exceptions + 3; }));
  EXPECT_EQ(before, moved());
  EXPECT_EQ(number, link->take().number);
  server.refuse(FakeModbusServer::kRegisters);
  ASSERT_TRUE(waitConnected());
  EXPECT_TRUE(exchange({kRuns, 9, kRuns, 9}));
}

// It comes during the pause after a refusal: that pause is over.
TEST_F(UnwatchedStops, AWordThatStopsEndsThePause) {
  startWatched([](ModbusSettings& settings) {
    settings.first_pause = milliseconds{200};
    settings.longest_pause = kPatience;
  });
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  loseWith({kRuns, 8, kRuns, 8});
  // After the second refusal it lasts for 800 ms.
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions >= 2; }));
  ASSERT_TRUE(waitUntil([&] { return link->report().state == LinkState::kPausing; }));
  const Instant before = link->now();
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  EXPECT_TRUE(waitHeld(kDownTheRamp, kDownTheRamp));
  EXPECT_LT(link->now() - before, milliseconds{500});
}

// The words that stop are refused in due form as the watchdog is: one image is tried once, and does not end the pauses.
TEST_F(UnwatchedStops, AWordThatStopsAndIsRefusedWaitsForThePauses) {
  startWatched([](ModbusSettings& settings) { settings.first_pause = settings.longest_pause = milliseconds{40}; });
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  loseWith({kRuns, 8, kRuns, 8});
  server.always({Reaction::kException, 6});
  const std::uint64_t exceptions = link->report().counters.exceptions;
  const Instant before = link->now();
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions >= exceptions + 8; }));
  // Two of them need no pause: what waited before, and the stop.
  EXPECT_GE(link->now() - before, milliseconds{5 * 40});
  // The next image is tried at once.
  server.always({Reaction::kAnswer});
  link->give({kQuickStop, 0, kQuickStop, 0});
  EXPECT_TRUE(waitHeld(kQuickStop, kQuickStop));
}

// The image that ran was taken, and its answer lost: the server moves the drives, whatever was answered before.
TEST_F(UnwatchedStops, AnImageWhoseAnswerWasLostMayRun) {
  startWatched();
  ASSERT_TRUE(exchange({kDownTheRamp, 0, kDownTheRamp, 0}));
  loseWith({kRuns, 8, kRuns, 8});
  ASSERT_EQ(kRuns, server.holding(100));
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  EXPECT_TRUE(waitHeld(kDownTheRamp, kDownTheRamp)) << link->report().text.c_str();
}

// NORD's 0000 is ignored by a drive that moves, and counts as no valid telegram to one at rest (P513).
TEST_F(UnwatchedStops, AWordThatIsIgnoredIsNoStop) {
  startWatched();
  for (const Word word : {kRuns, kDownTheRamp}) {
    ASSERT_TRUE(waitConnected());
    ASSERT_TRUE(exchange({word, 7, word, 7}));
    loseWith({word, 8, word, 8});
    const std::uint64_t exceptions = link->report().counters.exceptions;
    link->give({0, 0, 0, 0});
    ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions >= exceptions + 3; }));
    EXPECT_EQ(word, server.holding(100));
    EXPECT_EQ(word, server.holding(102));
    server.refuse(FakeModbusServer::kRegisters);
  }
}

// It goes out beside another drive's stop, and leaves the drive moving.
TEST_F(UnwatchedStops, BehindAWordThatIsIgnoredTheDriveIsStillStopped) {
  startWatched();
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  loseWith({kRuns, 8, kRuns, 8});
  link->give({kDownTheRamp, 0, 0, 0});
  ASSERT_TRUE(waitHeld(kDownTheRamp, 0));
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  EXPECT_TRUE(waitHeld(kDownTheRamp, kDownTheRamp)) << link->report().text.c_str();
}

// The connection between had written nothing: what the one before it left running counts.
TEST_F(UnwatchedStops, WhatAnEarlierConnectionLeftRunningIsStopped) {
  startWatched();
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  server.next({Reaction::kClose});
  link->give({kRuns, 8, kRuns, 8});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.connections == 2; }));
  ASSERT_TRUE(waitConnected());
  server.shut();
  server.refuse(kWatchdog);
  server.listenAgain();
  link->order(RegisterOrder{});  // no image: it finds the connection gone
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.connections == 3; }));
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  EXPECT_TRUE(waitHeld(kDownTheRamp, kDownTheRamp)) << link->report().text.c_str();
}

// The question goes over the second connection, which is not there: nor is that waited for.
TEST_F(UnwatchedStops, NorDoesItWaitForTheSecondConnection) {
  FakeModbusServer second;
  second.setHolding(kWatchdog, 500);
  startWatched([&](ModbusSettings& settings) { settings.diagnosis = second.address(); });
  ASSERT_TRUE(exchange({kRuns, 7, kRuns, 7}));
  second.shut();
  server.next({Reaction::kClose});
  link->give({kRuns, 8, kRuns, 8});
  ASSERT_TRUE(server.waitForConnections(2));
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  // kPatience is how long the answer of the second connection is waited for.
  const Instant until = link->now() + kPatience / 2;
  while (server.holding(100) != kDownTheRamp && link->now() < until) link->waitAnswers(link->now() + milliseconds{5});
  EXPECT_EQ(kDownTheRamp, server.holding(100));
}

// At the first start nothing runs that this driver has told to.
TEST_F(UnwatchedStops, AServerThatNeverTookTheWatchdogGetsNothing) {
  ModbusSettings settings = fourWords(server.address());
  settings.control_words = {0, 2};
  settings.run_bits = 0x007F;
  settings.watchdog = WatchdogRegister{kWatchdog, 500};
  settings.first_pause = settings.longest_pause = milliseconds{10};
  server.setHolding(100, kRuns);
  server.refuse(kWatchdog);
  start(settings);
  link->give({kDownTheRamp, 0, kDownTheRamp, 0});
  ASSERT_TRUE(waitUntil([&] { return link->report().counters.exceptions >= 3; }));
  EXPECT_EQ(kRuns, server.holding(100));
}

}  // namespace
}  // namespace nord_driver::link::test

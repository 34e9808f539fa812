#include <gtest/gtest.h>

#include <algorithm>

#include "profibus/listen_first.h"
#include "profibus/nord_wire.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

BusParameters listening() {
  BusParameters bus = quietBus();
  bus.listen_first = 100ms;
  return bus;
}

/// A cycle in which nothing may be sent; it takes no longer than 2 ms.
void silentCycle(Wire& wire, const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  testing::ScopedTrace trace(file, line, "silentCycle");
  const Instant begin = wire.now;
  wire.startCycle();
  EXPECT_FALSE(wire.master.cycleDone());
  wire.staysSilent();
  wire.cycleEnds();
  EXPECT_LE(wire.now - begin, 2ms);
  EXPECT_TRUE(wire.master.isListening());
}

// Nothing is sent before the line was listened to for the whole time.
TEST(ListenFirst, ThenTalks) {
  NordWire wire{listening()};
  const Instant begin = wire.now;
  silentCycle(wire);
  wire.now = begin + 97ms;
  silentCycle(wire);
  wire.now = begin + 99ms;
  wire.startCycle();
  wire.staysSilent();
  EXPECT_EQ(begin + 100ms, wire.now);
  wire.sends(kFdlStatus8);
  EXPECT_FALSE(wire.master.isListening());
  EXPECT_EQ(100ms, wire.now - begin);
}

// A foreign token, or request, keeps it silent for as long again.
TEST(ListenFirst, StaysSilentBesideAnotherMaster) {
  NordWire wire{listening()};
  for (int i = 0; i < 5; ++i) {
    silentCycle(wire);
    wire.advance(48ms);
    wire.startCycle();
    wire.arrives("DC 02 02");
    wire.staysSilent();
    wire.cycleEnds();
    wire.advance(44ms);
  }
  EXPECT_EQ(2, wire.tells(DpEventKind::kForeignMaster).master);
  EXPECT_EQ(0u, wire.master.counters().telegrams_sent);
  wire.advance(56ms);
  wire.startCycle();
  wire.sends(kFdlStatus8);
}

// The answers of slaves alone are no master: but somebody asked them, and that is heard too.
TEST(ListenFirst, NoiseIsNoMaster) {
  NordWire wire{listening()};
  silentCycle(wire);
  wire.arrives("E7 A7 DA 00");
  wire.advance(100ms);
  wire.startCycle();
  wire.sends(kFdlStatus8);
}

// One token may be noise: nothing is told, and the line is listened to once more, to be sure.
TEST(ListenFirst, ListensAgainAfterWhatMayBeAToken) {
  NordWire wire{listening()};
  silentCycle(wire);
  wire.advance(50ms);
  const Instant heard = wire.now;
  wire.arrives("DC 02 02");
  wire.advance(80ms);
  silentCycle(wire);
  wire.now = heard + 100ms;
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.tellsNothing();
}

TEST(ListenFirst, AgainAfterTheLinkWasOpened) {
  NordWire wire{listening()};
  wire.advance(100ms);
  wire.startCycle();
  wire.sends(kFdlStatus8);
  wire.restart();
  silentCycle(wire);
}

TEST(ListenFirst, RangeOfTheTime) {
  BusParameters bus = listening();
  bus.listen_first = 11s;
  EXPECT_THROW(bus.validate(), std::invalid_argument);
}

// Two that began in the same moment would do so again and again, and two that gave way in the same moment, too.
TEST(ListenFirst, WhoMeetsAnotherAgainListensLongerByChance) {
  int apart = 0;
  Duration shortest = 1h, longest{};
  for (int i = 0; i < 200; ++i) {
    const Instant begin{i * 7s};
    const Instant met = begin + 101ms, now = met + 200ms;
    ListenFirst one{100ms}, other{100ms};
    one.restart(begin);
    other.restart(begin + 1ms);
    for (ListenFirst* who : {&one, &other}) {
      ASSERT_TRUE(who->mayTalk(met));
      who->giveWay(met);
      EXPECT_EQ(met + 100ms, who->end()) << "a single time costs nothing";
      ASSERT_TRUE(who->mayTalk(now));
    }
    one.giveWay(now - 1ns);
    other.giveWay(now - 1ns);
    EXPECT_TRUE(one.isListening());
    for (const Duration listens : {one.end() - now, other.end() - now}) {
      shortest = std::min(shortest, listens + 1ns);
      longest = std::max(longest, listens + 1ns);
    }
    if (one.end() - other.end() > 10ms || other.end() - one.end() > 10ms) ++apart;
    const Duration listens = one.end() - (now - 1ns);
    one.handleForeign(3, true, now + 50ms);
    EXPECT_EQ(now + 50ms + listens, one.end());
  }
  EXPECT_GE(apart, 150);
  EXPECT_GE(shortest, 100ms);
  EXPECT_LT(shortest, 105ms);
  EXPECT_GT(longest, 195ms);
  EXPECT_LT(longest, 200ms);
}

// It is no meeting: who has led for a while comes back after the time it listens at its start.
TEST(ListenFirst, WhoHasLedForAWhileListensForItsTime) {
  ListenFirst listen{100ms};
  const Instant begin{1h};
  listen.restart(begin);
  ASSERT_TRUE(listen.mayTalk(begin + 100ms));
  listen.giveWay(begin + 150ms);
  const Instant led = begin + 350ms;
  ASSERT_TRUE(listen.mayTalk(led));
  listen.giveWay(led);
  EXPECT_EQ(led + 100ms, listen.end());
}

}  // namespace
}  // namespace nord_driver::profibus

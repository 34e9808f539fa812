// A slave that was silent for a short while is found again before its watchdog runs out: the drive does not trip.
#include <gtest/gtest.h>

#include "profibus/simulated_run.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr Duration kPeriod = 10ms;

/// Two modules with a watchdog of 200 ms behind an adapter with a slot time of 20 ms, at 500 kbit/s and 100 Hz.
struct Adapter : SimulatedRun {
  static BusParameters bus() {
    BusParameters bus = fastBus(500'000);
    bus.slot_time = 20ms;
    return bus;
  }
  static std::vector<SlaveConfig> slaves() {
    std::vector<SlaveConfig> slaves = modules(2);
    for (SlaveConfig& slave : slaves) slave.watchdog = 200ms;
    return slaves;
  }
  Adapter() : SimulatedRun(bus(), slaves()) {
    for (int cycles = 0; !allExchange() && cycles < 200; ++cycles) cycle(kPeriod);
    EXPECT_TRUE(allExchange()) << "200 cycles after the start not all slaves exchange data";
  }
  void loseFor(Duration span) {  // not even its receiver works
    segment.drive(0).setPlugged(false);
    const Instant end = now() + span;
    while (now() < end) cycle(kPeriod);
    segment.drive(0).setPlugged(true);
  }
  std::uint64_t trips() { return segment.station(0).counters().watchdog_trips; }
};

class Gap : public testing::TestWithParam<int> {};

TEST_P(Gap, OfSoManyMillisecondsTripsNothing) {
  Adapter run;
  run.loseFor(std::chrono::milliseconds{GetParam()});
  const Instant back = run.now();
  while (!run.allExchange() && run.now() < back + 2s) run.cycle(kPeriod);
  EXPECT_TRUE(run.allExchange());
  EXPECT_EQ(0u, run.trips());
  EXPECT_EQ(1u, run.losses_told);
  EXPECT_LT(run.now() - back, 150ms);
  EXPECT_TRUE(run.segment.referee().content()) << run.segment.referee().report();
}

// The same for a master that goes on with data exchange first, as long as a base of defaults lets it.
TEST_P(Gap, TripsNothingBehindASilenceLimitEither) {
  Adapter run;
  for (const std::size_t i : {0u, 1u}) run.master.setSilenceLimit(i, 94ms);
  run.loseFor(std::chrono::milliseconds{GetParam()});
  const Instant back = run.now();
  while (!run.allExchange() && run.now() < back + 2s) run.cycle(kPeriod);
  EXPECT_TRUE(run.allExchange());
  EXPECT_EQ(0u, run.trips());
  EXPECT_LT(run.now() - back, 150ms);
  EXPECT_TRUE(run.segment.referee().content()) << run.segment.referee().report();
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, Gap, testing::Values(60, 100, 140, 160));

// It hears us, and is not heard: its watchdog runs from the last request on, and not from the last answer. Asked for its
// diagnosis, or parameterised, it would turn for a watchdog more as it was told last.
TEST(SavedWatchdog, WhoHeardUsToTheLastGoesOnWithDataExchange) {
  for (const Duration silence : {180ms, 220ms, 260ms}) {
    Adapter run;
    run.master.setSilenceLimit(0, 94ms);
    run.segment.station(0).setMute(true);
    const Instant lost = run.now();
    while (run.now() < lost + silence) run.cycle(kPeriod);
    EXPECT_NE(SlavePhase::kDataExchange, run.master.status(0).phase);
    run.segment.station(0).setMute(false);
    const Instant back = run.now();
    while (!run.allExchange() && run.now() < back + 2s) {
      run.cycle(kPeriod);
      ASSERT_TRUE(run.segment.station(0).inDataExchange())
          << "it was parameterised anew, after " << toSeconds(silence) << " s";
    }
    EXPECT_TRUE(run.allExchange());
    EXPECT_EQ(0u, run.trips());
  }
}

// Found without haste, and in data exchange with us all the same.
TEST(SavedWatchdog, ALongOneGoesOnWithDataExchangeToo) {
  std::vector<SlaveConfig> slaves = Adapter::slaves();
  slaves[0].watchdog = 3s;
  SimulatedRun run{Adapter::bus(), slaves};
  for (int cycles = 0; !run.allExchange() && cycles < 200; ++cycles) run.cycle(kPeriod);
  ASSERT_TRUE(run.allExchange());
  run.segment.station(0).setMute(true);
  const Instant lost = run.now();
  while (run.now() < lost + 2s) run.cycle(kPeriod);
  run.segment.station(0).setMute(false);
  const Instant back = run.now();
  while (!run.allExchange() && run.now() < back + 2s) {
    run.cycle(kPeriod);
    ASSERT_TRUE(run.segment.station(0).inDataExchange()) << "it was parameterised anew";
  }
  EXPECT_TRUE(run.allExchange());
}

// A watchdog of three seconds leaves time enough for one that is looked for as seldom as any other: the haste, which costs
// the others half of their time, ends after a second.
TEST(SavedWatchdog, ALongOneIsHurriedForOneSecondOnly) {
  std::vector<SlaveConfig> slaves = Adapter::slaves();
  slaves[0].watchdog = 3s;
  SimulatedRun run{Adapter::bus(), slaves};
  for (int cycles = 0; !run.allExchange() && cycles < 200; ++cycles) run.cycle(kPeriod);
  ASSERT_TRUE(run.allExchange());
  run.segment.station(0).setMute(true);
  const Instant lost = run.now();
  run.cycle(kPeriod);
  const auto busyUntil = [&run](Instant end) {
    const Instant begin = run.now();
    Duration busy{};
    while (run.now() < end) {
      run.cycle(kPeriod);
      busy += run.last_cycle;
    }
    return toSeconds(busy) / toSeconds(run.now() - begin);
  };
  EXPECT_GE(busyUntil(lost + 950ms), 0.3);
  run.cycle(kPeriod * 6);
  EXPECT_LE(busyUntil(lost + 1950ms), 0.2);
}

// The one that is there is exchanged with in every cycle meanwhile, and keeps half of the time.
TEST(SavedWatchdog, TheOthersKeepHalfOfTheTime) {
  Adapter run;
  run.segment.station(0).setMute(true);
  run.cycle(kPeriod);  // two slots of 20 ms in it
  const Instant begin = run.now();
  Duration busy{};
  while (run.now() < begin + 150ms) {
    run.cycle(kPeriod);
    ASSERT_TRUE(run.master.status(1).exchanged_this_cycle);
    EXPECT_LE(run.last_cycle, 25ms);
    busy += run.last_cycle;
  }
  EXPECT_LE(busy, (run.now() - begin) * 6 / 10);
  EXPECT_GE(busy, (run.now() - begin) * 3 / 10);
}

// Whoever stays away costs little again: a tenth of the time, as before.
TEST(SavedWatchdog, TheHasteEndsWithTheWatchdog) {
  Adapter run;
  run.segment.station(0).setMute(true);
  const Instant lost = run.now();
  while (run.now() < lost + 300ms) run.cycle(kPeriod);
  const Instant begin = run.now();
  Duration busy{};
  for (int i = 0; i < 100; ++i) {
    run.cycle(kPeriod);
    busy += run.last_cycle;
  }
  EXPECT_LE(busy, (run.now() - begin) / 5);
}

}  // namespace
}  // namespace nord_driver::profibus

#include <gtest/gtest.h>

#include "profibus/simulated_run.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

class StartUp : public testing::TestWithParam<int> {};

// 1, 8 and 125 slaves come into data exchange, found one per cycle, and the referee has nothing to say. Then a cycle
// holds one exchange with each of them.
TEST_P(StartUp, OfSoManySlaves) {
  const int count = GetParam();
  SimulatedRun run{fastBus(1'500'000), modules(count)};
  int cycles = 0;
  while (!run.allExchange() && cycles < 200) {
    run.cycle(2ms);
    ++cycles;
  }
  EXPECT_TRUE(run.allExchange());
  EXPECT_LE(cycles, count + 6);
  EXPECT_TRUE(run.segment.referee().content()) << run.segment.referee().report();
  EXPECT_EQ(0u, run.losses_told);

  run.cycle(2ms);
  const auto sent = run.master.counters().telegrams_sent;
  run.cycle(2ms);
  EXPECT_EQ(sent + static_cast<std::uint64_t>(count), run.master.counters().telegrams_sent);
  // The floor of one exchange of 12 bytes each way is 462 bits of characters, 11 and 33 bits of pauses; the simulated
  // slaves answer after 32, the master waits for 37.
  EXPECT_LE(run.last_cycle, count * BaudRate{1'500'000}.bits(462 + 32 + 37 + 2));
}

INSTANTIATE_TEST_SUITE_P(Counts, StartUp, testing::Values(1, 8, 125));

// 124 of 125 slaves are off: the one that is there is exchanged with in every cycle, and the others together cost it a
// tenth of the time.
TEST(ManySlaves, OfflineOnesCostLittle) {
  BusParameters bus = fastBus(1'500'000);
  bus.slot_time = 20ms;  // a USB adapter
  SimulatedRun run{bus, modules(125)};
  for (std::size_t i = 1; i < 125; ++i) run.segment.station(i).setPowered(false);
  for (int cycles = 0; !run.master.status(0).exchanged_this_cycle; ++cycles) {
    ASSERT_LT(cycles, 10'000) << "20 s after the start the slave that is there does not exchange data";
    run.cycle(2ms);
  }
  const Instant begin = run.now();
  Duration busy{};
  for (int i = 0; i < 1000; ++i) {
    run.cycle(1ms);
    ASSERT_TRUE(run.master.status(0).exchanged_this_cycle);
    busy += run.last_cycle;
  }
  const Duration exchange = 1000 * BaudRate{1'500'000}.bits(533);
  EXPECT_LE(busy - exchange, (run.now() - begin) / 8);
  EXPECT_EQ(0u, run.losses_told);
}

}  // namespace
}  // namespace nord_driver::profibus

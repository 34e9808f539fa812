#include <gtest/gtest.h>

#include "profibus/simulated_run.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kRequestBits = 33;              // T_SYN before every request
constexpr std::uint64_t kAnswerBits = 11;               // min T_SDR before every answer
constexpr std::uint64_t kExchangeCharacters = 21 + 21;  // 68 0F 0F 68, DA SA FC, 12 bytes, FCS 16, each way
constexpr std::uint64_t kOperateCharacters = 13;        // Global_Control, nobody answers it

struct Case {
  std::uint32_t rate;
  int slaves;
  double bound;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.rate << " bit/s, " << c.slaves << " slaves";
}

class Efficiency : public testing::TestWithParam<Case> {};

// The wire's floor over what a cycle takes: characters of 11 bits and the pauses the standard asks for, nothing else.
// Slaves answer after min T_SDR, so that all that is lost is lost by the master: T_ID1 is 37 instead of 33 bit times.
TEST_P(Efficiency, IsCloseToTheWire) {
  const Case& c = GetParam();
  std::vector<SlaveConfig> slaves = modules(c.slaves);
  for (SlaveConfig& slave : slaves) slave.watchdog = 2s;  // 0.2 s pass between two exchanges at 19.2 kbit/s
  SimulatedRun run{fastBus(c.rate), slaves};
  run.segment.setAnswerTime(kAnswerBits);
  for (int i = 0; i < 100 && !run.allExchange(); ++i) run.cycle(0ms);
  ASSERT_TRUE(run.allExchange());
  run.cycle(0ms);  // what the start-up left over

  const Counters before = run.master.counters();
  const Instant begin = run.now();
  // Longer than a second, so that Global_Control Operate has its share.
  while (run.now() < begin + 1200ms) run.cycle(0ms);
  const double measured = toSeconds(run.now() - begin);
  const Counters& after = run.master.counters();

  const std::uint64_t exchanges = after.telegrams_received - before.telegrams_received;
  const std::uint64_t operates = after.telegrams_sent - before.telegrams_sent - exchanges;
  EXPECT_GE(operates, 1u);
  EXPECT_LE(operates, 2u);
  const std::uint64_t bits = exchanges * (kExchangeCharacters * 11 + kAnswerBits + kRequestBits) +
                             operates * (kOperateCharacters * 11 + kRequestBits);
  const double efficiency = static_cast<double>(bits) / c.rate / measured;
  EXPECT_GE(efficiency, c.bound) << exchanges << " exchanges in " << measured << " s";
  EXPECT_LE(efficiency, 1.0);
  EXPECT_EQ(before.retries, after.retries);
  EXPECT_TRUE(run.segment.referee().content()) << run.segment.referee().report();
}

INSTANTIATE_TEST_SUITE_P(Rates, Efficiency,
                         testing::Values(Case{19'200, 1, 0.99}, Case{19'200, 8, 0.99}, Case{93'750, 1, 0.95},
                                         Case{93'750, 8, 0.95}, Case{500'000, 8, 0.95}, Case{1'500'000, 1, 0.85},
                                         Case{1'500'000, 8, 0.85}));

}  // namespace
}  // namespace nord_driver::profibus

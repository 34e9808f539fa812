#include <gtest/gtest.h>

#include <random>

#include "profibus/simulated_run.h"

namespace nord_driver::profibus {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kSequences = 3000;
constexpr Duration kPeriod = 20ms;

class Trouble {
 public:
  explicit Trouble(std::uint32_t seed) : random_{seed} {}

  unsigned below(unsigned limit) { return static_cast<unsigned>(random_() % limit); }

  /// Something goes wrong, for one cycle or until `end()`.
  void strike(SimulatedRun& run) {
    sim::DpStation& slave = run.segment.station(below(2));
    switch (below(9)) {
      case 0:
        return run.segment.loseAnswers(1 + below(4));
      case 1:
        return run.segment.loseRequests(1 + below(4));
      case 2:
        return run.segment.spoilAnswers(1 + below(4));
      case 3:
        return slave.setPowered(below(2) == 0);
      case 4:
        return slave.setMute(below(2) == 0);
      case 5:
        return slave.setInverterLink(below(2) == 0);
      case 6:  // late: within the slot, at its end, behind it
        return run.segment.setAnswerTime(20 + below(400));
      case 7: {
        sim::Disturbance disturbance;
        disturbance.lose = 0.01 * below(3);
        disturbance.flip = 0.01 * below(3);
        disturbance.duplicate = 0.01 * below(3);
        disturbance.seed = below(1'000'000);
        return run.segment.setDisturbance(disturbance);
      }
      default:
        return run.segment.setDisturbance({});
    }
  }

  void end(SimulatedRun& run) {
    run.segment.setDisturbance({});
    run.segment.setAnswerTime(32);
    run.segment.loseAnswers(0);
    run.segment.loseRequests(0);
    run.segment.spoilAnswers(0);
    for (std::size_t i = 0; i < 2; ++i) {
      run.segment.station(i).setPowered(true);
      run.segment.station(i).setMute(false);
      run.segment.station(i).setInverterLink(true);
    }
  }

 private:
  std::mt19937 random_;
};

// The master alone; with drives and a base on top of it: test/system/test_fault_sequences.cpp. Lost, doubled and turned
// bytes, late answers, slaves gone and back, in 3000 repeatable sequences. After each: both slaves are in
// data exchange again within the longest pause (2 s) and a start-up; every loss was counted and told; every request
// was answered or timed out; every byte was in a telegram or discarded.
TEST(FaultSequences, ServiceIsRestoredAndEverythingCounted) {
  std::uint64_t losses = 0, retries = 0, refusals = 0, unexpected = 0;
  for (std::uint32_t seed = 1; seed <= kSequences && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Trouble trouble{seed};
    SimulatedRun run{fastBus(500'000), modules(2)};
    // Every other one goes on with data exchange through short silences, as under a base.
    for (std::size_t i = 0; i < 2 && seed % 2 == 0; ++i) run.master.setSilenceLimit(i, 50ms);
    const unsigned quiet = trouble.below(10);
    for (unsigned i = 0; i < quiet; ++i) run.cycle(kPeriod);
    for (int i = 0; i < 12; ++i) {
      trouble.strike(run);
      const unsigned cycles = 1 + trouble.below(3);
      for (unsigned k = 0; k < cycles; ++k) run.cycle(kPeriod);
    }
    trouble.end(run);
    const Instant good = run.now();
    do {
      run.cycle(kPeriod);
    } while (!run.allExchange() && run.now() < good + 10s);
    EXPECT_LT(run.now() - good, 2500ms);

    std::uint64_t counted = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const SlaveCounters& slave = run.master.status(i).counters;
      EXPECT_EQ(slave.requests, slave.answers + slave.timeouts);
      counted += slave.losses;
      retries += slave.retries;
      refusals += slave.refusals;
    }
    EXPECT_EQ(run.losses_seen, counted);
    EXPECT_EQ(run.losses_told, counted);
    run.master.restart(run.now());
    const ReceiverCounters& bytes = run.master.counters().receiver;
    EXPECT_EQ(bytes.bytes_received, bytes.bytes_in_telegrams + bytes.bytes_discarded);
    sim::Referee& referee = run.segment.referee();
    // What the master sent, before the line spoiled it. Pauses are judged elsewhere: where request and late answer
    // collide, the segment hands the master none of the bytes that a real one would hear.
    for (const sim::Rule rule : {sim::Rule::kNoTelegram, sim::Rule::kNotARequest, sim::Rule::kWrongDataLength}) {
      EXPECT_EQ(0u, referee.count(rule)) << sim::toString(rule);
    }
    losses += counted;
    unexpected += run.master.counters().unexpected;
  }
  // The test means nothing if the trouble never reached the exchange.
  EXPECT_GT(losses, 1'000u);
  EXPECT_GT(retries, 1'000u);
  EXPECT_GT(unexpected, 100u);
  RecordProperty("losses", std::to_string(losses));
  RecordProperty("refusals", std::to_string(refusals));
}

}  // namespace
}  // namespace nord_driver::profibus

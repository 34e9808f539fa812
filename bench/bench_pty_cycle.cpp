// What the driver adds to a bare exchange over a pty, and what to the wire at 500 kbit/s.
#include <sys/prctl.h>

#include <cstdio>
#include <stdexcept>
#include <vector>

#include "dp_line.h"
#include "measure.h"
#include "ping_pong.h"
#include "pty_responder.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;

constexpr unsigned kProcessor = 0;
constexpr std::size_t kPairs = 5000;
constexpr std::size_t kBlock = 20;
constexpr int kRepeats = 5;

/// A cycle with one station, pauses taken off, against a ping-pong of the same bytes.
bool withoutPausesAtMostAQuarterMore() {
  PtyResponder responder{Answers{kFirstStation, 1}, kProcessor};
  DpLine line{withoutPauses(), responder.path(), 1};
  line.cycle();
  const PingPong bare{responder.path(), responder.lastRequest(), responder.lastAnswerSize()};
  std::printf("DP cycle, PPO 1, 1 station, no pauses, against write/read of the same %zu and %zu bytes\n",
              responder.lastRequest().size(), responder.lastAnswerSize());
  const auto dp = [&line] { line.cycle(); };
  const auto ping_pong = [&bare] { bare.exchange(); };
  measurePairs(kPairs / 5, kBlock, dp, ping_pong);  // warm-up
  std::vector<double> ratios;
  for (int i = 0; i < kRepeats; ++i) {
    const Pair medians = measurePairs(kPairs, kBlock, dp, ping_pong);
    ratios.push_back(medians.first / medians.second);
    std::printf("  DP %.2f us, bare %.2f us, ratio %.3f\n", medians.first, medians.second, ratios.back());
  }
  line.check();
  std::printf("  retries %llu\n", static_cast<unsigned long long>(line.retries()));
  return report("DP cycle over bare ping-pong", median(ratios), "", 1.25);
}

/// The stations answer when they would on a wire of 500 kbit/s; the master keeps its pauses.
bool onAWireOf500k(std::size_t stations) {
  constexpr std::uint32_t kRate = 500'000;
  constexpr double kFloorBits = 506;  // PPO 1: 42 characters of 11 bits, min T_SDR 11, T_SYN 33
  PtyResponder responder{Answers{kFirstStation, stations}, kProcessor};
  DpLine line{withPauses(kRate), responder.path(), stations};
  line.cycle();
  const PingPong bare{responder.path(), responder.lastRequest(), responder.lastAnswerSize()};
  const auto dp = [&] {
    responder.setWire(kRate);
    line.cycle();
    responder.setWire(0);
  };
  const auto ping_pong = [&bare] { bare.exchange(); };
  const std::size_t pairs = 2000 / stations;
  measurePairs(pairs / 5, kBlock, dp, ping_pong);  // warm-up
  std::vector<double> cycles, exchanges;
  for (int i = 0; i < kRepeats; ++i) {
    const Pair medians = measurePairs(pairs, kBlock, dp, ping_pong);
    cycles.push_back(medians.first);
    exchanges.push_back(medians.second);
  }
  line.check();
  const auto count = static_cast<double>(stations);
  const double floor = count * kFloorBits / kRate * 1e6;
  const double exchange = median(exchanges);
  const double cycle = median(cycles);
  std::printf(
      "500 kbit/s, %zu station(s): wire floor %.0f us, bare exchange %.2f us, above floor per station %.1f us\n",
      stations, floor, exchange, (cycle - floor) / count);
  return report("DP cycle with pauses against floor + N x (bare + 150 us)", cycle, "us",
                floor + count * (exchange + 150.0));
}

}  // namespace

int main() {
  try {
    pinTo(kProcessor);
    prctl(PR_SET_TIMERSLACK, 1);  // like the thread of the bus cycle
    const BusyOthers busy{kProcessor};
    bool kept = withoutPausesAtMostAQuarterMore();
    for (const std::size_t stations : {1u, 2u, 8u}) kept = onAWireOf500k(stations) && kept;
    return kept ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_pty_cycle: %s\n", error.what());
    return 2;
  }
}

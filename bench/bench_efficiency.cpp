// How much of the wire a bus cycle uses: simulated bit times, and the driver's own processor time on top of them.
//
// The wire is simulated, so the figures do not depend on an adapter; what the master computes between an answer and its
// next request passes on the wire, too, and counts where it is longer than the pause it has to keep anyway.
#include <time.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "answers.h"
#include "measure.h"
#include "profibus/dp_master.h"
#include "sim/profibus/simulated_segment.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;

constexpr unsigned kProcessor = 0;
constexpr std::uint8_t kFirstStation = 8;
constexpr std::uint64_t kMinTsdr = 11;
constexpr double kExchangeBits = 42 * 11 + 11 + 33;  // PPO 1: 42 characters, min T_SDR, T_SYN
constexpr double kOperateBits = 13 * 11 + 33;        // Global_Control, once a second, nobody answers

/// What this thread has used of its processor: others on the machine do not count.
Duration processorTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

class PacedLine {
 public:
  PacedLine(std::uint32_t rate, std::size_t stations)
      : segment_(simulation(rate, stations)),
        master_(profibus::BusParameters::forBaudRate(BaudRate{rate}, *profibus::StationAddress::from(1)),
                slaves(kFirstStation, stations)) {
    segment_.setAnswerTime(kMinTsdr);
    segment_.open();
    master_.restart(segment_.now());
    for (int i = 0; i < 500 && !allExchange(); ++i) cycle();
    if (!allExchange()) throw std::runtime_error("the stations do not come into data exchange");
  }

  void cycle() {
    std::uint8_t buffer[256];
    last_ = processorTime();
    for (std::size_t slave = 0; slave < master_.slaveCount(); ++slave) master_.setOutputs(slave, kStandby);
    master_.startCycle(segment_.now());
    while (!master_.cycleDone()) {
      const ByteView telegram = master_.pollTransmit(segment_.now());
      pass();
      if (!telegram.empty()) {
        segment_.write(telegram);
      } else {
        const auto deadline = master_.nextDeadline();
        if (!deadline) break;
        const bool readable = segment_.waitReadable(*deadline);
        const std::size_t count = readable ? segment_.read(buffer, sizeof buffer) : 0;
        last_ = processorTime();
        if (count > 0) master_.handleBytes({buffer, count}, segment_.now());
        pass();
        if (segment_.now() >= *deadline) master_.handleTimeout(segment_.now());
        pass();
      }
      last_ = processorTime();
    }
    while (master_.pollEvent()) {
    }
  }

  Instant now() const { return segment_.now(); }
  std::uint64_t sent() const { return master_.counters().telegrams_sent; }
  std::uint64_t exchanges() const { return master_.counters().telegrams_received; }
  void check() {
    if (!allExchange()) throw std::runtime_error("a station was lost during the measurement");
    if (!segment_.referee().content()) throw std::runtime_error(segment_.referee().report());
  }

 private:
  static sim::SimConfig simulation(std::uint32_t rate, std::size_t stations) {
    sim::SimConfig config;
    config.bus.as<sim::DpBusConfig>().baud_rate = rate;
    for (std::size_t i = 0; i < stations; ++i) {
      sim::DriveConfig drive;
      drive.name = "drive" + std::to_string(i);
      drive.address = static_cast<std::uint8_t>(kFirstStation + i);
      config.drives.push_back(drive);
    }
    return config;
  }
  bool allExchange() const {
    for (std::size_t slave = 0; slave < master_.slaveCount(); ++slave) {
      if (!master_.status(slave).exchanged_this_cycle) return false;
    }
    return true;
  }
  /// What was computed since the last time passes on the wire.
  void pass() {
    const Duration here = processorTime();
    segment_.run(here - last_);
    last_ = processorTime();
  }

  /// PPO 1: no parameter order, control word 047E, setpoint 0.
  static constexpr std::array<std::uint8_t, 12> kStandby{0, 0, 0, 0, 0, 0, 0, 0, 0x04, 0x7E, 0, 0};

  sim::SimulatedSegment segment_;
  profibus::DpMaster master_;
  Duration last_{};
};

bool atRate(std::uint32_t rate, std::size_t stations, double bound) {
  PacedLine line{rate, stations};
  const std::uint64_t exchanges_before = line.exchanges();
  const std::uint64_t sent_before = line.sent();
  const Instant begin = line.now();
  while (line.now() < begin + std::chrono::seconds{3}) line.cycle();
  line.check();
  const double seconds = toSeconds(line.now() - begin);
  const auto exchanges = static_cast<double>(line.exchanges() - exchanges_before);
  const double operates = static_cast<double>(line.sent() - sent_before) - exchanges;
  const double floor = (exchanges * kExchangeBits + operates * kOperateBits) / rate;
  const std::string what = "efficiency, " + std::to_string(rate) + " bit/s, " + std::to_string(stations) +
                           " station(s), " + std::to_string(static_cast<long>(seconds / exchanges * 1e6 + 0.5)) +
                           " us each";
  return reportAtLeast(what.c_str(), floor / seconds, bound);
}

}  // namespace

int main() {
  try {
    pinTo(kProcessor);
    const BusyOthers busy{kProcessor};
    bool kept = true;
    for (const std::size_t stations : {1u, 8u}) {
      kept = atRate(19'200, stations, 0.99) && kept;
      kept = atRate(93'750, stations, 0.95) && kept;
      kept = atRate(500'000, stations, 0.95) && kept;
      kept = atRate(1'500'000, stations, 0.85) && kept;
    }
    return kept ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_efficiency: %s\n", error.what());
    return 2;
  }
}

// What the driver costs without any device: PPO 1 to bytes and back, and a cycle per station.
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "answers.h"
#include "measure.h"
#include "profibus/dp_master.h"
#include "profile/pkw.h"
#include "transport/profibus/ppo.h"

namespace {

using namespace nord_driver;
using namespace nord_driver::bench;

constexpr unsigned kProcessor = 0;
constexpr int kRepeats = 5;

/// As the transport does it: words of the profile, high byte first, and back.
bool ppoOneInAMicrosecond() {
  const profile::PpoLayout layout = *profile::ppoLayout(1, profile::kIdentTechnologyUnit, profile::Series::kSk5xxe);
  constexpr int kBatch = 1000;
  profile::ProcessOutput output;
  output.control_word = 0x047F;
  profile::ProcessInput input;
  volatile unsigned sink = 0;
  const auto batch = [&] {
    for (int i = 0; i < kBatch; ++i) {
      output.setpoints[0] = static_cast<std::int16_t>(i);
      profile::PkwWords pkw{};
      FixedBytes<2 * profile::PpoWords::capacity()> bytes;
      ByteWriter writer{bytes};
      for (const Word word : profile::pack(layout, pkw, output)) writer.u16be(word);
      ByteReader reader{bytes};
      profile::PpoWords words;
      while (reader.remaining() >= 2) words.push_back(reader.u16be());
      if (profile::unpack(layout, words, pkw, input)) sink = sink + input.status_word;
    }
  };
  batch();
  std::vector<double> times;
  for (int i = 0; i < 200; ++i) times.push_back(microseconds(batch) / kBatch);
  return report("PPO 1, encode and decode", median(times), "us", 1.0);
}

/// Master and stations hand each other bytes; the time is a number.
class Segment {
 public:
  explicit Segment(std::size_t count)
      : answers_(1 + kMaster, count, kMaster), master_(busParameters(), slaves(1 + kMaster, count)) {
    master_.restart(now_);
    for (std::size_t i = 0; i < 200 * count && !allExchange(); ++i) cycle();
    if (!allExchange()) throw std::runtime_error("the stations do not come into data exchange");
  }

  void cycle() {
    master_.startCycle(now_);
    while (!master_.cycleDone()) {
      now_ = std::max(now_, *master_.nextDeadline());
      const ByteView request = master_.pollTransmit(now_);
      if (request.empty()) {
        master_.handleTimeout(now_);
        continue;
      }
      const ByteView answer = answers_.to(request);
      now_ += std::chrono::microseconds{500};
      if (!answer.empty()) master_.handleBytes(answer, now_);
    }
    while (master_.pollEvent()) {
    }
  }
  bool allExchange() const {
    for (std::size_t slave = 0; slave < master_.slaveCount(); ++slave) {
      if (!master_.status(slave).exchanged_this_cycle) return false;
    }
    return true;
  }

 private:
  static constexpr std::uint8_t kMaster = 0;
  static profibus::BusParameters busParameters() {
    return profibus::BusParameters::forBaudRate(BaudRate{1'500'000}, *profibus::StationAddress::from(kMaster));
  }

  Answers answers_;
  profibus::DpMaster master_;
  Instant now_{};
};

/// Cost per station of a full segment against one of eight.
bool manyStationsCostNoMoreEach() {
  constexpr std::size_t kFew = 8, kMany = 125;
  Segment few{kFew}, many{kMany};
  const auto cycle_few = [&few] {
    for (std::size_t i = 0; i < kMany / kFew; ++i) few.cycle();
  };
  const auto cycle_many = [&many] { many.cycle(); };
  measurePairs(200, 20, cycle_few, cycle_many);  // warm-up
  std::vector<double> ratios;
  for (int i = 0; i < kRepeats; ++i) {
    const Pair medians = measurePairs(1000, 20, cycle_few, cycle_many);
    const double per_few = medians.first / static_cast<double>(kMany / kFew * kFew);
    const double per_many = medians.second / static_cast<double>(kMany);
    ratios.push_back(per_many / per_few);
    std::printf("  per station: of 8 %.3f us, of 125 %.3f us\n", per_few, per_many);
  }
  if (!few.allExchange() || !many.allExchange()) throw std::runtime_error("a station was lost");
  return report("cost per station, 125 stations over 8", median(ratios), "", 1.2);
}

}  // namespace

int main() {
  try {
    pinTo(kProcessor);
    const BusyOthers busy{kProcessor};
    bool kept = ppoOneInAMicrosecond();
    kept = manyStationsCostNoMoreEach() && kept;
    return kept ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_in_process: %s\n", error.what());
    return 2;
  }
}

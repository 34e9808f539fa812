// The master on the simulated segment: both written from the manuals on their own, and a referee between them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "profibus/dp_master.h"
#include "profibus/wire.h"
#include "sim/profibus/simulated_segment.h"

namespace nord_driver::profibus {

class SimulatedRun {
 public:
  SimulatedRun(const BusParameters& bus, const std::vector<SlaveConfig>& slaves)
      : segment{simulation(bus, slaves)}, master{bus, slaves}, was_exchanging_(slaves.size(), false), bus_(bus) {
    segment.open();
    master.restart(segment.now());
    for (std::size_t i = 0; i < slaves.size(); ++i)
      master.setOutputs(i, fromHex("00 00 00 00 00 00 00 00 04 7E 00 00"));
  }

  /// One cycle, and the rest of `period`.
  void cycle(Duration period) {
    const Instant begin = segment.now();
    std::uint8_t buffer[256];
    master.startCycle(begin);
    std::size_t telegrams = 0;
    while (!master.cycleDone()) {
      ASSERT_LT(segment.now(), begin + std::chrono::seconds{10}) << "the cycle does not end";
      const ByteView telegram = master.pollTransmit(segment.now());
      if (!telegram.empty()) {
        ASSERT_LT(++telegrams, 100'000u) << "the cycle sends for ever";
        segment.write(telegram);
        continue;
      }
      const auto deadline = master.nextDeadline();
      ASSERT_TRUE(deadline);
      if (segment.waitReadable(*deadline)) {
        const std::size_t count = segment.read(buffer, sizeof buffer);
        master.handleBytes({buffer, count}, segment.now());
      }
      if (segment.now() >= *deadline) master.handleTimeout(segment.now());
    }
    last_cycle = segment.now() - begin;
    watch();
    if (segment.now() < begin + period) segment.run(begin + period - segment.now());
  }

  bool allExchange() const {
    for (std::size_t i = 0; i < master.slaveCount(); ++i) {
      if (!master.status(i).exchanged_this_cycle) return false;
    }
    return true;
  }
  Instant now() const { return segment.now(); }

 private:
  static sim::SimConfig simulation(const BusParameters& bus, const std::vector<SlaveConfig>& slaves) {
    sim::SimConfig config;
    config.bus.as<sim::DpBusConfig>().baud_rate = bus.baud.bitsPerSecond();
    for (const SlaveConfig& slave : slaves) {
      sim::DriveConfig drive;
      drive.name = "drive" + std::to_string(slave.address.value());
      drive.joint = drive.name;
      drive.address = slave.address.value();
      config.drives.push_back(drive);
    }
    return config;
  }

  /// Losses as seen from outside: by the phase after each cycle, and by the events.
  void watch() {
    while (const auto event = master.pollEvent()) {
      if (event->kind == DpEventKind::kSlaveLost) ++losses_told;
      if (event->kind == DpEventKind::kDataExchangeEntered) was_exchanging_[event->slave] = true;  // and left at once
    }
    for (std::size_t i = 0; i < master.slaveCount(); ++i) {
      const bool exchanging = master.status(i).phase == SlavePhase::kDataExchange;
      if (was_exchanging_[i] && !exchanging) ++losses_seen;
      was_exchanging_[i] = exchanging;
    }
  }

 public:
  sim::SimulatedSegment segment;
  DpMaster master;
  Duration last_cycle{};
  std::uint64_t losses_seen = 0;
  std::uint64_t losses_told = 0;

 private:
  std::vector<bool> was_exchanging_;
  BusParameters bus_;
};

inline BusParameters fastBus(std::uint32_t rate) {
  return BusParameters::forBaudRate(BaudRate{rate}, station(1));
}

/// NORD modules at 2, 3, 4 ...; the last of 125 takes the one address below the master that is left.
inline std::vector<SlaveConfig> modules(int count) {
  std::vector<SlaveConfig> slaves;
  for (int i = 0; i < count; ++i) slaves.push_back(nordModule(i == 124 ? 0 : 2 + i));
  return slaves;
}

}  // namespace nord_driver::profibus

// The driver's side of the benchmarks: the DP master on a serial port, turned as the transport turns it.
#pragma once

#include <stdexcept>
#include <string>

#include "answers.h"
#include "link/serial/serial_port.h"
#include "profibus/dp_master.h"

namespace nord_driver::bench {

constexpr std::uint8_t kFirstStation = 8;

/// Pauses and slots of a rate at which a bit is no time at all; a slot as long as on a USB adapter.
inline profibus::BusParameters withoutPauses() {
  profibus::BusParameters bus;
  bus.baud = BaudRate{1'000'000'000};
  bus.master = *profibus::StationAddress::from(1);
  bus.slot_time = std::chrono::milliseconds{100};
  return bus;
}

inline profibus::BusParameters withPauses(std::uint32_t rate) {
  profibus::BusParameters bus =
      profibus::BusParameters::forBaudRate(BaudRate{rate}, *profibus::StationAddress::from(1));
  bus.slot_time = std::chrono::milliseconds{100};
  return bus;
}

class DpLine {
 public:
  DpLine(const profibus::BusParameters& bus, const std::string& device, std::size_t slave_count)
      : master_(bus, slaves(kFirstStation, slave_count)), port_(settingsFor(device)) {
    if (!port_.open()) throw std::runtime_error(port_.lastError());
    master_.restart(port_.now());
    for (const Instant until = port_.now() + std::chrono::seconds{20}; !allExchange() && port_.now() < until;) cycle();
    if (!allExchange()) throw std::runtime_error("the stations do not come into data exchange");
  }

  void cycle() {
    std::uint8_t buffer[512];
    for (std::size_t slave = 0; slave < master_.slaveCount(); ++slave) master_.setOutputs(slave, kStandby);
    master_.startCycle(port_.now());
    while (!master_.cycleDone()) {
      const ByteView telegram = master_.pollTransmit(port_.now());
      if (!telegram.empty()) {
        port_.write(telegram);
        continue;
      }
      const auto deadline = master_.nextDeadline();
      if (!deadline) break;
      if (port_.waitReadable(*deadline)) {
        const std::size_t count = port_.read(buffer, sizeof buffer);
        master_.handleBytes({buffer, count}, port_.now());
      }
      if (port_.now() >= *deadline) master_.handleTimeout(port_.now());
    }
    while (master_.pollEvent()) {
    }
  }

  /// Throws when a station was lost on the way: what was measured then is something else.
  void check() const {
    if (!allExchange()) throw std::runtime_error("a station was lost during the measurement");
  }
  std::uint64_t retries() const { return master_.counters().retries; }

 private:
  static link::SerialSettings settingsFor(const std::string& device) {
    link::SerialSettings settings;
    settings.device = device;
    return settings;
  }
  bool allExchange() const {
    for (std::size_t slave = 0; slave < master_.slaveCount(); ++slave) {
      if (!master_.status(slave).exchanged_this_cycle) return false;
    }
    return true;
  }

  /// PPO 1: no parameter order, control word 047E, setpoint 0.
  static constexpr std::array<std::uint8_t, 12> kStandby{0, 0, 0, 0, 0, 0, 0, 0, 0x04, 0x7E, 0, 0};

  profibus::DpMaster master_;
  link::SerialPort port_;
};

}  // namespace nord_driver::bench

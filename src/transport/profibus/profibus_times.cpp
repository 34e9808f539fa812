#include "transport/profibus/profibus_times.h"

#include <algorithm>

#include "config/setting_checks.h"

namespace nord_driver {

namespace {

constexpr std::uint32_t kFrameOverhead = 9;               // SD2: 68 LE LE 68 DA SA FC ... FCS 16
constexpr std::uint32_t kRecordTelegram = 9 + 2 + 4 + 8;  // with two access points, the PDU's head and a PKW

/// A cycle in which all slaves answer, one in which one of them is silent with all its retries, and one in which only
/// one answers.
struct CycleLengths {
  Duration exchange{};
  Duration worst{};
  Duration one_left{};
};

CycleLengths cycleLengths(const profibus::BusParameters& bus, const std::vector<profibus::SlaveConfig>& slaves) {
  CycleLengths lengths;
  Duration longest_slot{};
  bool acyclic = false;
  for (const profibus::SlaveConfig& slave : slaves) {
    const auto request = bus.baud.characters(slave.output_length + kFrameOverhead);
    const auto answer = bus.baud.characters(slave.input_length + kFrameOverhead);
    lengths.exchange += request + bus.baud.bits(bus.max_tsdr_bits) + answer + bus.idleTime();
    longest_slot = std::max(longest_slot, request + bus.slotTime());
    acyclic = acyclic || slave.dpv1;
  }
  const Duration silence = (1 + bus.max_retries) * longest_slot;
  lengths.worst = lengths.exchange + silence;
  lengths.one_left = lengths.exchange + static_cast<Duration::rep>(slaves.size() - 1) * silence;
  // One acyclic telegram a cycle, when there is a module that takes any.
  if (acyclic) {
    const Duration record =
        2 * bus.baud.characters(kRecordTelegram) + bus.baud.bits(bus.max_tsdr_bits) + bus.idleTime();
    lengths.worst += record;
    lengths.one_left += record;
  }
  return lengths;
}

std::string inSeconds(Duration time) {
  return shortNumber(toSeconds(time)) + " s";
}

void checkIntervals(const Settings& bus, Duration period, const ProfibusDpConfig& config) {
  for (std::size_t i = 0; i < config.stations.size(); ++i) {
    const Duration interval = config.stations[i].min_interval;
    if (interval <= period) continue;
    throw ConfigError(bus.fullName("gsd") + ": station " + std::to_string(config.slaves[i].address.value()) +
                      " may be asked every " + inSeconds(interval) +
                      " only (Min_Slave_Intervall): expected a cycle_rate of at most " +
                      shortNumber(1.0 / toSeconds(interval)) + " Hz");
  }
}

}  // namespace

void checkTimes(const Settings& bus, double cycle_rate, ProfibusDpConfig& config) {
  const CycleLengths lengths = cycleLengths(config.bus, config.slaves);
  const Duration period = seconds(1.0 / cycle_rate);
  config.worst_cycle = std::max(lengths.worst, period);
  if (lengths.exchange > period) {
    throw ConfigError(bus.fullName("baud_rate") + ": " + std::to_string(config.bus.baud.bitsPerSecond()) +
                      " bit/s is too slow for " + std::to_string(config.drives.size()) + " drives at " +
                      shortNumber(cycle_rate) + " Hz, one cycle takes " + inSeconds(lengths.exchange) +
                      ": expected a cycle_rate of at most " + shortNumber(1.0 / toSeconds(lengths.exchange)) + " Hz");
  }
  checkIntervals(bus, period, config);
  const Duration least = std::max(2 * period, config.worst_cycle);
  if (config.watchdog < least) {
    throw wrongSetting(bus, "watchdog", shortNumber(toSeconds(config.watchdog)),
                       "at least " + inSeconds(least) + ", the worst cycle with one silent drive (" +
                           inSeconds(lengths.worst) + " for " + std::to_string(config.slaves.size()) + " stations at " +
                           std::to_string(config.bus.baud.bitsPerSecond()) + " bit/s, slot time " +
                           inSeconds(config.bus.slotTime()) + ", " + std::to_string(config.bus.max_retries) +
                           " retries) or two cycles");
  }
  if (config.watchdog < lengths.one_left) {
    config.warnings.push_back(bus.fullName("watchdog") + ": " + inSeconds(config.watchdog) +
                              " is shorter than a cycle in which all stations but one are silent (" +
                              inSeconds(lengths.one_left) + " for " + std::to_string(config.slaves.size()) +
                              " stations): the inverter behind that one would trip, too");
  }
}

}  // namespace nord_driver

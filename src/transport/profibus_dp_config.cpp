#include "nord_driver/transport/profibus_dp_config.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nord_driver/link/serial_devices.h"
#include "nord_driver/profibus/watchdog_factors.h"
#include "nord_driver/transport/setting_checks.h"
#include "serial_line_config.h"

namespace nord_driver {

namespace {

constexpr Duration kMinHostSlotTime = std::chrono::milliseconds{20};

profibus::StationAddress readAddress(const Settings& settings, const std::string& key, std::int64_t fallback) {
  const std::int64_t value =
      fallback < 0 ? requiredInteger(settings, key, 0, 125) : integerOr(settings, key, fallback, 0, 125);
  return *profibus::StationAddress::from(static_cast<int>(value));
}

profibus::BusParameters readBus(const Settings& settings, const std::string& device) {
  const std::int64_t rate = integerOr(settings, "baud_rate", 500'000, 1, 12'000'000);
  const profibus::StationAddress master = readAddress(settings, "master_address", 1);
  profibus::BusParameters bus;
  try {
    bus = profibus::BusParameters::forBaudRate(BaudRate{static_cast<std::uint32_t>(rate)}, master);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(settings.fullName("baud_rate") + ": " + error.what());
  }
  bus.max_retries = static_cast<std::uint8_t>(integerOr(settings, "max_retries", 1, 0, 15));
  const double slot_time = numberOr(settings, "slot_time", 0.0, 0.0, 1.0, "s");
  if (slot_time > 0.0) {
    bus.slot_time = seconds(slot_time);
    if (*bus.slot_time < bus.baud.bits(bus.max_tsdr_bits + 15)) {
      throw wrongSetting(settings, "slot_time", shortNumber(slot_time),
                         "at least " + shortNumber(toSeconds(bus.baud.bits(bus.max_tsdr_bits + 15))) +
                             " s, the latest answer of a sound slave at this baud rate");
    }
  } else if (!link::isNativeUart(device)) {
    bus.slot_time = std::max(kMinHostSlotTime, bus.baud.bits(bus.slot_bits));
  }
  return bus;
}

profile::Series readSeries(const Settings& settings) {
  return profile::seriesFrom(settings.text("series").value_or("")).value_or(profile::Series::kSk5xxe);
}

// SK 1x0E and SK 2xxE reach PROFIBUS only through SK CU4/TU4-PBR (BU 2700 3.1), whose station is modular.
bool needsModularStation(profile::Series series) {
  return series == profile::Series::kSk1x0e || series == profile::Series::kSk2xxe;
}

std::vector<std::uint8_t> readUserParameters(const Settings& settings) {
  constexpr const char* kKey = "user_parameters";
  const std::string text = settings.text(kKey).value_or("");
  std::vector<std::uint8_t> bytes;
  try {
    bytes = fromHex(text);
  } catch (const std::invalid_argument&) {
    throw wrongSetting(settings, kKey, "\"" + text + "\"", "hexadecimal bytes such as \"00 1A FF\"");
  }
  if (bytes.size() > profibus::kMaxUserParameters) {
    throw wrongSetting(settings, kKey, std::to_string(bytes.size()) + " bytes",
                       "at most " + std::to_string(profibus::kMaxUserParameters));
  }
  return bytes;
}

// 10 ms to 650 s: what two factors of Set_Prm can say (BU 2700 8.1.1).
Duration readWatchdog(const Settings& settings) {
  const double value = numberOr(settings, "watchdog", 0.2, 0.01, 650.0, "s");
  const Duration next = profibus::WatchdogFactors::representableFrom(seconds(value)).value_or(seconds(650.25));
  if (std::abs(toSeconds(next) - value) > 1e-6) {
    throw wrongSetting(settings, "watchdog", shortNumber(value),
                       "a time a slave can be told: " + shortNumber(toSeconds(next)) + " s is the next longer one");
  }
  return next;
}

profibus::SlaveConfig readSlave(const Settings& settings, const profile::PpoLayout& ppo, Duration watchdog) {
  profibus::SlaveConfig slave;
  slave.address = readAddress(settings, "address", -1);
  slave.ident_number = profile::kIdentTechnologyUnit;
  slave.configuration.assign(ppo.identifiers.begin(), ppo.identifiers.end());
  slave.output_length = ppo.bytes();
  slave.input_length = ppo.bytes();
  slave.watchdog = watchdog;
  // No source gives User_Prm_Data of ident 7531h; a GSD in the field may.
  if (settings.has("user_parameters")) slave.user_parameters = readUserParameters(settings);
  return slave;
}

/// A cycle in which all drives answer, and one in which one of them is silent with all its retries.
struct CycleLengths {
  Duration exchange{};
  Duration worst{};
};

CycleLengths cycleLengths(const profibus::BusParameters& bus, const std::vector<profibus::SlaveConfig>& slaves) {
  constexpr std::uint32_t kFrameOverhead = 9;  // SD2: 68 LE LE 68 DA SA FC ... FCS 16
  CycleLengths lengths;
  Duration longest_slot{};
  for (const profibus::SlaveConfig& slave : slaves) {
    const Duration request = bus.baud.characters(slave.output_length + kFrameOverhead);
    const Duration answer = bus.baud.characters(slave.input_length + kFrameOverhead);
    lengths.exchange += request + bus.baud.bits(bus.max_tsdr_bits) + answer + bus.idleTime();
    longest_slot = std::max(longest_slot, request + bus.slotTime());
  }
  lengths.worst = lengths.exchange + (1 + bus.max_retries) * longest_slot;
  return lengths;
}

void checkTimes(const Settings& settings, const ProfibusDpConfig& config, const CycleLengths& lengths,
                double cycle_rate) {
  const Duration period = seconds(1.0 / cycle_rate);
  if (lengths.exchange > period) {
    throw ConfigError(settings.fullName("baud_rate") + ": " + std::to_string(config.bus.baud.bitsPerSecond()) +
                      " bit/s is too slow for " + std::to_string(config.slaves.size()) + " drives at " +
                      shortNumber(cycle_rate) + " Hz, one cycle takes " + shortNumber(toSeconds(lengths.exchange)) +
                      " s: expected a cycle_rate of at most " + shortNumber(1.0 / toSeconds(lengths.exchange)) + " Hz");
  }
  if (config.watchdog < std::max(2 * period, config.worst_cycle)) {
    throw wrongSetting(settings, "watchdog", shortNumber(toSeconds(config.watchdog)),
                       "at least " + shortNumber(toSeconds(std::max(2 * period, config.worst_cycle))) +
                           " s, the worst cycle with one silent drive (or two cycles)");
  }
}

}  // namespace

ProfibusDpConfig readProfibusDpConfig(const Settings& bus, const std::vector<DriveSettings>& drives,
                                      double cycle_rate) {
  ProfibusDpConfig config;
  config.line = readSerialLine(bus);
  config.device = config.line.device;
  config.bus = readBus(bus, config.device);
  config.line.baud_rate = config.bus.baud;
  config.watchdog = readWatchdog(bus);
  if (const auto files = bus.texts("gsd"); files && !files->empty()) {
    throw wrongSetting(bus, "gsd", "\"" + files->front() + "\"",
                       "an empty list: GSD files are not read by this version");
  }

  for (const DriveSettings& source : drives) {
    const Settings& settings = *source.settings;
    ProfibusDrive drive;
    drive.name = source.name;
    drive.series = readSeries(settings);
    if (needsModularStation(drive.series)) {
      throw wrongSetting(settings, "series", std::string("\"") + profile::toString(drive.series) + "\"",
                         "a series with SK TU1/2/3-PBR (sk300e, sk5xxe, sk54xe, sk700e, sk750e): the module "
                         "SK CU4/TU4-PBR is not supported by this version");
    }
    integerOr(settings, "inverter", 1, 1, 1);
    const auto ppo_type = static_cast<std::uint8_t>(integerOr(settings, "ppo_type", 1, 1, 4));
    drive.ppo = *profile::ppoLayout(ppo_type, profile::kIdentTechnologyUnit, drive.series);
    drive.slave = config.slaves.size();
    profibus::SlaveConfig slave = readSlave(settings, drive.ppo, config.watchdog);
    for (std::size_t i = 0; i < config.slaves.size(); ++i) {
      if (config.slaves[i].address == slave.address) {
        throw wrongSetting(settings, "address", std::to_string(slave.address.value()),
                           "another address than drive \"" + config.drives[i].name + "\" has");
      }
    }
    if (slave.address == config.bus.master) {
      throw wrongSetting(settings, "address", std::to_string(slave.address.value()),
                         "another address than the master's own");
    }
    config.slaves.push_back(slave);
    config.drives.push_back(drive);
  }

  const CycleLengths lengths = cycleLengths(config.bus, config.slaves);
  config.worst_cycle = std::max(lengths.worst, seconds(1.0 / cycle_rate));
  checkTimes(bus, config, lengths, cycle_rate);
  return config;
}

}  // namespace nord_driver

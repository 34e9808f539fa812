#include "transport/profibus/profibus_dp_config.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config/setting_checks.h"
#include "link/serial/serial_devices.h"
#include "profibus/watchdog_factors.h"
#include "transport/profibus/profibus_gsd_library.h"
#include "transport/profibus/profibus_stations.h"
#include "transport/profibus/profibus_times.h"
#include "transport/profibus/serial_line_config.h"

namespace nord_driver {

namespace {

constexpr Duration kMinHostSlotTime = std::chrono::milliseconds{20};

profibus::StationAddress readAddress(const Settings& settings, const std::string& key, std::int64_t fallback) {
  const std::int64_t value =
      fallback < 0 ? requiredInteger(settings, key, 0, 125) : integerOr(settings, key, fallback, 0, 125);
  return *profibus::StationAddress::from(static_cast<int>(value));
}

profibus::BusParameters readBus(const Settings& settings) {
  const std::int64_t rate = integerOr(settings, "baud_rate", 500'000, 1, 12'000'000);
  const profibus::StationAddress master = readAddress(settings, "master_address", 1);
  profibus::BusParameters bus;
  try {
    bus = profibus::BusParameters::forBaudRate(BaudRate{static_cast<std::uint32_t>(rate)}, master);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(settings.fullName("baud_rate") + ": " + error.what());
  }
  bus.max_retries = static_cast<std::uint8_t>(integerOr(settings, "max_retries", 1, 0, 15));
  return bus;
}

void readSlotTime(const Settings& settings, const std::string& device, profibus::BusParameters& bus) {
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
}

// 10 ms to 650.25 s: what two factors of Set_Prm can say (BU 2700 8.1.1). The longest is one that is advised.
Duration readWatchdog(const Settings& settings) {
  const double value = numberOr(settings, "watchdog", 0.2, 0.01, toSeconds(profibus::kLongestWatchdog), "s");
  const Duration next =
      profibus::WatchdogFactors::representableFrom(seconds(value)).value_or(profibus::kLongestWatchdog);
  if (std::abs(toSeconds(next) - value) > 1e-6) {
    throw wrongSetting(settings, "watchdog", shortNumber(value),
                       "a time a slave can be told: " + shortNumber(toSeconds(next)) + " s is the next longer one");
  }
  return next;
}

void readOptions(const Settings& bus, ProfibusDpConfig& config) {
  // A token comes round in far less than a second.
  config.bus.listen_first = seconds(numberOr(bus, "listen_first", 0.0, 0.0, 10.0, "s"));
  config.bus.sync_outputs = booleanOr(bus, "sync", false);
  config.bus.freeze_inputs = booleanOr(bus, "freeze", false);
  config.scan = booleanOr(bus, "scan", false);
  config.records.number_offset = booleanOr(bus, "record_number_offset", true);
  const std::string addressing = wordOr(bus, "record_addressing", "index", "index, slot");
  if (addressing != "index" && addressing != "slot") {
    throw wrongSetting(bus, "record_addressing", "\"" + addressing + "\"", "index or slot");
  }
  config.records.by_slot = addressing == "slot";
}

// The GSD files know how late the modules may answer.
void takeMaxTsdr(ProfibusDpConfig& config) {
  constexpr std::uint32_t kSlotMargin = 15, kMaxSlotBits = 16'383;  // T_SL >= max T_SDR + 15
  for (const ProfibusStation& station : config.stations) {
    if (station.max_tsdr_bits + kSlotMargin > kMaxSlotBits) {
      config.warnings.push_back("a GSD file names a MaxTsdr of " + std::to_string(station.max_tsdr_bits) +
                                " bit times: ignored, no slot is that long");
      continue;
    }
    config.bus.max_tsdr_bits = std::max(config.bus.max_tsdr_bits, station.max_tsdr_bits);
  }
  config.bus.slot_bits = std::max(config.bus.slot_bits, config.bus.max_tsdr_bits + kSlotMargin);
}

// Who comes for parameters and goes listens first, for far longer than a cycle of another master takes.
void listenFirst(ProfibusDpConfig& config) {
  constexpr Duration kListenFirst = std::chrono::milliseconds{500};
  config.bus.listen_first = std::max(config.bus.listen_first, kListenFirst);
}

}  // namespace

// A driver that was killed may have left a wheel turning, with the watchdog of the same configuration in its module: that
// one is to run out before anything is sent. Set_Prm without a watchdog would stop it, and nothing the wheel.
void endWithoutATrip(ProfibusDpConfig& config) {
  for (profibus::SlaveConfig& slave : config.slaves) slave.watchdog = Duration::zero();
  listenFirst(config);
  config.bus.gives_way = true;
  const Duration run_out = config.watchdog + profibus::kWatchdogTolerance;
  config.bus.listen_first = std::min(std::max(config.bus.listen_first, run_out), profibus::kLongestListening);
}

ProfibusDpConfig readProfibusDpConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate,
                                      ProfibusUse use) {
  ProfibusDpConfig config;
  config.use = use;
  config.line = readSerialLine(bus);
  config.device = config.line.device;
  config.bus = readBus(bus);
  config.line.baud_rate = config.bus.baud;
  config.watchdog = readWatchdog(bus);
  readOptions(bus, config);
  ProfibusGsdLibrary gsd{bus, config.bus.baud, config.warnings};
  readStations(bus, drives, gsd, config);
  takeMaxTsdr(config);
  readSlotTime(bus, config.device, config.bus);
  if (use == ProfibusUse::kDataExchange) {
    checkTimes(bus, cycle_rate, config);
  } else {
    listenFirst(config);
  }
  return config;
}

}  // namespace nord_driver

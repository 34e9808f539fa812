// The configuration of a PROFIBUS DP segment: read, ranged and checked against what the wire can carry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"
#include "nord_driver/link/serial_settings.h"
#include "nord_driver/profibus/bus_parameters.h"
#include "nord_driver/profibus/dp_master.h"
#include "nord_driver/profile/ppo.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/settings.h"

namespace nord_driver {

struct ProfibusDrive {
  std::string name;
  profile::Series series = profile::Series::kSk5xxe;
  profile::PpoLayout ppo;
  std::size_t slave = 0;  ///< index into `slaves`
};

struct ProfibusDpConfig {
  std::string device;         ///< as configured, for sentences
  link::SerialSettings line;  ///< everything the link is told
  profibus::BusParameters bus;
  Duration watchdog{};
  Duration worst_cycle{};  ///< with one slave silent and all its retries
  std::vector<profibus::SlaveConfig> slaves;
  std::vector<ProfibusDrive> drives;
};

/// Throws ConfigError naming key, value and what was expected: also when the cycle does not fit the baud rate or the
/// watchdog could expire in a cycle in which one slave is silent (BU 0220 4.2.3.1: the watchdog must exceed the cycle).
ProfibusDpConfig readProfibusDpConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);

}  // namespace nord_driver

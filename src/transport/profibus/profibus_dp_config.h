// The configuration of a PROFIBUS DP segment: read, ranged and checked against what the wire can carry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/drive_common.h"
#include "link/serial/serial_settings.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "profibus/bus_parameters.h"
#include "profibus/dp_master.h"
#include "transport/profibus/ppo.h"

namespace nord_driver {

/// What the segment is used for.
enum class ProfibusUse : std::uint8_t {
  kDataExchange,
  kRecordsOnly  ///< parameters by records of DP-V1 class 2: no cycle has to fit, and a station may have the address 126
};

/// The kinds of bus modules NORD has for PROFIBUS.
enum class ProfibusModule : std::uint8_t {
  kSkTu3,  ///< SK TU1/2/3-PBR, ident 7531h: one inverter
  kSkCu4,  ///< SK CU4/TU4-PBR, ident 0BA8h: modular, up to four inverters, DP-V1
};

struct ProfibusDrive : DriveCommon {
  ProfibusDrive() = default;
  explicit ProfibusDrive(const DriveCommon& common) : DriveCommon(common) {}

  profile::PpoLayout ppo;
  std::size_t slave = 0;   ///< index into `slaves` and `stations`
  std::size_t offset = 0;  ///< of its words in outputs and inputs of the station; odd behind an I/O byte
};

/// What is known of a station besides what its master needs.
struct ProfibusStation {
  ProfibusModule module = ProfibusModule::kSkTu3;
  bool io_byte = false;             ///< slot 1 carries the digital outputs and inputs of the module
  std::vector<std::size_t> drives;  ///< by inverter number
  Duration min_interval{};          ///< Min_Slave_Intervall of its GSD
  std::uint32_t max_tsdr_bits = 0;  ///< MaxTsdr of its GSD at the configured rate; 0: not told
};

/// How the records of a module are addressed and its parameters numbered: the manuals contradict each other.
struct RecordAddressing {
  bool by_slot = false;  ///< false: slot 0, index 100 and 101 to 104 (BU 0220 4.2.1); true: slots 1 and 2 to 5
                         ///< (BU 2700 6.5), with the same indices
  bool number_offset =
      true;  ///< P000 is PNU 1000 in a record too (BU 2700 6.5), and not in cyclic data only (BU 0220 5)
};

struct ProfibusDpConfig {
  std::string device;         ///< as configured, for sentences
  link::SerialSettings line;  ///< everything the link is told
  profibus::BusParameters bus;
  Duration watchdog{};
  Duration worst_cycle{};  ///< with one slave silent and all its retries
  std::vector<profibus::SlaveConfig> slaves;
  std::vector<ProfibusStation> stations;  ///< beside `slaves`
  std::vector<ProfibusDrive> drives;
  RecordAddressing records;
  ProfibusUse use = ProfibusUse::kDataExchange;
  bool scan = false;                  ///< ask every address, before the first exchange
  std::vector<std::string> warnings;  ///< accepted, and worth a look
};

/// Throws ConfigError naming key, value and what was expected: also when the cycle does not fit the baud rate or the
/// watchdog could expire in a cycle in which one slave is silent (BU 0220 4.2.3.1: the watchdog must exceed the cycle).
ProfibusDpConfig readProfibusDpConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate,
                                      ProfibusUse use = ProfibusUse::kDataExchange);

/// For a program that reads and writes parameters in data exchange and then ends: without a watchdog its end is no
/// E10.2 in the inverters (BU 2700 8.1.1), they keep the idle word; and it listens first, until the configured watchdog
/// would have run out, for at most 10 s. A master that comes later, a driver, finds it silent: see BusParameters::gives_way.
void endWithoutATrip(ProfibusDpConfig& config);

}  // namespace nord_driver

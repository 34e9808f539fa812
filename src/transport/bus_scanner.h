// A transport may tell who is on its bus, for those who want to know what to write into a configuration.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"

namespace nord_driver {

struct FoundStation {
  unsigned number = 0;    ///< address, node id or MAC id
  std::string module{};   ///< what kind of device it is: "SK TU1/2/3-PBR (7531h)"
  std::string series{};   ///< of the inverter, as far as it can be told: "sk5xxe, sk54xe"; empty: not at all
  std::string version{};  ///< of the inverter's or the module's software, with what it is of; empty: not told
  std::string note{};     ///< what else a technician should know; empty: nothing
};

struct ScanReport {
  std::string bus{};                     ///< "PROFIBUS", for "PROFIBUS station 3"
  std::string number_name{};             ///< "station", "node", "MAC id"
  std::vector<FoundStation> stations{};  ///< by number
  std::string trouble{};                 ///< why the scan did not take place, or may have missed somebody, a sentence
  std::vector<std::string> notes{};      ///< on the bus as a whole, sentences
};

/// Beside Transport, in place of configure() and what follows it.
class BusScanner {
 public:
  virtual ~BusScanner() = default;

  /// Opens the bus of these settings (`bus` of a configuration), asks every address, and closes it. Listens first: where
  /// somebody else works with the bus, nothing is sent. Nobody's outputs are touched, and nobody is led to another
  /// state. Ends early when `end_asked`. Throws ConfigError.
  virtual ScanReport scan(const Settings& bus, const std::atomic<bool>& end_asked) = 0;

  /// Why a scan by these settings asks nobody for longer than 3 s, and for how long, a sentence; empty: it does not.
  /// Throws ConfigError.
  virtual std::string quiet(const Settings& /*bus*/) const { return {}; }
};

}  // namespace nord_driver

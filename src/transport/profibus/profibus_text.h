// What a PROFIBUS master sees, in words for a technician and with the figures of the configuration.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nord_driver/core/fixed_text.h"
#include "nord_driver/transport/transport.h"
#include "profibus/bus_scan.h"
#include "profibus/dp_master.h"
#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {

/// "PROFIBUS station 3, inverter 2"; the inverter only where a module serves several.
std::string addressText(const ProfibusDpConfig& config, DriveIndex drive);

class ProfibusText {
 public:
  explicit ProfibusText(const ProfibusDpConfig& config);

  /// "PROFIBUS station 3 (left, right) fell silent: ..."
  BusEvent event(const profibus::DpEvent& event, const profibus::DpMaster& master) const noexcept;
  /// What a station waits for or needs, subject left out; empty in data exchange.
  Sentence note(std::size_t station, const profibus::DpMaster& master) const noexcept;
  /// "PROFIBUS station 3 (left, right) ", and what there is to say of it.
  Sentence named(std::size_t station, const char* what) const noexcept;
  /// Nobody answers, and what that may come of. `live_list`: who was found, if anybody has looked.
  Sentence silence(const Sentence& live_list) const noexcept;
  /// "stations 3, 126 (not addressed yet) answered"; "no station answered".
  static Sentence liveList(const profibus::BusScan& scan) noexcept;

 private:
  const ProfibusDpConfig& config_;
  std::vector<std::string> names_;  // of the stations
};

}  // namespace nord_driver

// The values of P509 and P510 by which an inverter obeys the bus it hangs on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "commissioning/drive_under_check.h"

namespace nord_driver::commissioning {

struct BusSelection {
  std::optional<std::int32_t> control_word;  ///< P509; nothing where no manual at hand prints the number
  std::optional<std::int32_t> setpoint;      ///< P510 beside 0, which means "as P509"; nothing likewise
  bool known_wrong_only = false;             ///< no number is known: only those of other sources are wrong
  std::string source;

  bool controlWordFits(std::int32_t raw) const noexcept;
  bool setpointFits(std::int32_t raw) const noexcept;
};

/// SK 1x0E and 2xxE: system bus, whichever bus is behind the module. SK 5xxE and 54xE: the bus of their option, and
/// CANopen behind SK CU4/TU4. SK 300E, 700E and 750E: a table of their own, of which the manuals print PROFIBUS and
/// InterBus only. A transport of somebody else: nothing is known, and nothing is wrong but the terminals.
BusSelection busSelection(const DriveUnderCheck& drive);

}  // namespace nord_driver::commissioning

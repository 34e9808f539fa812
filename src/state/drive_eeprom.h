// The EEPROM of one drive: whoever writes a parameter asks here first, and tells what became of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "state/eeprom_budget.h"

namespace nord_driver::state {

/// Where a drive is, not what somebody calls it: another name in the configuration does not begin a new count.
struct DrivePlace {
  std::string end_point;  ///< of the bus: "/dev/ttyUSB0", "can0"
  std::int64_t address = 0;
  unsigned inverter = 1;  ///< behind a module that serves several
  std::string series;
};

/// The name in the file: "/dev/ttyUSB0, address 3, inverter 1, sk5xxe".
std::string nameOf(const DrivePlace& place);

/// May be used by several threads.
///
/// A write to RAM costs nothing where the drive knows orders for that. Where it does not, P560 is switched off before
/// and on again after, which may be EEPROM writes themselves (drive/parameter_session.h). Whether a drive knows them
/// shows at the first write: until then each is counted before and given back after. A budget that is used up refuses
/// them where they are known to cost; nothing else refuses a write to RAM, and a write without an answer shows nothing.
class DriveEeprom {
 public:
  enum class Storage : std::uint8_t { kRam, kEeprom };
  struct Permission {
    std::string refusal;  ///< a sentence; empty: granted
    Reservation reservation;
  };
  /// What the session told of a write.
  struct Outcome {
    bool success = false;
    bool eeprom_written = false;  ///< or it may have been
    bool by_ram_order = false;    ///< with success: an order for the RAM did it, P560 had no part in it
    bool answered = true;         ///< false: nobody told what became of it, and whether P560 had a part in it
  };

  /// `budget` must outlive it. `ram_is_free`: what the bus can do (ParameterCapabilities::ram_writes).
  DriveEeprom(const EepromBudget& budget, const DrivePlace& place, std::string drive, bool ram_is_free);

  /// Before the write is begun; waits for the disk, so not in the bus cycle.
  Permission ask(Storage storage, WallTime now);
  /// After it has ended. A sentence when it could not be noted; empty when it was.
  std::string settle(Storage storage, const Permission& permission, const Outcome& outcome, WallTime now);

 private:
  enum class RamCost : std::uint8_t { kUnknown, kNothing, kSwitch };

  const EepromBudget& budget_;
  const std::string place_;
  const std::string drive_;  // as people call it
  std::atomic<RamCost> ram_cost_;
};

}  // namespace nord_driver::state

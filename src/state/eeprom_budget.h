// How often the EEPROMs of drives may be written in a day, kept in a file across runs and processes.
#pragma once

#include <cstdint>
#include <string>

#include "state/eeprom_counts.h"
#include "state/state_error.h"
#include "state/utc_day.h"

namespace nord_driver::state {

/// The writes of a day are used up: one sentence that says how to go on.
class BudgetUsedUp : public StateError {
 public:
  using StateError::StateError;
};

/// Writes that were counted before they were done.
struct Reservation {
  std::int64_t day = 0;
  std::uint32_t writes = 0;  ///< 0: none
};

/// Counts a write on the disk before it is done, so that whatever ends the program no count is lost; the one under way
/// may be counted without having been done. A day ends at 00:00 UTC. A clock that was set back goes on with the day of
/// the file: nobody gains writes by it. Each call opens the file, and may be made by any thread.
class EepromBudget {
 public:
  /// `per_day`: for each drive, 0: none at all. Opens nothing.
  EepromBudget(std::string file, std::uint64_t per_day);

  /// `drive`: its name in the file. Throws BudgetUsedUp; StateError when the file cannot be read, understood or
  /// written.
  Reservation reserve(const std::string& drive, std::uint32_t writes, WallTime now) const;
  /// What has been done already, whatever the budget. Throws StateError.
  void add(const std::string& drive, std::uint32_t writes, WallTime now) const;
  /// What was reserved and not done. Throws StateError.
  void giveBack(const std::string& drive, const Reservation& reservation) const;
  /// What the file says; zeros when it does not know the drive. Throws StateError.
  EepromCount countOf(const std::string& drive) const;

 private:
  std::string file_;
  std::uint64_t per_day_;
};

}  // namespace nord_driver::state

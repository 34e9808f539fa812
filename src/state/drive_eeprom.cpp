#include "state/drive_eeprom.h"

#include <utility>

namespace nord_driver::state {

namespace {

// P560 off, on, and on once more where the first was not confirmed.
constexpr std::uint32_t kSwitchWrites = 3;
// Where it failed: on again, twice, when the drive has come back.
constexpr std::uint32_t kRecoveryWrites = 2;

}  // namespace

std::string nameOf(const DrivePlace& place) {
  return place.end_point + ", address " + std::to_string(place.address) + ", inverter " +
         std::to_string(place.inverter) + ", " + place.series;
}

DriveEeprom::DriveEeprom(const EepromBudget& budget, const DrivePlace& place, std::string drive, bool ram_is_free)
    : budget_(budget),
      place_(nameOf(place)),
      drive_(std::move(drive)),
      ram_cost_(ram_is_free ? RamCost::kUnknown : RamCost::kSwitch) {}

DriveEeprom::Permission DriveEeprom::ask(Storage storage, WallTime now) {
  Permission permission;
  const RamCost ram_cost = ram_cost_;
  if (storage == Storage::kRam && ram_cost == RamCost::kNothing) return permission;
  try {
    permission.reservation = budget_.reserve(place_, storage == Storage::kEeprom ? 1u : kSwitchWrites, now);
  } catch (const BudgetUsedUp& error) {
    const bool switched = ram_cost == RamCost::kSwitch;
    if (storage == Storage::kEeprom || switched) {
      permission.refusal =
          "drive " + drive_ + ": " + error.what() +
          (switched ? "; its RAM is written through P560, which counts, too" : ", or write to the RAM");
    }
  } catch (const StateError& error) {
    if (storage == Storage::kEeprom) {
      permission.refusal = "drive " + drive_ +
                           ": nothing is written to its EEPROM while its writes cannot be counted: " + error.what() +
                           "; mend or remove the file; the RAM can be written";
    }
  }
  return permission;
}

std::string DriveEeprom::settle(Storage storage, const Permission& permission, const Outcome& outcome, WallTime now) {
  try {
    const bool costs_nothing = storage == Storage::kRam && !outcome.answered && ram_cost_ == RamCost::kNothing;
    if (!outcome.eeprom_written || costs_nothing) {
      if (storage == Storage::kRam && outcome.success && outcome.by_ram_order) ram_cost_ = RamCost::kNothing;
      budget_.giveBack(place_, permission.reservation);
      return {};
    }
    if (storage == Storage::kEeprom) return {};
    if (outcome.answered) ram_cost_ = RamCost::kSwitch;
    std::uint32_t more = outcome.success ? 0 : kRecoveryWrites;
    if (permission.reservation.writes == 0) more += kSwitchWrites;
    if (more != 0) budget_.add(place_, more, now);
    return {};
  } catch (const StateError& error) {
    return "drive " + drive_ + ": its EEPROM writes could not be counted: " + error.what();
  }
}

}  // namespace nord_driver::state

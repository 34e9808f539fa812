#include "state/eeprom_budget.h"

#include <algorithm>
#include <utility>

#include "state/state_file.h"

namespace nord_driver::state {

namespace {

EepromCounts countsOf(const StateFile& file, const std::string& path) {
  const auto text = file.read();
  return text ? countsFrom(*text, path) : EepromCounts{};
}

/// The count of a drive, on the day of `now` if that has begun since.
EepromCount& countOn(EepromCounts& counts, const std::string& drive, WallTime now) {
  EepromCount& count = counts[drive];
  const std::int64_t day = utcDay(now);
  if (day > count.day) {
    count.day = day;
    count.writes = 0;
  }
  return count;
}

}  // namespace

EepromBudget::EepromBudget(std::string file, std::uint64_t per_day) : file_(std::move(file)), per_day_(per_day) {}

Reservation EepromBudget::reserve(const std::string& drive, std::uint32_t writes, WallTime now) const {
  const StateFile file{file_};
  EepromCounts counts = countsOf(file, file_);
  EepromCount& count = countOn(counts, drive, now);
  if (count.writes + writes > per_day_) {
    throw BudgetUsedUp("its EEPROM has had " + std::to_string(count.writes) + " writes on " + dayText(count.day) +
                       " (UTC), and eeprom_budget allows " + std::to_string(per_day_) + " a day (counted in " + file_ +
                       "): raise eeprom_budget, or wait until " + dayText(count.day + 1) + " 00:00 UTC");
  }
  count.writes += writes;
  count.total += writes;
  const Reservation reservation{count.day, writes};
  file.replace(textOf(counts));
  return reservation;
}

void EepromBudget::add(const std::string& drive, std::uint32_t writes, WallTime now) const {
  const StateFile file{file_};
  EepromCounts counts = countsOf(file, file_);
  EepromCount& count = countOn(counts, drive, now);
  count.writes += writes;
  count.total += writes;
  file.replace(textOf(counts));
}

void EepromBudget::giveBack(const std::string& drive, const Reservation& reservation) const {
  if (reservation.writes == 0) return;
  const StateFile file{file_};
  EepromCounts counts = countsOf(file, file_);
  const auto at = counts.find(drive);
  if (at == counts.end()) return;
  EepromCount& count = at->second;
  if (count.day == reservation.day) count.writes -= std::min<std::uint64_t>(count.writes, reservation.writes);
  count.total -= std::min<std::uint64_t>(count.total, reservation.writes);
  file.replace(textOf(counts));
}

EepromCount EepromBudget::countOf(const std::string& drive) const {
  const StateFile file{file_};
  const EepromCounts counts = countsOf(file, file_);
  const auto at = counts.find(drive);
  return at == counts.end() ? EepromCount{} : at->second;
}

}  // namespace nord_driver::state

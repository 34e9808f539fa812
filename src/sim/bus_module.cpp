#include "sim/bus_module.h"

#include "sim/drive_unit.h"

namespace nord_driver::sim {

void BusModule::connect(DriveUnit& drive, unsigned place) noexcept {
  places_[place].drive = &drive;
  showLink(place);
  connected(place);
}

void BusModule::setInverterLink(unsigned place, bool intact) noexcept {
  places_[place].link = intact;
  showLink(place);
}

void BusModule::setInverterLink(bool intact) noexcept {
  for (unsigned place = 0; place < kPlaces; ++place) setInverterLink(place, intact);
}

bool BusModule::present(unsigned place) const noexcept {
  const Place& there = places_[place];
  return there.drive != nullptr && there.link && there.drive->inverter().powered();
}

void BusModule::showLinks() noexcept {
  for (unsigned place = 0; place < kPlaces; ++place) showLink(place);
}

void BusModule::showLink(unsigned place) noexcept {
  const Place& there = places_[place];
  if (there.drive == nullptr) return;
  there.drive->inverter().setModuleLink(there.link && (supply() != Supply::kOwn || powered()));
}

}  // namespace nord_driver::sim

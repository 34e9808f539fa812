// Drives that follow another one by broadcast: they get the same velocity, and their P104 and their
// directions bound that of their leader.
#include <algorithm>

#include "cycle/bus_cycle.h"

namespace nord_driver::cycle {

// Its followers hear their leader, not this; but they rest when it rests (P104), and go where it goes.
void BusCycle::setVelocity(DriveIndex drive, double velocity) noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (isOrFollows(i, drive)) drives_[i].setVelocity(RadPerSec{velocity});
  }
}

double BusCycle::minSpeed(DriveIndex drive) const noexcept {
  double speed = 0.0;
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (isOrFollows(i, drive)) speed = std::max(speed, drives_[i].minVelocity().value);
  }
  return speed;
}

// A follower may hear its leader's control word, too (P509 as broadcast): one that is to rest by OFF1 rests with all.
void BusCycle::shareRest() noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    drives_[i].setRestsWithOthers(minSpeed(leaders_[i].value_or(i)) > 0.0);
  }
}

// With P104 > 0 one that cannot turn that way rests by OFF1, and the others with it; without, it hears its leader.
double BusCycle::onlyDirection(DriveIndex drive) const noexcept {
  if (minSpeed(drive) <= 0.0) return drives_[drive].onlyDirection();
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (isOrFollows(i, drive) && drives_[i].onlyDirection() != 0.0) return drives_[i].onlyDirection();
  }
  return 0.0;
}

bool BusCycle::comesToRest(DriveIndex drive) const noexcept {
  for (DriveIndex i = 0; i < drives_.size(); ++i) {
    if (isOrFollows(i, drive) && drives_[i].comesToRest()) return true;
  }
  return false;
}

// One that is alone turns at its own P104; of several the one with the highest would run ahead of the others.
JointBounds BusCycle::boundsOf(DriveIndex drive, bool stops) const noexcept {
  const bool leads = std::find(leaders_.begin(), leaders_.end(), std::optional<DriveIndex>(drive)) != leaders_.end();
  const double least = minSpeed(drive);
  return {drives_[drive].maxVelocity().value_or(RadPerSec{}).value,
          least,
          comesToRest(drive),
          stops,
          leads ? least : 0.0,
          onlyDirection(drive)};
}

}  // namespace nord_driver::cycle

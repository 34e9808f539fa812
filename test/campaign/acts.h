// What may happen in a scenario, as a table: what users do, what happens to drives, and what happens to each bus.
#pragma once

#include <string>
#include <vector>

#include "campaign/scenario.h"

namespace nord_driver::test {

class CampaignRig;

/// What of the exchange with the drives is interrupted while an act lasts.
enum class Cuts {
  kNothing,
  kDrive,    ///< the inverter it names does not hear, or is not heard
  kStation,  ///< nor do those that share its module
  kAll,
};

/// Where an act works: two of one place are never on at the same time.
enum class Place { kDrive, kStation, kBus };

struct Range {
  int least = 0;
  int most = 0;
};

struct Act {
  const char* name;
  unsigned weight;   ///< how often it is drawn, against the others
  const char* slot;  ///< two acts with the same slot at the same place exclude each other
  Place place;
  Cuts cuts;
  Range span;  ///< ms it lasts; 0, 0: it is done at once
  Range amount;
  Range extra;
  void (*begin)(CampaignRig&, const Event&);
  void (*end)(CampaignRig&, const Event&);
  /// What it loses on the way is more than nothing for sure, once something is exchanged: a counter has to tell.
  bool counted = false;
  bool disturbs = true;  ///< the exchange may suffer: reactions are bounded by time-outs, not by cycles
  /// Not everything can happen to each drive of a rig; nullptr: it can.
  bool (*applies)(CampaignRig&, const Event&) = nullptr;
};

/// A few ms in which the driver does nothing.
void letItBeSeen(CampaignRig& rig);
/// Of its module; one that lives by the mains of its inverter goes with them.
void supply(CampaignRig& rig, const Event& event, bool on);
/// Off for as long as its model needs to see it, with `change` done meanwhile.
template <typename Change>
void changeWithoutSupply(CampaignRig& rig, const Event& event, Change change) {
  supply(rig, event, false);
  letItBeSeen(rig);
  change();
  supply(rig, event, true);
}

/// It is switched off, and another one of its series stands in its place when the mains come back: P105 is another one.
/// For buses on which P105 is read.
Act otherDrive();

/// What happens to any drive, whatever bus it is on.
const std::vector<Act>& driveActs();

}  // namespace nord_driver::test

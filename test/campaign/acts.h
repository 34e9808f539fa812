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
};

/// What happens to any drive, whatever bus it is on.
const std::vector<Act>& driveActs();

}  // namespace nord_driver::test

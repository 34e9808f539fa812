// Makes a scenario that shows a violation as short as it goes: fewer events, fewer drives, less time.
#pragma once

#include "campaign/player.h"

namespace nord_driver::test {

struct Shrunk {
  Scenario scenario;
  Violation violation;  ///< of the same invariant
  unsigned tries = 0;
};

/// Greedy: what can be left out one after the other is left out. At most `most_tries` scenarios are played.
Shrunk shrink(const Scenario& scenario, const Violation& violation, const CampaignBus& bus,
              const TransportWrap& wrap = {}, unsigned most_tries = 300);

}  // namespace nord_driver::test

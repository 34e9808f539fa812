// Many scenarios of one bus or all, on all cores, and what came of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/player.h"

namespace nord_driver::test {

struct Found {
  Scenario scenario;
  Violation violation;
};

/// Of one bus.
struct CampaignReport {
  std::string bus;
  unsigned scenarios = 0;
  unsigned stops = 0;    ///< groups the driver stopped by itself
  unsigned enabled = 0;  ///< enablings that succeeded
  unsigned answers = 0;
  unsigned arrived = 0;                   ///< axes, at another place than before
  TurnsOnlyAsCommanded::Stop worst_stop;  ///< the one nearest to its bound
  std::uint32_t worst_stop_seed = 0;
  double worst_recovery = 0.0;  ///< s
  std::uint32_t worst_recovery_seed = 0;
  std::vector<Found> found;
};

/// Plays the seeds `first` to `first + scenarios - 1`.
CampaignReport runCampaign(const CampaignBus& bus, std::uint32_t first, unsigned scenarios);
std::vector<CampaignBus> campaignBuses();
/// One line a bus, under a headline.
std::string tableOf(const std::vector<CampaignReport>& reports);
/// The violation, the scenario that shows it, and how to play it again.
std::string textOf(const Found& found);

}  // namespace nord_driver::test

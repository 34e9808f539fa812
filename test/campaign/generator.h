// Makes scenarios from seeds: systems of one to eight drives, users who drive them, and one to three causes at once.
#pragma once

#include <cstdint>

#include "campaign/rig.h"
#include "campaign/scenario.h"

namespace nord_driver::test {

Scenario makeScenario(const CampaignBus& bus, std::uint32_t seed);

}  // namespace nord_driver::test

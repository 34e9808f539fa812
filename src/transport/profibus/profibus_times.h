// What a segment can carry in time: cycle lengths, and the watchdog, rate and intervals checked against them.
#pragma once

#include "transport/profibus/profibus_dp_config.h"

namespace nord_driver {

/// Sets `worst_cycle` and warns. Throws ConfigError with the figures when a time does not fit.
void checkTimes(const Settings& bus, double cycle_rate, ProfibusDpConfig& config);

}  // namespace nord_driver

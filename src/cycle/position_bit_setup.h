// What the configuration says of the single bits of a drive that positions: reference run, teach-in, reset position, the
// element of its array, "referenced".
#pragma once

#include <vector>

#include "cycle/position_setup.h"
#include "cycle/signal_setup.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::cycle {

/// Into `setup`, the rest of which has been read. Throws ConfigError.
void readPositionBits(const Settings& drive, profile::Series series, PositionSetup& setup);

/// Throws ConfigError where users may switch one of these bits: it would begin a reference run, or choose an element.
void checkSignalsApart(const Settings& drive, const PositionSetup& setup, const std::vector<SignalSetup>& signals);

}  // namespace nord_driver::cycle

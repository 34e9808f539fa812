// The signals users read, from what a drive and its bus module have sent.
#pragma once

#include <optional>

#include "cycle/signal_setup.h"
#include "cycle/snapshot.h"
#include "nord_driver/profile/series.h"

namespace nord_driver::cycle {

/// 0 or 1; of an analogue input %. None while nobody knows: the drive is offline, or no word carries it in the set in
/// force.
std::optional<double> signalValue(const SignalSetup& signal, profile::Series series,
                                  const DriveSnapshot& drive) noexcept;

}  // namespace nord_driver::cycle

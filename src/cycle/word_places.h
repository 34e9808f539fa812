// All functions that the words of a configured drive need to have, and whether the words of its telegram suffice for them.
#pragma once

#include <cstddef>

#include "cycle/cycle_config.h"
#include "cycle/word_needs.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/transport/bus_report.h"

namespace nord_driver::cycle {

/// `carried`: setpoints and actual values of the telegram, the first included. `only_inputs`: of a node that only looks
/// on, what further setpoints and signals send does not count.
WordNeeds driveNeeds(const DriveSetup& setup, std::size_t carried, bool only_inputs) noexcept;

/// Throws ConfigError where the setpoints or the actual values of the telegram are fewer than the functions they need to
/// have: the drive would never be enabled.
void checkWordPlaces(const Settings& drive, const DriveSetup& setup, const DriveIdentity& identity, bool only_inputs);

}  // namespace nord_driver::cycle

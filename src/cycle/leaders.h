// Which drive leads which other one: `drives/<name>/follows`.
//
// A follower takes its setpoint, or its control word too, from another inverter by broadcast (P509, P510; the leading
// function P502/P503). It stands or falls together with its leader.
#pragma once

#include <vector>

#include "cycle/cycle_config.h"
#include "cycle/device_data.h"
#include "drive/drive_report.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::cycle {

/// Reads the key of every drive. Where not `all_drives` were read, a leader that is not among them is nobody's mistake.
/// Throws ConfigError.
void readLeaders(const std::vector<DriveSettings>& sources, CycleConfig& config, bool all_drives);

/// The drives that follow this one.
std::vector<DriveIndex> followersOf(const CycleConfig& config, DriveIndex leader);

/// One number per drive, the same of those that are enabled and stopped together: the drives of the base, and every other
/// one, each with its followers.
std::vector<DriveIndex> groupsOf(const CycleConfig& config);

/// What P509 or P510, as read, should not be: broadcast without `follows`, or this bus with it; and without `follows` a
/// setpoint from elsewhere than the control word, unless `told_by_telegram`: each telegram says that both come from it.
std::optional<drive::UnexpectedSource> unexpectedSource(const DeviceData& device, profile::Series series, bool follows,
                                                        bool told_by_telegram = false) noexcept;

/// "P510[-01] = 4 (broadcast): its setpoint comes from another inverter"; empty when it comes from nobody else, as far
/// as the drive has told.
Sentence followsMessage(const DeviceData& device, profile::Series series) noexcept;

}  // namespace nord_driver::cycle

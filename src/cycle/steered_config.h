// The axles of a steered base: which drives turn and steer their wheels, where they stand and how far they are steered.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/transport/transport.h"
#include "robot/steered_geometry.h"
#include "robot/urdf_geometry.h"

namespace nord_driver::cycle {

/// How far the joint of a drive that positions goes, rad; nothing where nobody says.
struct SteeringRange {
  std::optional<double> lower;
  std::optional<double> upper;
};
/// Of every drive, in the order of the drives; nothing for one that does not position.
using SteeringRanges = std::vector<std::optional<SteeringRange>>;

/// Of each list the front axle comes first.
struct SteeredConfig {
  std::vector<DriveIndex> wheels;
  std::vector<DriveIndex> steering;
  robot::SteeredAxles axles;     ///< with the corrected radius of their wheels
  double angle_tolerance = 0.0;  ///< rad, how far a wheel may stand off while the base drives
};

/// Reads the group `steered` (`front`, `rear`, `angle_tolerance`), `wheel_radius` and `wheel_radius_multiplier`.
/// `joints`: of the drives, in their order. `description`: gives the sizes that are not typed in; nullptr without one.
/// `ranges`: what holds beside `min_angle` and `max_angle`, or where these are not typed in. Throws ConfigError, and
/// std::invalid_argument where the description or the axles cannot be.
SteeredConfig readSteeredConfig(const Settings& settings, const std::vector<std::string>& joints,
                                const robot::UrdfGeometry* description, const SteeringRanges& ranges);

/// True when no size has to be taken from a description.
bool steeredSizesAreTyped(const Settings& settings);

}  // namespace nord_driver::cycle

// Limits of a drive that belongs to no base, as the user writes them in the drive's group.
#pragma once

#include <string>

#include "nord_driver/config/settings.h"
#include "robot/speed_limits.h"

namespace nord_driver::cycle {

/// `max_velocity`, `min_velocity` (rad/s at the joint), `max_acceleration`, `min_acceleration` (rad/s^2), `max_jerk`,
/// `min_jerk` (rad/s^3): a limit holds where its `max_` is given; a `min_` that is not given is the negative of its
/// `max_`. Throws ConfigError.
robot::SpeedLimits readJointLimits(const Settings& drive);

/// For a drive that has none of its own. Throws ConfigError naming the first of these keys that is there, and what was
/// `expected`.
void refuseJointLimits(const Settings& drive, const std::string& expected);

}  // namespace nord_driver::cycle

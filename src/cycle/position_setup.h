// What the configuration says of a drive that positions.
#pragma once

#include <cstdint>
#include <optional>

#include "drive/position_axis.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/profile/series.h"
#include "nord_driver/transport/bus_report.h"
#include "profile/position_words.h"
#include "profile/scaling.h"
#include "robot/urdf_geometry.h"

namespace nord_driver::cycle {

enum class DriveMode : std::uint8_t { kVelocity, kPosition };

struct PositionSetup {
  drive::PositionConfig axis;
  std::uint8_t bits = 32;  ///< of the setpoint and of the actual position
  profile::FieldOrder order = profile::FieldOrder::kLowFirst;
  /// What P610 has to be, -1: it is not looked at. Its values stand in none of the manuals at hand.
  std::int32_t setpoint_mode = -1;
};

DriveMode readDriveMode(const Settings& drive);

/// Of a drive with `mode: position`. `joint`: what the robot's description says of it. Throws ConfigError.
PositionSetup readPositionSetup(const Settings& drive, profile::Series series, const profile::JointScaling& scaling,
                                const std::optional<robot::JointRange>& joint);

/// For a drive that follows velocities. Throws ConfigError naming the first of the keys above that is there.
void refusePositionKeys(const Settings& drive);

/// Throws ConfigError where the bus does not carry the words of the position.
void checkPositionCarried(const Settings& drive, const PositionSetup& setup, profile::Series series,
                          const DriveIdentity& identity);

}  // namespace nord_driver::cycle

// The base: which drives carry it, its geometry and limits, by the names diff_drive_controller uses.
#pragma once

#include <string>
#include <vector>

#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"
#include "robot/base_kinematics.h"
#include "robot/twist_limiter.h"

namespace nord_driver::cycle {

struct BaseConfig {
  std::vector<DriveIndex> left;
  std::vector<DriveIndex> right;
  robot::BaseKind kind = robot::BaseKind::kDifferential;
  robot::BaseGeometry geometry;
  /// rad/s, one for each of `wheels()`, infinity where there is none; empty: no joint has one.
  std::vector<double> joint_velocity_limits;
  robot::TwistLimits limits;
  bool open_loop = false;
  std::size_t velocity_rolling_window_size = 10;
  std::vector<std::string> warnings;  ///< sentences on what of the robot description was taken in another way, or not

  /// The drives in the order of the kinematics: left, then right, each front to rear.
  std::vector<DriveIndex> wheels() const;
};

/// Joint of every drive, in the order of the drives; empty where a drive has none.
using JointNames = std::vector<std::string>;

/// No `left_wheel`: no base (nothing is read). `robot_description` is the text of the URDF, empty without one: it gives
/// the sizes that are not typed in and the velocity limits of the joints. Throws ConfigError.
std::optional<BaseConfig> readBaseConfig(const Settings& settings, const JointNames& joints,
                                         const std::string& robot_description = {});

}  // namespace nord_driver::cycle

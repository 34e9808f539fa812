// The base: which drives carry it, its geometry and limits, by the names diff_drive_controller uses.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cycle/steered_config.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"
#include "robot/base_kinematics.h"
#include "robot/twist_limiter.h"
#include "robot/wheel_speeds.h"

namespace nord_driver::cycle {

struct BaseConfig {
  std::vector<DriveIndex> left;
  std::vector<DriveIndex> right;
  robot::BaseKind kind = robot::BaseKind::kDifferential;
  robot::BaseGeometry geometry;          ///< of a base with sides
  std::optional<SteeredConfig> steered;  ///< of a steered base, which has no sides
  /// rad/s, one for each of `wheels()`, infinity where there is none; empty: no joint has one.
  std::vector<double> joint_velocity_limits;
  robot::TwistLimits limits;
  bool open_loop = false;
  std::size_t velocity_rolling_window_size = 10;
  std::vector<std::string> warnings;  ///< sentences on what of the robot description was taken in another way, or not

  /// The drives that turn wheels in the order of the kinematics: left, then right, each front to rear; of a steered
  /// base its axles from front to rear.
  std::vector<DriveIndex> wheels() const;
  /// All drives that stand or fall together: the wheels, then what steers them.
  std::vector<DriveIndex> drives() const;
  /// What a motion asks of the wheels, for whoever compares; throws std::invalid_argument in words.
  std::unique_ptr<robot::BaseKinematics> kinematics() const;
  /// `linear.y` means something.
  bool movesSideways() const noexcept { return kind != robot::BaseKind::kDifferential; }
};

/// The velocity limits of the wheels' joints, rad/s, infinity where there is none. Throws std::invalid_argument when
/// there are some, but not one for each wheel.
robot::WheelSpeeds wheelLimits(const BaseConfig& config);

/// Joint of every drive, in the order of the drives; empty where a drive has none.
using JointNames = std::vector<std::string>;

/// No `left_wheel`, and no `base_type: steered`: no base (nothing else is read). `robot_description` is the text of the URDF, empty without one: it gives
/// the sizes that are not typed in and the velocity limits of the joints. `ranges`: of the drives that position, for a steered base. Throws
/// ConfigError.
std::optional<BaseConfig> readBaseConfig(const Settings& settings, const JointNames& joints,
                                         const std::string& robot_description = {}, const SteeringRanges& ranges = {});

}  // namespace nord_driver::cycle

// The part of the configuration the bus cycle runs on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cycle/base_config.h"
#include "cycle/position_setup.h"
#include "cycle/word_setup.h"
#include "drive/drive.h"
#include "drive/stop_way.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/profile/parameter_request.h"
#include "nord_driver/profile/series.h"
#include "robot/speed_limits.h"

namespace nord_driver::cycle {

struct DriveSetup {
  std::string name;
  std::string joint;
  profile::Series series = profile::Series::kSk5xxe;
  drive::DriveConfig drive;
  std::optional<std::int64_t> address;  ///< as configured
  /// Hz. Counts where the drive does not tell P105, and not before it was asked: one that is wrong would move it at
  /// another speed than commanded.
  std::optional<double> typed_max_frequency;
  std::optional<double> rated_current;  ///< A
  /// What somebody wants to look at, read in the pauses of the parameter channel; a set 0 is the one in force.
  std::vector<profile::ParameterRequest> monitor = {};
  robot::SpeedLimits limits;                   ///< of the joint, rad; of a drive that belongs to no base
  WordSetup words;                             ///< what users command and read beside the velocity
  std::optional<PositionSetup> position = {};  ///< `mode: position`; none: it follows velocities
  std::string follows = {};  ///< the drive that leads this one (P509, P510 = broadcast), as configured; empty: none
  std::optional<DriveIndex> leader = {};  ///< the same; nothing where it is not among the drives that were read
};

struct RealTimeOptions {
  int priority = 0;          ///< SCHED_FIFO priority 1..99; 0 = the ordinary scheduler
  bool lock_memory = false;  ///< mlockall
};

struct CycleConfig {
  double cycle_rate = 100.0;  ///< Hz
  RealTimeOptions real_time;
  Duration service_timeout{};
  Duration shutdown_timeout{};
  Duration cmd_vel_timeout{};  ///< 0: never
  /// `drive_timeout` is as configured; if not, it is as long as two cycles with a silent station take, too.
  bool drive_timeout_given = false;
  /// Time-outs of the bus that stand when the node comes are acknowledged, once (StartAcknowledge).
  bool acknowledge_bus_timeouts = false;
  drive::StopWays stop_ways;
  std::vector<DriveSetup> drives;
  std::optional<BaseConfig> base;

  Duration period() const noexcept { return seconds(1.0 / cycle_rate); }
  /// How long teaching its position, and a reset of it, may take: at a slow rate their eight answers take longer.
  Duration setupTimeout(const DriveSetup& setup) const noexcept {
    return std::max(setup.drive.setup_timeout, 10 * period());
  }
};

/// `robot_description`: URDF text the base's sizes and joint limits are taken from; may be empty.
/// `all_drives`: `drives` are all there are, so that one which is named elsewhere must be among them.
/// Throws ConfigError naming key, value and what was expected.
CycleConfig readCycleConfig(const Settings& node, const std::vector<DriveSettings>& drives,
                            const std::string& robot_description = {}, bool all_drives = true);

}  // namespace nord_driver::cycle

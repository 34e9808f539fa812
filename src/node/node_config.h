// The whole configuration of a node: the part only its ROS side needs, and the reading of all parts. It knows nothing of
// ROS itself: `nord_param check-config` reads a file as the node would.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/eeprom_settings.h"
#include "config/tree_settings.h"
#include "config/writable_parameters.h"
#include "cycle/cycle_config.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "nord_driver/transport/transport.h"
#include "trace/trace_config.h"

namespace nord_driver::node {

/// How much longer than shutdown_timeout the end of the node may take: OFF1 that does not end becomes a quick stop, which
/// has a ramp of its own (P426).
constexpr Duration kQuickStopAtTheEnd = std::chrono::seconds{3};

struct PublishConfig {
  double publish_rate = 50.0;      ///< Hz: odom, tf, joint_states; 0: none
  double status_rate = 50.0;       ///< Hz: status of the drives
  double diagnostic_period = 1.0;  ///< s: /diagnostics
  std::string base_frame_id = "base_link";
  std::string odom_frame_id = "odom";
  bool enable_odom_tf = true;
  bool publish_cmd = false;
  bool publish_wheel_states = false;  ///< wheel_joint_controller_state, where it is offered
  bool allow_multiple_cmd_vel_publishers = true;
  std::array<double, 6> pose_covariance_diagonal{};
  std::array<double, 6> twist_covariance_diagonal{};
};

struct NodeConfig {
  std::string transport;      ///< plugin name with its prefix
  std::string bus_end_point;  ///< in place of what `bus` says; empty: as `bus` says
  bool auto_enable = false;
  bool allow_raw_parameters = false;
  bool read_only = false;                    ///< looks on: commands nothing and writes nothing
  WritableParameters writable_parameters;    ///< by users, over this node
  std::vector<std::string> parameter_files;  ///< laid over the project's, in this order
  EepromSettings eeprom;
  PublishConfig publish;
  cycle::CycleConfig cycle;
  trace::TraceConfig trace;
  std::vector<DriveSettings> drives;
  /// One for each of `drives`: the parameters of `monitor`, as they are written there.
  std::vector<std::vector<std::string>> monitor;
  std::shared_ptr<TreeSettings> bus;
  std::vector<std::string> warnings;  ///< sentences on what is accepted but done in another way, or not
};

/// Puts ~bus_end_point in place of the key of `bus` where this transport looks for its bus. Returns what it will open,
/// as configured; empty when nothing is. Throws ConfigError when it is given and the transport opens nothing.
std::string applyEndPoint(NodeConfig& config, const EndPoint& end_point);

/// A transport that has taken its part of the configuration.
struct ConfiguredTransport {
  std::string where;  ///< what it opens, as configured; may be empty
  std::vector<DriveIdentity> identities;
  std::vector<std::string> warnings;
};

/// The first wheel that cannot turn forward, since its drive has no reverse and is inverted: the base, which drives or
/// rests as a whole, never goes straight ahead. None: there is no such wheel.
std::optional<DriveIndex> wheelAgainstForward(const cycle::CycleConfig& config,
                                              const std::vector<DriveIdentity>& identities);

/// Throws ConfigError, also where a drive needs a max_frequency that is not given.
ConfiguredTransport configureTransport(NodeConfig& config, Transport& transport);

/// One sentence for each key nobody has asked for, once `config` was read from `settings` and a transport is
/// configured. `node` as in TreeSettings::unknownKeys; a robot_description among a node's parameters is known.
std::vector<std::string> unknownKeys(const TreeSettings& settings, const NodeConfig& config,
                                     const std::string& node = {});

/// Everything except what the transport itself reads (`bus`, and each drive's address). Throws ConfigError.
NodeConfig readNodeConfig(const TreeSettings& settings, const std::string& robot_description = {});

}  // namespace nord_driver::node

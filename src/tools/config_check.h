// What a configuration says, read as the driver's node would read it, without hardware and without ROS.
#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nord_driver/profile/series.h"
#include "nord_driver/transport/transport.h"
#include "robot/base_kinematics.h"
#include "robot/speed_limits.h"
#include "robot/steered_geometry.h"
#include "robot/twist_limiter.h"
#include "tools/bus_port.h"

namespace nord_driver::tools {

/// One sentence on the configuration, and the line that it is about.
struct Finding {
  int line = 0;  ///< from 1; 0: of no line
  std::string text;
};

struct CheckedDrive {
  std::string name;
  std::string joint;
  profile::Series series = profile::Series::kSk5xxe;
  unsigned inverter = 1;  ///< 1..4 behind its module
  double gear_ratio = 1.0;
  int pole_pairs = 0;
  bool inverted = false;
  double max_frequency = 0.0;    ///< Hz, of 100 %
  bool frequency_typed = false;  ///< false: `max_frequency` is what P105 is from the factory
  double max_velocity = 0.0;     ///< `unit` per second at the joint, at 100 %
  robot::SpeedLimits limits;
  bool of_base = false;
  std::string leader;                  ///< the drive this one follows; empty: none
  bool positions = false;              ///< mode: position
  bool by_element = false;             ///< position/targets: array
  std::string unit = "rad";            ///< or "m": of one that positions a prismatic joint
  std::optional<double> lower, upper;  ///< of its targets
  std::string targets;                 ///< "0 to 2.5 m", of one that positions; empty: no target is refused for a limit
};

/// A station, node or module of the bus, with the drives behind it.
struct CheckedModule {
  std::string address;  ///< "PROFIBUS station 3"
  std::string parameter_channel;
  std::string protected_by;  ///< what stops the drives when this computer dies; empty: nothing
  std::vector<CheckedDrive> drives;
};

struct CheckedAxle {
  std::string wheel, steering;  ///< drives
  robot::SteeredAxle sizes;
};

struct CheckedBase {
  robot::BaseKind kind = robot::BaseKind::kDifferential;
  std::vector<std::string> left, right;  ///< drives, from front to rear
  robot::BaseGeometry geometry;
  std::vector<CheckedAxle> axles;  ///< of a steered base, from front to rear, in place of the three above
  double angle_tolerance = 0.0;    ///< rad, likewise
  double linear_x = 0.0;           ///< m/s straight on, where the first wheel is at 100 %; 0: it cannot
  double linear_y = 0.0;           ///< m/s sideways; 0: it cannot
  double angular_z = 0.0;          ///< rad/s on the spot
  robot::TwistLimits limits;
};

/// Of what has an error only the findings are sure to be there.
struct CheckedConfig {
  std::vector<std::string> files;
  std::vector<Finding> errors, warnings;
  std::string transport;                                 ///< without its prefix, if it is one of this package's
  std::string where;                                     ///< what it opens
  double cycle_rate = 0.0;                               ///< Hz
  std::vector<std::pair<std::string, std::string>> bus;  ///< the other keys of the group `bus`, as written
  std::vector<CheckedModule> modules;
  std::optional<CheckedBase> base;

  bool accepted() const noexcept { return errors.empty(); }
};

/// P105 of every series from the factory, Hz.
constexpr double kFactoryMaxFrequency = 50.0;

/// Makes the transport of this name; throws ConfigError where there is none.
using TransportMaker = std::function<std::shared_ptr<Transport>(const std::string& name)>;

/// Reads `files`, later ones laid over earlier ones, and `urdf` (text; may be empty) as the node does. `port` takes the
/// place of what they say of the bus. Beside the first thing the node would end with, what can be told without it is
/// told of drives and bus. Throws UsageError when a file cannot be read, or `port` fits another bus.
CheckedConfig checkConfig(const std::vector<std::string>& files, const std::string& urdf, const BusPort& port,
                          const TransportMaker& make);

}  // namespace nord_driver::tools

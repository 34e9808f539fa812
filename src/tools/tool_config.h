// What a program for parameters takes of the driver's configuration: the bus, and the station of one drive.
#pragma once

#include <yaml-cpp/yaml.h>

#include <memory>
#include <string>
#include <vector>

#include "cycle/cycle_config.h"
#include "nord_driver/config/settings.h"
#include "tools/bus_port.h"

namespace nord_driver::tools {

struct ToolConfig {
  std::string transport;  ///< plugin name with its prefix
  std::shared_ptr<const Settings> bus;
  std::vector<DriveSettings> drives;  ///< as the transport is told, in the order of `cycle.drives`
  cycle::CycleConfig cycle;           ///< without a base
};

/// Puts the port in place of the file's. Throws UsageError when it is one of another transport than the file's; what a
/// transport that is not of this package opens is not known here. Throws ConfigError as below.
void choosePort(YAML::Node& file, const BusPort& port);

/// All drives of the file, to look at them: a file without a port is given one that means nothing. Throws ConfigError.
ToolConfig readToolConfig(const YAML::Node& file);

/// The drive `name` first, and after it those behind the same bus module: its words are in the same telegrams. The
/// other drives of the bus are not talked to. Throws ConfigError when there is no such drive, or its settings are
/// wrong.
ToolConfig readToolConfig(const YAML::Node& file, const std::string& name);

}  // namespace nord_driver::tools

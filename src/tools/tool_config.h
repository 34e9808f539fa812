// What a program for parameters takes of the driver's configuration: the bus, and the station of one drive.
#pragma once

#include <yaml-cpp/yaml.h>

#include <memory>
#include <string>
#include <vector>

#include "config/eeprom_settings.h"
#include "config/writable_parameters.h"
#include "cycle/cycle_config.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/transport/bus_report.h"
#include "tools/bus_port.h"

namespace nord_driver::tools {

struct ToolConfig {
  std::string transport;                     ///< plugin name with its prefix
  std::shared_ptr<const Settings> bus;       ///< without `scan`, a driver's at its start
  std::vector<DriveSettings> drives;         ///< as the transport is told, in the order of `cycle.drives`
  cycle::CycleConfig cycle;                  ///< without a base
  std::size_t asked = 1;                     ///< so many of the first drives were asked for
  bool reaches_others = true;                ///< what is sent to these gets to the further ones, too
  WritableParameters writable_parameters;    ///< by this program as by the node
  std::vector<std::string> parameter_files;  ///< of the user, laid over the project's
  EepromSettings eeprom;
};

/// The plugin name of the file's transport, with its prefix. Throws ConfigError.
std::string transportOf(const YAML::Node& file);

/// Puts the port, or the file's bus_end_point, in place of the file's bus/<key>, where the transport has its
/// `end_point`; the port in place of bus_end_point as well, where the file has that. Throws UsageError when the port is
/// one of another bus, and ConfigError as below.
void choosePort(YAML::Node& file, const BusPort& port, const EndPoint& end_point);

/// All drives of the file, to look at them: a file without a port is given one that means nothing. Throws ConfigError.
ToolConfig readToolConfig(const YAML::Node& file, const EndPoint& end_point);

/// The drive `name` first, and after it those behind the same bus module: its words are in the same telegrams. On
/// InterBus all others: words and communication references follow from the places in the ring. The other drives of the
/// bus are not talked to. Throws ConfigError when there is no such drive, or its settings are wrong.
ToolConfig readToolConfig(const YAML::Node& file, const std::string& name);
/// The same for several drives, these first and in this order. Throws ConfigError when one is named twice, too.
ToolConfig readToolConfig(const YAML::Node& file, const std::vector<std::string>& names);

}  // namespace nord_driver::tools

// The settings of one drive of a CANopen bus, and of the node it sits on.
#pragma once

#include <cstdint>

#include "config/module_settings.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "transport/canopen/canopen_config.h"
#include "transport/canopen/canopen_map.h"

namespace nord_driver {

/// What the bus gives its drives.
struct CanopenBusDefaults {
  bool sync = false;
  Duration period{};       ///< of the bus cycle
  Duration sdo_timeout{};  ///< unless the drive says otherwise
  bool heartbeat = false;  ///< we send one
};

/// All but `node`, the PDOs and the SDO server. Throws ConfigError.
CanopenDrive readCanopenDrive(const DriveSettings& source);
/// The node below `address`. Throws ConfigError.
canopen::NodeConfig readCanopenNode(const ModuleSettings& settings, const CanopenDrive& drive,
                                    const CanopenBusDefaults& bus);
/// A further inverter behind a node that is there already: what it says of the module must be what the others said.
void checkSharedNode(const ModuleSettings& settings, const canopen::NodeConfig& node, const canopen::NodeConfig& first);
CanopenPdoOptions readPdoOptions(const Settings& settings, const CanopenDrive& drive, const CanopenBusDefaults& bus);
/// The identifiers of the SDO server the drive's parameters are reached by. Throws ConfigError.
canopen::SdoChannel readSdoServer(const Settings& settings, const CanopenDrive& drive, std::uint8_t node_id);
ParameterServers readParameterServers(const Settings& settings, const CanopenDrive& drive);

}  // namespace nord_driver

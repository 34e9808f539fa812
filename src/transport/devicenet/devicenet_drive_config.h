// The settings of one drive of a DeviceNet bus, and of the module it sits behind.
#pragma once

#include "config/module_settings.h"
#include "nord_driver/config/settings.h"
#include "transport/devicenet/devicenet_config.h"

namespace nord_driver {

/// All but `module` and the offsets. Throws ConfigError.
DevicenetDrive readDevicenetDrive(const DriveSettings& source, unsigned assembly);
/// The assembly the drive's module is set to, by its output instance. Throws ConfigError.
unsigned readAssembly(const Settings& settings);
/// Its module but for the sizes of the assemblies; `node` gets what the scanner is told. Throws ConfigError.
DevicenetModule readDevicenetModule(const Settings& settings, const DevicenetDrive& drive, unsigned assembly,
                                    devicenet::NodeConfig& node);
/// A further inverter behind a module that is there already: what it says of the module must be what the others said.
void checkSharedModule(const ModuleSettings& settings, const DevicenetModule& module, const devicenet::NodeConfig& node,
                       const DevicenetModule& first, const devicenet::NodeConfig& first_node);

}  // namespace nord_driver

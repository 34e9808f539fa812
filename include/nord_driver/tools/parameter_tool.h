// Parameters of the inverters over the bus itself, without ROS: what the program nord_param does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/cycle/bus_cycle.h"
#include "nord_driver/cycle/cycle_ports.h"
#include "nord_driver/cycle/cycle_thread.h"
#include "nord_driver/cycle/parameter_access.h"
#include "nord_driver/tools/yaml_settings.h"
#include "nord_driver/transport/transport.h"

namespace nord_driver::tools {

/// An access that was carried out, or why it was not.
struct ParameterAnswer {
  bool success = false;
  std::string message;  ///< why not; may hold a note on success
  std::int32_t raw = 0;
  double value = 0.0;
  const profile::ParameterInfo* info = nullptr;  ///< what the catalogue knows
};

/// "P510[-01] = 0 (raw 0) Source setpoints"
std::string answerText(const cycle::ParameterAddress& address, const ParameterAnswer& answer);

/// Master of the bus from construction to destruction, with the driver's own cycle: the inverters get the idle word
/// 047E, nothing enables them. No other master may be on the bus, a running driver neither.
class ParameterTool {
 public:
  /// `config`: the driver's configuration; of it `bus`, `drives` and `cycle_rate` are used. Throws ConfigError.
  ParameterTool(const YamlSettings& config, std::unique_ptr<Transport> transport);
  ~ParameterTool();
  ParameterTool(const ParameterTool&) = delete;
  ParameterTool& operator=(const ParameterTool&) = delete;

  /// Throws ConfigError for a name that is not configured.
  DriveIndex driveNamed(const std::string& name) const;
  /// False: the drive did not answer within `limit`; `trouble` says what the bus knows of it.
  bool waitForDrive(DriveIndex drive, Duration limit);
  std::string trouble(DriveIndex drive);

  ParameterAnswer read(DriveIndex drive, const cycle::ParameterAddress& address);
  ParameterAnswer write(DriveIndex drive, const cycle::ParameterAddress& address, const cycle::ParameterWish& wish);
  profile::Series series(DriveIndex drive) const { return config_.drives[drive].series; }

 private:
  cycle::Completion call(cycle::Request request);

  cycle::CycleConfig config_;
  std::unique_ptr<Transport> transport_;
  std::unique_ptr<cycle::CyclePorts> ports_;
  std::unique_ptr<cycle::BusCycle> cycle_;
  std::unique_ptr<cycle::CycleThread> thread_;
  std::uint32_t last_id_ = 0;
};

}  // namespace nord_driver::tools

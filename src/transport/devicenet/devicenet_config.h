// The configuration of a DeviceNet bus: read, ranged and checked as a whole before anything is opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/drive_common.h"
#include "devicenet/scanner_config.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// How an inverter sits on DeviceNet.
enum class DevicenetConnection : std::uint8_t {
  kGateway,  ///< behind SK CU4-DEV or SK TU4-DEV: one MAC id, up to four inverters (BU 0280)
  kOption,  ///< behind its technology unit SK TU1/2/3-DEV: one MAC id, one inverter. No manual we have lists its objects
};

/// What the bytes of one inverter in the assembly mean (BU 0280 4.2.5, P162 to P165 [-03]).
enum class DevicenetProfile : std::uint8_t {
  kNord,            ///< NORD's words: control word and setpoints, status word and actual values
  kAcDrive,         ///< AC drive profile 1, as in assembly 20/70: no reverse
  kAcDriveExtended  ///< AC drive profile 2, as in assembly 21/71
};

/// Which objects carry the inverters' parameters.
enum class ParameterObjects : std::uint8_t {
  kNumbered,    ///< classes 100 to 139, one attribute each (BU 0280 4.3.9)
  kIndexObject  ///< class 199: number, index, then the value (BU 0280 4.3.10)
};

struct DevicenetDrive : DriveCommon {
  DevicenetDrive() = default;
  explicit DevicenetDrive(const DriveCommon& common) : DriveCommon(common) {}

  std::uint8_t mac = 0;
  std::size_t module = 0;  ///< index into `modules` and into `scanner.nodes`
  DevicenetConnection connection = DevicenetConnection::kGateway;
  DevicenetProfile drive_profile = DevicenetProfile::kNord;
  // Its bytes in the assemblies of its module.
  std::size_t control_offset = 0, control_bytes = 4;
  std::size_t status_offset = 0, status_bytes = 4;
  /// Value 3 lies before value 2, where there are three: of SK 300E, 700E and 750E.
  bool third_before_second = false;
  ParameterObjects parameter_objects = ParameterObjects::kNumbered;

  /// Setpoints and actual values carried both ways: 1 to 3.
  std::uint8_t processValues() const noexcept {
    const std::size_t bytes = control_bytes < status_bytes ? control_bytes : status_bytes;
    return static_cast<std::uint8_t>(bytes / 2 - 1);
  }
};

/// A bus module, and what its drives have said of it.
struct DevicenetModule {
  std::uint8_t mac = 0;
  unsigned assembly = 100;          ///< the output instance: 20, 21, 100, 101, 102, 120
  bool output_byte = false;         ///< the module's own byte is the first of the outputs
  bool input_byte = false;          ///< ... of the inputs
  std::vector<std::size_t> drives;  ///< indices into `drives`
  /// The longest pause between two outputs to it, with change of state and cyclic: the expected packet rate, as far as
  /// the module may round it up. 0: its outputs are sent in each cycle.
  Duration longest_pause{};
};

struct DevicenetConfig {
  std::string interface;       ///< "can0", "virtual:NAME"
  std::uint32_t bit_rate = 0;  ///< bit/s, compared with the interface's (0.5 %); 0: not configured
  /// How long an exchange waits for the answers of its cycle.
  Duration answer_window{};
  devicenet::ScannerConfig scanner;
  std::vector<DevicenetModule> modules;  ///< in the order of `scanner.nodes`
  std::vector<DevicenetDrive> drives;
  std::vector<std::string> warnings;  ///< of what is accepted and doubtful
};

/// The interface, its bit rate and this computer on it, without any device. Throws ConfigError.
DevicenetConfig readDevicenetBus(const Settings& bus, double cycle_rate);

/// `bus/expected_packet_rate`; none: left to the cycle. Throws ConfigError.
std::optional<Duration> readPacketRate(const Settings& bus);

/// Throws ConfigError naming key, value and what was expected.
DevicenetConfig readDevicenetConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);

}  // namespace nord_driver

// What is configured of simulated DeviceNet modules beside their drives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nord_driver/core/time.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

struct BusKind;

/// SK TU1/TU2/TU3-DEV sit on one inverter and live by its mains; SK CU4-DEV and SK TU4-DEV have 24 V of their own and
/// up to four inverters on their system bus.
enum class DnModuleKind : std::uint8_t { kOnInverter, kGateway };

/// Class 1. NORD's vendor id and product codes are printed nowhere at hand: these are the simulator's.
struct DnIdentity {
  std::uint16_t vendor = 1000;
  std::uint16_t device_type = 2;  ///< AC drive
  std::uint16_t product = 1;      ///< SK TUx-DEV 1, SK CU4/TU4-DEV 2
  std::uint8_t major = 1;
  std::uint8_t minor = 2;
  std::uint32_t serial = 0;
};

/// What the configuration says of a module's identity: the driver's keys of one of its drives, or of the module itself.
struct DnGivenIdentity {
  std::optional<std::uint16_t> vendor, device_type, product;
};

/// `DriveConfig::bus` of a drive on DeviceNet. Its address is the MAC id, `DriveConfig::place` which one it is.
struct DnDriveConfig {
  DnModuleKind kind = DnModuleKind::kOnInverter;
  unsigned assembly = 100;  ///< instance of the outputs
  bool assembly_given = false;
  unsigned control_bytes = 4;
  unsigned status_bytes = 4;
  unsigned profile = 2;  ///< P162[-03]
  // The module's own byte, which one of its drives may name: P161.
  unsigned module_input_bytes = 0;
  unsigned module_output_bytes = 0;
  /// Of SK 300E, 700E and 750E: setpoints and actual values 2 and 3 in order, and not 3 before 2 as the series has them
  /// on the other buses (BU 0020 7.3.6). Its own manual, BU 0080, is not at hand.
  bool values_in_order = false;
  DnGivenIdentity identity;
};

struct DnModuleSettings {
  std::uint8_t mac = 5;
  DnModuleKind kind = DnModuleKind::kOnInverter;
  std::string name = "SK TU3-DEV";  ///< class 1, attribute 7
  DnIdentity identity;
  DnGivenIdentity given;  ///< of `identity`; what is not, its drives may give
  std::uint32_t bit_rate = 500000;
  std::uint8_t inputs = 0;          ///< DIN1 to DIN4
  unsigned packet_rate_steps = 10;  ///< ms; the expected packet rate is rounded up to them
  /// Change of state and cyclic: connection object 4 takes our data, too (Rockwell 193-UM006A); else it takes acknowledges
  /// alone, and object 2 our data (Eaton DX-NET-DEVICENET table 10, INFICON Composer Elite tables 5-7 and 5-9). BU 0280
  /// 4.3.4 says only that 4 is "COS/Cyclic".
  bool cos_instance_4_alone = false;
  std::vector<ParameterPreset> parameters;  ///< P150 to P165
  /// Times of the simulator's choice.
  Duration parameter_time = std::chrono::milliseconds{5};
  Duration object_time = std::chrono::milliseconds{1};
  Duration start_time = std::chrono::milliseconds{100};  ///< from power on to the first duplicate-MAC request
};

/// `SimConfig::bus` of a DeviceNet bus.
struct DnBusConfig {
  std::string interface = "virtual:nord_sim";
  std::uint32_t bit_rate = 500000;
  std::vector<DnModuleSettings> modules;  ///< those of which more is said than their drives do; by `mac`
};

/// Setpoint 3 before setpoint 2, and of the actual values the same, when all three are there.
bool dnThirdBeforeSecond(const DriveConfig& drive) noexcept;
/// What a DeviceNet module makes of an inverter: P509, and where a position of 32 bits lies.
BusWiring dnWiring(const DriveConfig& drive);

/// Parameters P150 to P181 of SK CU4-DEV and SK TU4-DEV (BU 0280 5.2).
std::vector<ParameterDefinition> dnModuleParameterDefinitions();

/// `bus: {interface: virtual:NAME, bit_rate: 500000}`, of a drive module, inverter and assembly.
BusKind devicenetKind();

}  // namespace nord_driver::sim

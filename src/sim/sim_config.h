// What is simulated: the configuration both simulator programs share.
//
// The keys of a drive are the driver's own (address, ppo_type, gear_ratio, pole_pairs, inverted, joint ...), so that
// one file can be loaded by driver and simulator; what only the simulator needs is added beside them.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/canopen/can_communication.h"
#include "sim/inverter/inverter_model.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_definitions.h"
#include "sim/profibus/dp_slave.h"
#include "sim/profibus/module_station.h"
#include "sim/profibus/pkw_server.h"

namespace YAML {
class Node;
}

namespace nord_driver::sim {

/// One sentence naming the key, the value and what was expected.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ParameterPreset {
  std::uint16_t number = 0;
  unsigned set = 0;      ///< from 0
  unsigned element = 0;  ///< from 0
  std::int32_t raw = 0;
};

/// How a drive sits on a CAN bus; its node id is `DriveConfig::slave.address`.
struct CanDriveConfig {
  CanConnection connection = CanConnection::kOption;
  unsigned inverter = 1;       ///< 1-4, which one behind a gateway
  bool cia402 = false;         ///< P551 on
  bool fixed_mapping = false;  ///< 1600h.. and 1A00h.. are read-only
  /// Sub-index of array-only parameters: 4 * (n - 1) + 1 (BU 0060 p. 61) instead of n (p. 54).
  bool array_sub_by_table = false;
  /// The SDO servers 2 to 4 of a gateway are on, with 600h + id + 1 .. + 3 and 580h + id + 1 .. + 3; off they are the
  /// master's to set. No source prints their identifiers.
  bool servers_set = false;
  /// A node of its own with an id that another one has, too: wrongly set switches, or P515.
  bool doubled_id = false;
  CanIdentity identity;
  std::optional<std::uint32_t> device_type;  ///< 1000h; nothing: 0, with the drive profile 00010192h
};

struct DriveConfig {
  std::string name;
  std::string joint;
  SlaveSettings slave;
  unsigned place = 0;  ///< 1-4: FI1-FI4 behind the module with this address; 0: it has a module of its own
  MotorSettings motor;
  double gear_ratio = 1.0;
  bool inverted = false;  ///< the joint turns against the motor
  Device device;
  InverterSettings inverter;
  PkwSettings pkw;
  std::optional<CanDriveConfig> can;  ///< on a CAN bus
  std::vector<ParameterPreset> parameters;
};

/// What a CAN connection makes of an inverter: P509, and the faults of a lost master.
InverterSettings canInverterSettings(CanConnection connection, const Device& device);

/// A bus module with slots. One that is not listed is there all the same, as its drives say.
struct ModuleConfig {
  std::string name;
  ModuleSettings settings;
  std::vector<ParameterPreset> parameters;  ///< P150-P160 of the module
};

enum class BodyKind : std::uint8_t { kDiffDrive, kMecanum };

struct BodyConfig {
  std::vector<std::size_t> left;  ///< indices of drives; mecanum: two a side, the front one first
  std::vector<std::size_t> right;
  double wheel_radius = 0.0;      ///< m
  double wheel_separation = 0.0;  ///< m
  double wheel_base = 0.0;        ///< m, mecanum only
  BodyKind kind = BodyKind::kDiffDrive;
};

struct CanBusConfig {
  std::string interface = "virtual:nord_sim";
  std::uint32_t bit_rate = 250000;
};

/// Where a driver finds the simulated bus.
struct SimEndPoint {
  const char* transport;  ///< that drives such a bus: "profibus_dp"
  const char* key;        ///< of the group `bus` that says where
  std::string* value;     ///< of that key, in the configuration
};

struct SimConfig {
  SimEndPoint endPoint() noexcept {
    return can ? SimEndPoint{"canopen", "interface", &can->interface} : SimEndPoint{"profibus_dp", "device", &device};
  }

  std::string device = "/tmp/nord_sim_bus";  ///< the link the programs put to their pty
  std::uint32_t baud_rate = 500000;
  std::optional<CanBusConfig> can;  ///< the bus is a CAN bus
  std::vector<DriveConfig> drives;
  std::vector<ModuleConfig> modules;
  std::optional<BodyConfig> body;
  std::vector<std::string> warnings;  ///< keys nobody knows
};

/// Reads
///
///     bus: {device: /tmp/nord_sim_bus, baud_rate: 500000}
///     drives:
///       left: {address: 3, series: sk5xxe, ppo_type: 1, joint: left_wheel_joint, gear_ratio: 20.0, pole_pairs: 2,
///              inertia: 0.01, slip: 2.0, parameters: {P105: 50.0, P102: [2.0, 2.0, 1.0, 1.0]}}
///       arm: {address: 5, module: sk_cu4, inverter: 1, series: sk2xxe}
///     modules: {cu4: {address: 5, io_byte: true, parameters: {P151: 500}}}
///     body: {left: [left], right: [right], wheel_radius: 0.1, wheel_separation: 0.5}
///
/// or on a CAN bus
///
///     bus: {transport: canopen, interface: virtual:nord_sim, bit_rate: 250000}
///     drives:
///       left: {address: 32, series: sk5xxe, connection: option, profile: nord, joint: left_wheel_joint}
///       lift: {address: 40, series: sk2xxe, connection: gateway, inverter: 2}
///
/// Parameters are in the manual's unit, a list gives the four sets or the array elements. A body of the kind mecanum
/// has two drives a side and wheel_base, too. Without `body` the driver's keys base_type, left_wheel, right_wheel
/// (joints), wheel_radius, wheel_separation and wheel_base are taken when all are there; without these there is no
/// body. Throws ConfigError.
SimConfig readSimConfig(const YAML::Node& root);

/// `later` laid over `earlier`: maps are merged key by key, everything else is replaced.
YAML::Node mergeYaml(const YAML::Node& earlier, const YAML::Node& later);

}  // namespace nord_driver::sim

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

#include "sim/bus_settings.h"
#include "sim/inverter/inverter_model.h"
#include "sim/inverter/motor.h"
#include "sim/inverter/parameter_definitions.h"
#include "sim/inverter/pkw_server.h"

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

struct DriveConfig {
  std::string name;
  std::string joint;
  std::uint8_t address = 126;  ///< station, node id: of the module it sits behind
  unsigned place = 0;          ///< 1-4: FI1-FI4 behind a module that others may share; 0: it has one of its own
  BusSettings bus;             ///< what more its bus wants to know: DpDriveConfig, CanDriveConfig
  MotorSettings motor;
  double gear_ratio = 1.0;
  bool inverted = false;  ///< the joint turns against the motor
  Device device;
  InverterSettings inverter;
  PkwSettings pkw;
  std::vector<ParameterPreset> parameters;
};

enum class BodyKind : std::uint8_t { kDiffDrive, kMecanum, kSteered };

/// A driven wheel that is steered.
struct SteeredAxleConfig {
  std::size_t wheel = 0;     ///< index of the drive that turns the wheel
  std::size_t steering = 0;  ///< of the drive that steers it
  double x = 0.0;            ///< m, of its contact point, forward of the robot's middle
  double y = 0.0;            ///< m, to the left
};

struct BodyConfig {
  std::vector<std::size_t> left;  ///< indices of drives; mecanum: two a side, the front one first
  std::vector<std::size_t> right;
  double wheel_radius = 0.0;      ///< m
  double wheel_separation = 0.0;  ///< m
  double wheel_base = 0.0;        ///< m, mecanum only
  SteeredAxleConfig front = {};   ///< steered only
  SteeredAxleConfig rear = {};
  BodyKind kind = BodyKind::kDiffDrive;
};

struct SimConfig {
  BusSettings bus;  ///< DpBusConfig, CanBusConfig, DnBusConfig; by its type the kind of bus is known, nothing: PROFIBUS
  std::vector<DriveConfig> drives;
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
/// has two drives a side and wheel_base, too; one of the kind steered is
///
///     body: {kind: steered, front: {wheel: front, steering: front_steering, x: 0.4}, rear: {...}, wheel_radius: 0.1}
///
/// Without `body` the driver's keys base_type, left_wheel, right_wheel (joints), wheel_radius, wheel_separation and
/// wheel_base are taken when all are there, of a steered base its group `steered` (front and rear); without these there
/// is no body. `end_point`, or else the key bus_end_point, when it is not empty, takes the place of what the configuration
/// says about where the bus is: `bus/device`, `bus/interface`. Throws ConfigError.
SimConfig readSimConfig(const YAML::Node& root, const std::string& end_point = "");

/// `later` laid over `earlier`: maps are merged key by key, everything else is replaced.
YAML::Node mergeYaml(const YAML::Node& earlier, const YAML::Node& later);

}  // namespace nord_driver::sim

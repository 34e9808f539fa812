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

#include "nord_driver/sim/dp_slave.h"
#include "nord_driver/sim/motor.h"

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
  SlaveSettings slave;
  MotorSettings motor;
  double gear_ratio = 1.0;
  bool inverted = false;         ///< the joint turns against the motor
  double charging_time = 0.3;    ///< s from mains on to "switch-on disabled"
  unsigned parameter_delay = 1;  ///< telegrams a parameter order waits
  bool ram_orders = true;        ///< order labels 11-14 are known
  std::vector<ParameterPreset> parameters;
};

struct BodyConfig {
  std::vector<std::size_t> left;  ///< indices of drives
  std::vector<std::size_t> right;
  double wheel_radius = 0.0;      ///< m
  double wheel_separation = 0.0;  ///< m
};

struct SimConfig {
  std::string device = "/tmp/nord_sim_bus";  ///< the link the programs put to their pty
  std::uint32_t baud_rate = 500000;
  std::vector<DriveConfig> drives;
  std::optional<BodyConfig> body;
  std::vector<std::string> warnings;  ///< keys nobody knows
};

}  // namespace nord_driver::sim

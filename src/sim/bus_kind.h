// One kind of simulated bus: how its configuration is read, and how it is run. The table of all is in bus_kinds.cpp.
#pragma once

#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "sim/config_group.h"
#include "sim/running_bus.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

struct BusKind {
  const char* transport = "";                      ///< as the driver calls it, without the prefix
  const std::type_info* settings = &typeid(void);  ///< the type `readBus` puts into `SimConfig::bus`
  const char* end_point = "";                      ///< the key under `bus` that says where a driver opens it
  const char* place = "";         ///< where a simulated one is when nobody says; good as that key for a driver, too
  int lowest_address = 1;         ///< of a drive
  int highest_address = 127;      ///< of a drive
  std::vector<const char*> keys;  ///< of a drive, beside those of all buses; also the driver's that are not used here
  /// The group `bus`; fills `SimConfig::bus`. `root` is the whole configuration.
  void (*readBus)(const Group& root, SimConfig& config) = nullptr;
  /// The keys of one drive; fills `DriveConfig::bus` and `place`. Name, address and series are read.
  void (*readDrive)(const Group& group, DriveConfig& drive) = nullptr;
  /// All drives are read: addresses that two have, and what belongs to a module.
  void (*readModules)(const Group& root, SimConfig& config) = nullptr;
  /// Throws std::runtime_error when it cannot be opened, and ConfigError.
  std::unique_ptr<RunningBus> (*run)(const SimConfig& config) = nullptr;
};

/// The kind the configuration names by `transport` or `bus/transport`, with or without a prefix; else the first one of
/// the table.
const BusKind& busKindOf(const Group& root);
/// The same, for who has the configuration as it was read from its files.
inline const BusKind& busKindOf(const YAML::Node& root) {
  return busKindOf(Group(root, ""));
}
/// All kinds, the first one is taken when none is named.
const std::vector<BusKind>& busKinds();

}  // namespace nord_driver::sim

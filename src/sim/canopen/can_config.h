// What is configured of simulated CANopen nodes beside their drives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/canopen/can_communication.h"
#include "sim/sim_config.h"

namespace nord_driver::sim {

struct BusKind;

/// `DriveConfig::bus` of a drive on CANopen: how it sits there. Its address is the node id, `DriveConfig::place` which
/// one it is behind a gateway.
struct CanDriveConfig {
  CanConnection connection = CanConnection::kOption;
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

/// `SimConfig::bus` of a CAN bus.
struct CanBusConfig {
  std::string interface = "virtual:nord_sim";
  std::uint32_t bit_rate = 250000;
};

/// What a CAN connection makes of an inverter: P509, and the faults of a lost master.
BusWiring canWiring(CanConnection connection, const Device& device);

/// `bus: {interface: virtual:NAME, bit_rate: 250000}`, of a drive connection, inverter, profile and what only the
/// simulator needs.
BusKind canopenKind();

}  // namespace nord_driver::sim

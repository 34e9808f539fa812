// The configuration of an InterBus ring behind a gateway: read, ranged and checked as a whole before anything is opened.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "config/drive_common.h"
#include "interbus/image_map.h"
#include "link/modbus/modbus_settings.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"
#include "transport/interbus/interbus_parameters.h"

namespace nord_driver {

/// What the words of an inverter mean.
enum class InterbusProfile : std::uint8_t {
  kNord,      ///< P551 off
  kDrivecom,  ///< P551 on: DRIVECOM 21, PPO 1 and parameter set 1 only (BU 0070 4.1, 6.4)
};

struct InterbusDrive : DriveCommon {
  InterbusDrive() = default;
  explicit InterbusDrive(const DriveCommon& common) : DriveCommon(common) {}

  unsigned position = 1;  ///< in the ring
  unsigned ppo_type = 1;  ///< 1 or 2
  InterbusProfile drive_profile = InterbusProfile::kNord;
  std::uint16_t communication_reference = 2;  ///< of its PCP connection
  bool array_sub_by_table = false;            ///< as PcpDrive has it
};

struct InterbusConfig {
  link::ModbusSettings server;
  std::optional<interbus::ImageMap> map;  ///< always there once read
  /// How long a cycle waits for the inputs that answer its outputs; 0: it takes those of the cycle before.
  Duration answer_window{};
  /// The gateway's registers for Compact PCP; none: there is no parameter channel.
  std::optional<PcpMap> pcp;
  std::vector<InterbusDrive> drives;
};

/// Throws ConfigError naming key, value and what was expected.
InterbusConfig readInterbusConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);

}  // namespace nord_driver

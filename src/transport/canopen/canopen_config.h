// The configuration of a CANopen bus: read, ranged and checked as a whole before anything is opened.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canopen/master_config.h"
#include "config/drive_common.h"
#include "link/can/can_settings.h"
#include "nord_driver/config/settings.h"
#include "nord_driver/core/time.h"

namespace nord_driver {

/// How an inverter sits on CAN.
enum class CanopenConnection : std::uint8_t {
  kOption,     ///< behind its technology unit SK TU1/2/3-CAO: one node, one inverter (BU 0060)
  kOnboard,    ///< SK 5xxE on its own CAN port: the same objects, no CiA 402 (BU 0060 p. 57)
  kGateway,    ///< behind SK CU4-CAO or SK TU4-CAO: one node, up to four inverters (BU 0260)
  kSystemBus,  ///< on the NORD system bus itself. Experimental: no manual we have lists its objects
};

enum class DriveProfile : std::uint8_t {
  kNord,    ///< 3000h to 3003h, P551 off
  kCia402,  ///< 6040h to 6044h, P551 on
};

/// How the index of a parameter that is an array becomes a sub-index: manuals contradict each other (BU 0060 p. 54
/// and 61).
enum class ArraySubIndex : std::uint8_t {
  kElement,  ///< the element, [-01] = 1
  kTable,    ///< 4 * (element - 1) + 1, as for parameters with sets
};

/// How the parameters of several inverters behind one node are told apart: in no source we have.
enum class ParameterServers : std::uint8_t {
  kPerInverter,  ///< one SDO server each (BU 0260 names 1200h to 1203h)
  kIndexOffset,  ///< one server, an own range of indices each, as on EtherCAT (BU 0270 p. 43)
};

constexpr std::uint16_t kParameterBase = 0x2000;  ///< index of parameter number 0 (BU 0060 p. 61)

struct CanopenDrive : DriveCommon {
  CanopenDrive() = default;
  explicit CanopenDrive(const DriveCommon& common) : DriveCommon(common) {}

  CanopenConnection connection = CanopenConnection::kOption;
  DriveProfile drive_profile = DriveProfile::kNord;
  std::size_t node = 0;         ///< index into `master.nodes`
  std::size_t receive_pdo = 0;  ///< indices into the node's lists
  std::size_t transmit_pdo = 0;
  std::uint8_t process_values = 1;  ///< setpoints and actual values in the PDO: 1 or 3
  bool third_before_second = false;
  std::size_t sdo_server = 0;
  std::uint16_t parameter_base = kParameterBase;  ///< of the inverter's own parameters
  ArraySubIndex array_sub_index = ArraySubIndex::kElement;
  /// The longest pause between two TPDOs of a sound inverter; 0: it sends on change only, and silence says nothing.
  Duration transmit_limit{};
};

struct CanopenConfig {
  std::string interface;       ///< "can0", "virtual:NAME"
  std::uint32_t bit_rate = 0;  ///< bit/s, compared with the interface's (0.5 %); 0: not configured
  /// How long an exchange waits for the TPDOs of its cycle.
  Duration answer_window{};
  canopen::MasterConfig master;
  std::vector<CanopenDrive> drives;
};

/// The interface and its bit rate alone, for every identifier. Throws ConfigError.
link::CanSettings readCanopenLink(const Settings& bus);

/// Throws ConfigError naming key, value and what was expected.
CanopenConfig readCanopenConfig(const Settings& bus, const std::vector<DriveSettings>& drives, double cycle_rate);

}  // namespace nord_driver

// What a CANopen master is told about one node.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "canopen/sdo_request.h"
#include "nord_driver/core/fixed_vector.h"
#include "nord_driver/core/time.h"

namespace nord_driver::canopen {

/// One entry of a PDO mapping (1600h.., 1A00h..). Index 0001h..0007h with sub-index 0 is a dummy (CiA 301 7.4.7.1).
struct PdoMapping {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::uint8_t bits = 0;  ///< 8, 16, ... 64: whole bytes only

  /// As the mapping objects hold it: index, sub-index, bits.
  constexpr std::uint32_t value() const noexcept {
    return (std::uint32_t{index} << 16) | (std::uint32_t{sub_index} << 8) | bits;
  }
};
constexpr bool operator==(PdoMapping a, PdoMapping b) noexcept {
  return a.value() == b.value();
}

constexpr std::size_t kMaxMappedObjects = 8;

/// Transmission types from here on act at once, and in the same way (CiA 301 tables 66 and 69; BU 0060 p. 58).
constexpr std::uint8_t kFirstAtOnce = 254;

/// Whether a PDO of the one transmission type behaves as one of the other.
constexpr bool isSameTransmissionType(std::uint64_t a, std::uint64_t b) noexcept {
  return a == b || (a >= kFirstAtOnce && b >= kFirstAtOnce);
}

/// What a PDO shall be. It is compared with the node first; only what differs is written.
struct PdoConfig {
  std::uint16_t number = 1;                   ///< 1..512: 1 is 1400h/1600h, or 1800h/1A00h
  bool enabled = true;                        ///< false: made invalid (bit 31); everything below is left as it is
  std::uint32_t cob_id = 0;                   ///< 11 bits
  std::uint8_t transmission_type = 255;       ///< 0..240 with SYNC, 254/255 at once (252/253 are refused)
  std::optional<std::uint16_t> inhibit_time;  ///< units of 100 us (sub-index 3); nothing: left as it is. TPDO only
  std::optional<std::uint16_t> event_timer;   ///< ms (sub-index 5); nothing: left as it is
  FixedVector<PdoMapping, kMaxMappedObjects> mapping;  ///< empty: left as it is, any length is accepted
};

/// What the node is told first. What a reset does to a running motor is the drive's affair: choose with care.
enum class BootReset : std::uint8_t {
  kNone,                ///< only pre-operational, in which PDOs may be changed
  kResetCommunication,  ///< the communication objects get their power-on values
  kResetNode            ///< the whole device
};

enum class ErrorControlMode : std::uint8_t {
  kHeartbeat,  ///< the node sends its state by itself (1017h)
  kGuarding,   ///< the node is asked for it by remote frames (100Ch, 100Dh); it watches the master by the same frames
  kNone        ///< nothing but `NodeConfig::silence` tells that the node is lost; operational from its start on
};

/// Times are in whole milliseconds, 1..65535 ms.
struct ErrorControl {
  ErrorControlMode mode = ErrorControlMode::kHeartbeat;
  Duration heartbeat_time = std::chrono::milliseconds{100};     ///< 1017h of the node
  Duration heartbeat_timeout = std::chrono::milliseconds{300};  ///< longer than heartbeat_time
  Duration guard_time = std::chrono::milliseconds{100};         ///< 100Ch
  std::uint8_t life_time_factor = 3;                            ///< 100Dh, 1..255; the node life time is the product
  /// The node shall watch our own heartbeat (1016h:1) for so long; nothing: 1016h is left alone.
  std::optional<Duration> master_timeout;
};

/// A write to the object dictionary before the PDOs are configured; compared first.
struct SetupWrite {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::uint32_t value = 0;
  std::uint8_t size = 0;  ///< bytes: 1, 2 or 4
};

struct NodeConfig {
  std::uint8_t id = 0;
  // The identity that is demanded; nothing: not looked at.
  std::optional<std::uint32_t> device_type;      ///< 1000h
  std::optional<std::uint32_t> vendor_id;        ///< 1018h:1
  std::optional<std::uint32_t> product_code;     ///< 1018h:2
  std::optional<std::uint32_t> revision_number;  ///< 1018h:3
  std::optional<std::uint32_t> serial_number;    ///< 1018h:4
  BootReset reset = BootReset::kResetCommunication;
  ErrorControl error_control;
  Duration sdo_timeout = std::chrono::milliseconds{300};
  std::uint8_t sdo_retries = 2;                        ///< of one access of the start-up
  Duration boot_up_timeout = std::chrono::seconds{2};  ///< from a reset to the question whether it is there
  Duration start_timeout = std::chrono::seconds{1};    ///< from NMT start to its being seen operational
  /// So long a node that was operational and fell silent is only asked: it may hear what stops its drives without being
  /// heard itself, and a reset would make it deaf to that.
  Duration only_asked = std::chrono::seconds{15};
  /// An operational node gets no RPDO before the cycle after its first TPDOs, or for so long: the first control word
  /// may acknowledge a fault that nobody has seen yet. 0: it gets them at once.
  Duration first_answer_timeout{};
  /// An operational node that sends no TPDO for so long is lost. 0: its TPDOs say nothing of it. For one without error
  /// control, which would else wait for ever to be started again when its boot-up was not heard.
  Duration silence{};
  std::vector<SdoChannel> sdo_servers;  ///< empty: the one of the predefined connection set (600h + id, 580h + id)
  std::vector<SetupWrite> setup;
  /// It obeys all four RPDOs of the predefined connection set, as NORD delivers it (BU 0060 p. 59), and not only the ones here.
  bool obeys_predefined_pdos = false;
  std::vector<PdoConfig> receive_pdos;   ///< from the node's view: what we send
  std::vector<PdoConfig> transmit_pdos;  ///< what we receive
};

/// A gateway has one SDO server per inverter (1200h..1203h).
constexpr std::size_t kMaxSdoServers = 4;

}  // namespace nord_driver::canopen

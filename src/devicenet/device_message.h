// What a device says without being asked, on the identifier of its explicit responses: heartbeat and shutdown. The MAC
// id in their header is its own, not the master's.
#pragma once

#include <cstdint>
#include <optional>

#include "core/can_frame.h"
#include "nord_driver/core/fixed_text.h"

namespace nord_driver::devicenet {

struct DeviceHeartbeat {
  std::uint16_t identity_instance = 0;
  std::uint8_t state = 0;        ///< of the identity object (class 1, attribute 8)
  std::uint8_t fault_flags = 0;  ///< 0: none
  std::uint16_t configuration_consistency = 0;
};

struct DeviceShutdown {
  std::uint16_t class_id = 0;  ///< the object that shuts it down
  std::uint16_t instance = 0;
  std::uint16_t code = 0;
};

/// Whether the frame is such a message, whole or not: response bit, service 4Dh or 4Eh, header with the device's MAC id.
bool isDeviceMessage(const CanFrame& frame, std::uint8_t device_mac) noexcept;
/// Nothing when it is not eight bytes of that kind.
std::optional<DeviceHeartbeat> readHeartbeat(const CanFrame& frame) noexcept;
std::optional<DeviceShutdown> readShutdown(const CanFrame& frame) noexcept;

/// "operational", "major fault, recoverable", ...
const char* deviceStateText(std::uint8_t state) noexcept;
/// One sentence without its subject.
Sentence heartbeatText(const DeviceHeartbeat& heartbeat) noexcept;

}  // namespace nord_driver::devicenet

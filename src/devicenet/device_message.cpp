#include "devicenet/device_message.h"

#include "devicenet/explicit_message.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver::devicenet {
namespace {

constexpr std::uint8_t kHeartbeatByte = service::kHeartbeat | service::kResponse;
constexpr std::uint8_t kShutdownByte = service::kShutdown | service::kResponse;
constexpr std::uint8_t kFragmentAndMac = explicit_header::kFragmented | explicit_header::kMac;

}  // namespace

bool isDeviceMessage(const CanFrame& frame, std::uint8_t device_mac) noexcept {
  if (frame.remote || frame.size < 2 || (frame.data[0] & kFragmentAndMac) != device_mac) return false;
  return frame.data[1] == kHeartbeatByte || frame.data[1] == kShutdownByte;
}

std::optional<DeviceHeartbeat> readHeartbeat(const CanFrame& frame) noexcept {
  if (frame.size != kCanDataLength || frame.data[1] != kHeartbeatByte) return std::nullopt;
  ByteReader reader{frame.bytes().sub(2)};
  DeviceHeartbeat heartbeat;
  heartbeat.identity_instance = reader.u16le();
  heartbeat.state = reader.u8();
  heartbeat.fault_flags = reader.u8();
  heartbeat.configuration_consistency = reader.u16le();
  return heartbeat;
}

std::optional<DeviceShutdown> readShutdown(const CanFrame& frame) noexcept {
  if (frame.size != kCanDataLength || frame.data[1] != kShutdownByte) return std::nullopt;
  ByteReader reader{frame.bytes().sub(2)};
  DeviceShutdown shutdown;
  shutdown.class_id = reader.u16le();
  shutdown.instance = reader.u16le();
  shutdown.code = reader.u16le();
  return shutdown;
}

const char* deviceStateText(std::uint8_t state) noexcept {
  switch (state) {
    case 0:
      return "nonexistent";
    case 1:
      return "self testing";
    case 2:
      return "standby";
    case 3:
      return "operational";
    case 4:
      return "major fault, recoverable";
    case 5:
      return "major fault, unrecoverable";
    default:
      return "unknown";
  }
}

Sentence heartbeatText(const DeviceHeartbeat& heartbeat) noexcept {
  Sentence text;
  text.format("says in its heartbeat that its state is \"%s\" (%u), fault flags %02Xh",
              deviceStateText(heartbeat.state), unsigned{heartbeat.state}, unsigned{heartbeat.fault_flags});
  return text;
}

}  // namespace nord_driver::devicenet

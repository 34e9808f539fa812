// How a CAN frame travels on a virtual bus: one packet of 16 bytes on an AF_UNIX SOCK_SEQPACKET connection.
//
//   byte 0     C1h: what this is, and its version
//   byte 1     bits 0-3 the frame's size (0..8), bit 4 extended, bit 5 remote; bits 6 and 7 are 0
//   bytes 2-3  running number, low byte first: from the hub the count of frames of this member, so that a gap shows how
//              many were lost; 0 towards the hub
//   bytes 4-7  identifier, low byte first
//   bytes 8-15 data, 0 where there is none
//
// The hub listens at the abstract address "\0nord_driver/can/NAME". A member connects, sends and receives; what it
// sends comes to every other member, never back to itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/can_frame.h"

namespace nord_driver::link {

constexpr std::size_t kCanPacketLength = 16;
using CanPacket = std::array<std::uint8_t, kCanPacketLength>;

struct NumberedCanFrame {
  CanFrame frame;
  std::uint16_t number = 0;
};

CanPacket toPacket(const CanFrame& frame, std::uint16_t number) noexcept;

/// Nothing when the packet is not as described above.
std::optional<NumberedCanFrame> fromPacket(ByteView packet) noexcept;

}  // namespace nord_driver::link

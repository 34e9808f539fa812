// A Modbus telegram as a packet others can read: with the headers of IPv4 and TCP it had on the network, made up again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "link/modbus/telegram_listener.h"
#include "nord_driver/core/bytes.h"

namespace nord_driver {

/// Packets begin with an IP header (www.tcpdump.org/linktypes.html).
constexpr std::uint32_t kLinkTypeRawIp = 101;

constexpr std::size_t kPacketHeader = 40;  ///< IPv4 (RFC 791) and TCP (RFC 9293), without options
constexpr std::size_t kLongestPacket = 255;
using ModbusPacket = FixedBytes<kLongestPacket>;

/// The packet from byte `at` of the telegram on, as much of it as fits; a longer telegram is several segments, as on
/// the network. Where a field is ours to choose it says what the telegram itself does not: the identification is the
/// first register it is about, and the window tells how far from the telegram's beginning the segment is.
ModbusPacket toPacket(const link::HeardTelegram& telegram, std::size_t at) noexcept;

struct PacketContent {
  ByteView bytes;                    ///< of the telegram
  std::uint16_t first_register = 0;  ///< it is about
  std::size_t at = 0;                ///< bytes of the telegram before these
};
/// None: it is none of toPacket().
std::optional<PacketContent> packetContent(ByteView packet) noexcept;

}  // namespace nord_driver

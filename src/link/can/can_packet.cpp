#include "link/can/can_packet.h"

#include <algorithm>

namespace nord_driver::link {

namespace {

constexpr std::uint8_t kMagic = 0xC1;
constexpr std::uint8_t kSizeMask = 0x0F;
constexpr std::uint8_t kExtended = 0x10;
constexpr std::uint8_t kRemote = 0x20;
constexpr std::uint32_t kHighestId = 0x7FF;
constexpr std::uint32_t kHighestExtendedId = 0x1FFF'FFFF;

}  // namespace

CanPacket toPacket(const CanFrame& frame, std::uint16_t number) noexcept {
  CanPacket packet{};
  packet[0] = kMagic;
  packet[1] = static_cast<std::uint8_t>(frame.size | (frame.extended ? kExtended : 0) | (frame.remote ? kRemote : 0));
  packet[2] = static_cast<std::uint8_t>(number & 0xFFu);
  packet[3] = static_cast<std::uint8_t>(number >> 8);
  for (std::size_t i = 0; i < 4; ++i) packet[4 + i] = static_cast<std::uint8_t>(frame.id >> (8 * i) & 0xFFu);
  const ByteView bytes = frame.bytes();
  std::copy(bytes.begin(), bytes.end(), packet.begin() + 8);
  return packet;
}

std::optional<NumberedCanFrame> fromPacket(ByteView packet) noexcept {
  if (packet.size() != kCanPacketLength) return std::nullopt;
  ByteReader reader{packet};
  const std::uint8_t magic = reader.u8();
  const std::uint8_t form = reader.u8();
  if (magic != kMagic || (form & ~(kSizeMask | kExtended | kRemote)) != 0) return std::nullopt;
  NumberedCanFrame numbered;
  numbered.number = reader.u16le();
  CanFrame& frame = numbered.frame;
  frame.id = reader.u32le();
  frame.size = form & kSizeMask;
  frame.extended = (form & kExtended) != 0;
  frame.remote = (form & kRemote) != 0;
  if (frame.size > kCanDataLength || frame.id > (frame.extended ? kHighestExtendedId : kHighestId)) return std::nullopt;
  const ByteView data = reader.rest();
  for (std::size_t i = 0; i < frame.size && !frame.remote; ++i) frame.data[i] = data[i];
  return numbered;
}

}  // namespace nord_driver::link

#include "transport/interbus/modbus_packet.h"

#include <algorithm>

namespace nord_driver {

namespace {

constexpr std::size_t kIpHeader = 20;
constexpr std::uint8_t kTcp = 6;
constexpr std::uint8_t kAck = 0x10, kPushAck = 0x18;
constexpr std::uint16_t kWindow = 0xFFFF;
constexpr std::size_t kIpChecksumAt = 10, kTcpChecksumAt = kIpHeader + 16;
// Where the connection has no IPv4 addresses: two of those that are for documents (RFC 5737).
constexpr std::uint32_t kOwnExample = 0xC0000201, kServerExample = 0xC0000202;

std::uint32_t sumOf(ByteView bytes, std::uint32_t sum) noexcept {
  for (std::size_t i = 0; i < bytes.size(); ++i) sum += i % 2 == 0 ? std::uint32_t{bytes[i]} << 8 : bytes[i];
  return sum;
}

std::uint16_t checksum(std::uint32_t sum) noexcept {
  while (sum > 0xFFFFu) sum = (sum >> 16) + (sum & 0xFFFFu);
  return static_cast<std::uint16_t>(~sum & 0xFFFFu);
}

void put(ModbusPacket& packet, std::size_t at, std::uint16_t value) noexcept {
  packet[at] = static_cast<std::uint8_t>(value >> 8);
  packet[at + 1] = static_cast<std::uint8_t>(value & 0xFFu);
}

}  // namespace

ModbusPacket toPacket(const link::HeardTelegram& telegram, std::size_t at) noexcept {
  const ByteView part = telegram.bytes.sub(at, kLongestPacket - kPacketHeader);
  const bool is_last = at + part.size() == telegram.bytes.size();
  const std::uint32_t own = telegram.own_address != 0 ? telegram.own_address : kOwnExample;
  const std::uint32_t server = telegram.server_address != 0 ? telegram.server_address : kServerExample;
  // Sequence numbers begin at 1, as after a connection was made with 0.
  const auto offset = static_cast<std::uint32_t>(at);
  const std::uint32_t sent = 1 + telegram.bytes_sent + (telegram.sent ? offset : 0);
  const std::uint32_t received = 1 + telegram.bytes_received + (telegram.sent ? 0 : offset);

  ModbusPacket packet;
  ByteWriter writer{packet};
  writer.u8(0x45);
  writer.u8(0);
  writer.u16be(static_cast<std::uint16_t>(kPacketHeader + part.size()));
  writer.u16be(telegram.first_register);
  writer.u16be(0x4000);  // not to be fragmented
  writer.u8(64);
  writer.u8(kTcp);
  writer.u16be(0);  // checksum: below
  writer.u32be(telegram.sent ? own : server);
  writer.u32be(telegram.sent ? server : own);
  writer.u16be(telegram.sent ? telegram.own_port : telegram.server_port);
  writer.u16be(telegram.sent ? telegram.server_port : telegram.own_port);
  writer.u32be(telegram.sent ? sent : received);
  writer.u32be(telegram.sent ? received : sent);
  writer.u8(0x50);
  writer.u8(is_last ? kPushAck : kAck);
  writer.u16be(static_cast<std::uint16_t>(kWindow - at));
  writer.u16be(0);  // checksum: below
  writer.u16be(0);
  writer.append(part);

  const ByteView whole{packet};
  put(packet, kIpChecksumAt, checksum(sumOf(whole.sub(0, kIpHeader), 0)));
  const auto length = static_cast<std::uint32_t>(packet.size() - kIpHeader);
  const std::uint32_t pseudo_header = sumOf(whole.sub(12, 8), kTcp + length);
  put(packet, kTcpChecksumAt, checksum(sumOf(whole.sub(kIpHeader), pseudo_header)));
  return packet;
}

std::optional<PacketContent> packetContent(ByteView packet) noexcept {
  if (packet.size() < kPacketHeader || packet[0] != 0x45) return std::nullopt;
  const auto u16 = [&](std::size_t at) { return static_cast<std::uint16_t>(packet[at] << 8 | packet[at + 1]); };
  PacketContent content;
  content.bytes = packet.sub(kPacketHeader);
  content.first_register = u16(4);
  content.at = static_cast<std::size_t>(kWindow - u16(kIpHeader + 14));
  return content;
}

}  // namespace nord_driver

#include "core/can_trace.h"

#include <algorithm>
#include <cstdio>

namespace nord_driver {

namespace {

constexpr std::uint32_t kExtended = 0x80000000, kRemote = 0x40000000;
constexpr std::uint32_t kStandardMask = 0x7FF, kExtendedMask = 0x1FFFFFFF;
constexpr std::size_t kHeader = 8;

}  // namespace

CanPacket toPacket(const CanFrame& frame) noexcept {
  CanPacket packet;
  ByteWriter writer{packet};
  writer.u32be(frame.id | (frame.extended ? kExtended : 0) | (frame.remote ? kRemote : 0));
  writer.u8(frame.size);
  for (int reserved = 0; reserved < 3; ++reserved) writer.u8(0);
  for (const std::uint8_t byte : frame.bytes()) writer.u8(byte);
  return packet;
}

std::optional<CanFrame> fromPacket(ByteView packet) noexcept {
  if (packet.size() < kHeader || packet[4] > kCanDataLength) return std::nullopt;
  ByteReader reader{packet};
  const std::uint32_t id = reader.u32be();
  CanFrame frame;
  frame.extended = (id & kExtended) != 0;
  frame.remote = (id & kRemote) != 0;
  frame.id = id & (frame.extended ? kExtendedMask : kStandardMask);
  frame.size = packet[4];
  const ByteView data = packet.sub(kHeader);
  if (data.size() != frame.bytes().size()) return std::nullopt;
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

std::string candumpText(const CanFrame& frame) {
  char id[16];
  std::snprintf(id, sizeof id, frame.extended ? "%08X#" : "%03X#", frame.id);
  std::string text = id;
  if (frame.remote) return text + "R" + std::to_string(frame.size);
  for (const std::uint8_t byte : frame.bytes()) {
    char hex[4];
    std::snprintf(hex, sizeof hex, "%02X", byte);
    text += hex;
  }
  return text;
}

}  // namespace nord_driver

#include "trace/pcap.h"

namespace nord_driver::trace {

namespace {

constexpr std::uint32_t kMagicMicroseconds = 0xA1B2C3D4;
constexpr std::uint32_t kMaxPacket = 65535;

}  // namespace

Pcap::Pcap(std::uint32_t link_type) {
  u32(kMagicMicroseconds);
  u16(2);  // version 2.4
  u16(4);
  u32(0);  // reserved
  u32(0);
  u32(kMaxPacket);
  u32(link_type);
}

void Pcap::add(std::chrono::microseconds time, ByteView packet) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(time);
  u32(static_cast<std::uint32_t>(whole.count()));
  u32(static_cast<std::uint32_t>((time - whole).count()));
  const auto length = static_cast<std::uint32_t>(packet.size());
  u32(length);  // in the file
  u32(length);  // on the line
  for (const std::uint8_t byte : packet) bytes_.push_back(static_cast<char>(byte));
}

void Pcap::u16(std::uint32_t value) {
  for (unsigned shift = 0; shift < 16; shift += 8) bytes_.push_back(static_cast<char>(value >> shift & 0xFFu));
}

void Pcap::u32(std::uint32_t value) {
  u16(value);
  u16(value >> 16);
}

}  // namespace nord_driver::trace

// A capture file as Wireshark, tshark and tcpdump read it (draft-ietf-opsawg-pcap), microseconds, low byte first.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "nord_driver/core/bytes.h"

namespace nord_driver::trace {

/// Collects the bytes of one file: its header, then a record per packet.
class Pcap {
 public:
  explicit Pcap(std::uint32_t link_type);

  /// `time` since 1970-01-01 UTC, at most until 2106.
  void add(std::chrono::microseconds time, ByteView packet);

  const std::string& bytes() const noexcept { return bytes_; }

 private:
  void u16(std::uint32_t value);
  void u32(std::uint32_t value);

  std::string bytes_;
};

}  // namespace nord_driver::trace

// SDO block download (CiA 301 7.2.4.3.9 to .11): many segments for one acknowledgement, and a check sum over all.
#pragma once

#include <cstddef>
#include <cstdint>

#include "canopen/sdo_transfer.h"

namespace nord_driver::canopen {

/// Writes, from the server's answer to the initiation on. What the server did not get is sent again in the next block.
class BlockDownload {
 public:
  /// `block_size`: segments the server takes at once, 1 to 127. `crc`: the server checks a check sum.
  BlockDownload(std::uint8_t block_size, bool crc) noexcept : block_size_(block_size), crc_(crc) {}

  SdoStep handle(const SdoBytes& response, SdoBuffer& buffer) noexcept;
  bool pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept;

  /// Repeated ones too. As long as it grows, the server's time to acknowledge has not begun.
  std::size_t segmentsSent() const noexcept { return total_sent_; }

 private:
  enum class State : std::uint8_t { kSending, kAwaitAcknowledge, kToEnd, kAwaitEnd };

  SdoStep handleAcknowledge(const SdoBytes& response, std::size_t size) noexcept;

  std::uint8_t block_size_;
  bool crc_;
  State state_ = State::kSending;
  std::size_t confirmed_ = 0;  // segments the server has
  std::uint8_t sent_ = 0;      // of this block
  std::size_t total_sent_ = 0;
  unsigned repeats_ = 0;
};

}  // namespace nord_driver::canopen

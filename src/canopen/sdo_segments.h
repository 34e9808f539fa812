// Segmented SDO transfers (CiA 301 7.2.4.3.4 and .7): seven bytes a frame, each answered, told apart by a toggle bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "canopen/sdo_transfer.h"

namespace nord_driver::canopen {

/// Reads, from the server's answer to the initiation on.
class SegmentedUpload {
 public:
  /// `size`: bytes to come, when the server told.
  explicit SegmentedUpload(std::optional<std::uint32_t> size) noexcept : size_(size) {}

  /// Appends to the buffer.
  SdoStep handle(const SdoBytes& response, SdoBuffer& buffer) noexcept;
  /// The next request; false when an answer has to come first.
  bool pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept;

 private:
  std::optional<std::uint32_t> size_;
  SdoBytes last_{};
  bool toggle_ = false;
  bool to_send_ = true;
  bool started_ = false;
};

/// Writes, from the server's answer to the initiation on.
class SegmentedDownload {
 public:
  SdoStep handle(const SdoBytes& response, SdoBuffer& buffer) noexcept;
  bool pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept;

 private:
  std::size_t confirmed_ = 0;  // bytes the server has
  std::size_t sent_ = 0;
  bool toggle_ = false;
  bool to_send_ = true;
  bool started_ = false;
};

}  // namespace nord_driver::canopen

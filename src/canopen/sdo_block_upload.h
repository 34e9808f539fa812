// SDO block upload (CiA 301 7.2.4.3.13 to .15): many segments for one acknowledgement, and a check sum over all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "canopen/sdo_transfer.h"

namespace nord_driver::canopen {

/// Segments of a block that we let the server send without an acknowledgement. Small, so that the receive queue of a
/// busy bus holds them. Not 1: a repeated last segment could then not be told from the next one.
constexpr std::uint8_t kSdoBlockSize = 32;
/// Up to this size a plain upload takes no more frames, and the server may choose it.
constexpr std::uint8_t kSdoPlainThreshold = 28;
/// How often in a row a block may bring nothing new.
constexpr unsigned kSdoBlockRepeats = 3;

/// Reads, from the server's answer to the initiation on. Segments that are missing are asked for again: the
/// acknowledgement names the last one that came in order, and the server goes on behind it.
class BlockUpload {
 public:
  /// `size`: bytes to come, when the server told. `crc`: the server sends a check sum.
  BlockUpload(std::optional<std::uint32_t> size, bool crc) noexcept : size_(size), crc_(crc) {}

  SdoStep handle(const SdoBytes& response, SdoBuffer& buffer) noexcept;
  bool pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept;

  /// Nothing came for half of the time-out. In the middle of a block its end may be lost, and only an acknowledgement
  /// brings it again: false when that was tried already, or does not help.
  bool handleSilence() noexcept;
  /// That half counts; otherwise the whole.
  bool awaitsSegments() const noexcept { return state_ != State::kEnding; }
  /// What the server is told when the data are complete; it does not answer.
  static SdoBytes confirmation() noexcept;

 private:
  enum class State : std::uint8_t {
    kToStart,
    kReceiving,
    kToAcknowledge,
    kEnding,  ///< all segments are there: the check sum is next
  };

  SdoStep handleSegment(const SdoBytes& segment, SdoBuffer& buffer) noexcept;
  SdoStep handleEnd(const SdoBytes& response, SdoBuffer& buffer) noexcept;
  SdoStep acknowledge() noexcept;

  std::optional<std::uint32_t> size_;
  bool crc_;
  State state_ = State::kToStart;
  std::uint8_t in_order_ = 0;       // last segment of this block that came in order
  std::uint8_t last_of_block_ = 0;  // sequence number that ended the block before
  SdoBytes last_segment_{};
  bool complete_ = false;  // the segment marked as the last one is in the buffer
  bool heard_ = false;     // a segment of this block
  bool silent_ = false;    // nothing came for half of the time-out
  unsigned repeats_ = 0;
};

}  // namespace nord_driver::canopen

// The command bytes of SDO frames: encoding of what we send, and what the server's answer to an initiation says
// (CiA 301 7.2.4.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "canopen/sdo_transfer.h"

namespace nord_driver::canopen {

/// Data bytes an initiation and its answer can carry themselves.
constexpr std::size_t kExpeditedLength = 4;

// Bits 7 to 5 of the first byte; the same number means another thing in each direction.
constexpr std::uint8_t kCommandMask = 0xE0;
constexpr std::uint8_t kAbort = 0x80;

// From the client.
constexpr std::uint8_t kAskSegment = 0x60;
constexpr std::uint8_t kAskUpload = 0x40;
constexpr std::uint8_t kAskDownload = 0x20;
constexpr std::uint8_t kAskBlockUpload = 0xA0;
constexpr std::uint8_t kAskBlockDownload = 0xC0;

// From the server.
constexpr std::uint8_t kUploadSegment = 0x00;
constexpr std::uint8_t kDownloadSegment = 0x20;
constexpr std::uint8_t kUploadInitiated = 0x40;
constexpr std::uint8_t kDownloadInitiated = 0x60;
constexpr std::uint8_t kBlockDownloadAnswer = 0xA0;
constexpr std::uint8_t kBlockUploadAnswer = 0xC0;

constexpr std::uint8_t kToggle = 0x10;       // of a segment
constexpr std::uint8_t kLastSegment = 0x01;  // of a segment
constexpr std::uint8_t kLastOfAll = 0x80;    // of a block's segment: bit 7; bits 0 to 6 are the sequence number
constexpr std::uint8_t kMaxSequence = 127;

constexpr std::uint8_t command(const SdoBytes& bytes) noexcept {
  return static_cast<std::uint8_t>(bytes[0] & kCommandMask);
}

/// A frame that begins with `first` and names the object of `request`.
SdoBytes objectFrame(std::uint8_t first, const SdoRequest& request) noexcept;
bool namesObject(const SdoBytes& bytes, const SdoRequest& request) noexcept;
void putU32(SdoBytes& bytes, std::uint32_t value) noexcept;  ///< in bytes 4 to 7
std::uint32_t u32(const SdoBytes& bytes) noexcept;           ///< of bytes 4 to 7

/// The first frame of a transfer; `data` of a write.
SdoBytes initiation(const SdoRequest& request, ByteView data) noexcept;

/// The server's answer to it.
struct Initiated {
  enum class Kind : std::uint8_t { kOther, kExpedited, kSegmentedUpload, kDownload, kBlockUpload, kBlockDownload };
  Kind kind = Kind::kOther;
  std::uint8_t count = 0;             ///< expedited: data bytes, in bytes 4 and on
  std::optional<std::uint32_t> size;  ///< of an upload, when the server told
  bool crc = false;                   ///< block: the server knows the check sum
  std::uint8_t block_size = 0;        ///< block download
};
Initiated readInitiated(const SdoBytes& response) noexcept;

}  // namespace nord_driver::canopen

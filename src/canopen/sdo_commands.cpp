#include "canopen/sdo_commands.h"

#include "canopen/sdo_block_upload.h"

namespace nord_driver::canopen {

namespace {

constexpr std::uint8_t kExpedited = 0x02;
constexpr std::uint8_t kSizeTold = 0x01;
constexpr std::uint8_t kBlockCrc = 0x04;
constexpr std::uint8_t kBlockSizeTold = 0x02;
constexpr std::uint8_t kBlockUploadSubcommand = 0x01;
constexpr std::uint8_t kBlockDownloadSubcommand = 0x03;

}  // namespace

SdoBytes objectFrame(std::uint8_t first, const SdoRequest& request) noexcept {
  SdoBytes bytes{};
  bytes[0] = first;
  bytes[1] = static_cast<std::uint8_t>(request.index & 0xFFu);
  bytes[2] = static_cast<std::uint8_t>(request.index >> 8);
  bytes[3] = request.sub_index;
  return bytes;
}

// Low byte of the index first: one read example prints them the other way round, the write example does not (BU 0060
// p. 61 and 62).
bool namesObject(const SdoBytes& bytes, const SdoRequest& request) noexcept {
  return bytes[1] == (request.index & 0xFFu) && bytes[2] == request.index >> 8 && bytes[3] == request.sub_index;
}

void putU32(SdoBytes& bytes, std::uint32_t value) noexcept {
  for (std::size_t i = 0; i < 4; ++i) bytes[4 + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

std::uint32_t u32(const SdoBytes& bytes) noexcept {
  return ByteReader{ByteView{bytes}.sub(4)}.u32le();
}

SdoBytes initiation(const SdoRequest& request, ByteView data) noexcept {
  if (!request.write) {
    if (!request.block) return objectFrame(kAskUpload, request);
    SdoBytes bytes = objectFrame(kAskBlockUpload | kBlockCrc, request);
    bytes[4] = kSdoBlockSize;
    bytes[5] = kSdoPlainThreshold;
    return bytes;
  }
  if (request.block) {
    SdoBytes bytes = objectFrame(kAskBlockDownload | kBlockCrc | kBlockSizeTold, request);
    putU32(bytes, static_cast<std::uint32_t>(data.size()));
    return bytes;
  }
  if (data.size() > kExpeditedLength) {
    SdoBytes bytes = objectFrame(kAskDownload | kSizeTold, request);
    putU32(bytes, static_cast<std::uint32_t>(data.size()));
    return bytes;
  }
  const std::size_t unused = kExpeditedLength - data.size();
  SdoBytes bytes = objectFrame(static_cast<std::uint8_t>(kAskDownload | unused << 2 | kExpedited | kSizeTold), request);
  for (std::size_t i = 0; i < data.size(); ++i) bytes[4 + i] = data[i];
  return bytes;
}

Initiated readInitiated(const SdoBytes& response) noexcept {
  Initiated read;
  const std::uint8_t first = response[0];
  switch (command(response)) {
    case kUploadInitiated:
      if ((first & kExpedited) != 0) {
        read.kind = Initiated::Kind::kExpedited;
        read.count = kExpeditedLength;
        if ((first & kSizeTold) != 0) {
          read.count = static_cast<std::uint8_t>(kExpeditedLength - (first >> 2 & 3u));
          read.size = read.count;
        }
      } else {
        read.kind = Initiated::Kind::kSegmentedUpload;
        if ((first & kSizeTold) != 0) read.size = u32(response);
      }
      break;
    case kDownloadInitiated:
      read.kind = Initiated::Kind::kDownload;
      break;
    case kBlockUploadAnswer:
      if ((first & kBlockUploadSubcommand) != 0) break;
      read.kind = Initiated::Kind::kBlockUpload;
      read.crc = (first & kBlockCrc) != 0;
      if ((first & kBlockSizeTold) != 0) read.size = u32(response);
      break;
    case kBlockDownloadAnswer:
      if ((first & kBlockDownloadSubcommand) != 0) break;
      read.kind = Initiated::Kind::kBlockDownload;
      read.crc = (first & kBlockCrc) != 0;
      read.block_size = response[4];
      break;
    default:
      break;
  }
  return read;
}

}  // namespace nord_driver::canopen

#include "canopen/sdo_block_download.h"

#include "canopen/sdo_abort.h"
#include "canopen/sdo_block_upload.h"
#include "canopen/sdo_commands.h"
#include "canopen/sdo_crc.h"

namespace nord_driver::canopen {

namespace {

constexpr std::uint8_t kEndOfDownload = kAskBlockDownload | 0x01;
constexpr std::uint8_t kAcknowledged = kBlockDownloadAnswer | 0x02;
constexpr std::uint8_t kEnded = kBlockDownloadAnswer | 0x01;
constexpr std::uint8_t kAnswerMask = kCommandMask | 0x03;

std::size_t segmentCount(std::size_t bytes) noexcept {
  return (bytes + kSdoSegmentLength - 1) / kSdoSegmentLength;
}

}  // namespace

bool BlockDownload::pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept {
  request = {};
  const std::size_t segments = segmentCount(buffer.size());
  if (state_ == State::kSending) {
    const std::size_t number = confirmed_ + sent_;
    const bool last = number + 1 == segments;
    const ByteView segment = ByteView{buffer}.sub(number * kSdoSegmentLength, kSdoSegmentLength);
    ++sent_;
    ++total_sent_;
    request[0] = static_cast<std::uint8_t>((last ? kLastOfAll : 0) | sent_);
    for (std::size_t i = 0; i < segment.size(); ++i) request[1 + i] = segment[i];
    if (last || sent_ == block_size_) state_ = State::kAwaitAcknowledge;
    return true;
  }
  if (state_ == State::kToEnd) {
    const std::size_t unused = segments * kSdoSegmentLength - buffer.size();
    const std::uint16_t crc = crc_ ? sdoCrc(buffer) : std::uint16_t{0};
    request[0] = static_cast<std::uint8_t>(kEndOfDownload | unused << 2);
    request[1] = static_cast<std::uint8_t>(crc & 0xFFu);
    request[2] = static_cast<std::uint8_t>(crc >> 8);
    state_ = State::kAwaitEnd;
    return true;
  }
  return false;
}

SdoStep BlockDownload::handle(const SdoBytes& response, SdoBuffer& buffer) noexcept {
  const auto answer = static_cast<std::uint8_t>(response[0] & kAnswerMask);
  if (state_ == State::kAwaitAcknowledge && answer == kAcknowledged) {
    return handleAcknowledge(response, segmentCount(buffer.size()));
  }
  if (state_ == State::kAwaitEnd && answer == kEnded) return SdoStep::done();
  return SdoStep::stale();
}

SdoStep BlockDownload::handleAcknowledge(const SdoBytes& response, std::size_t size) noexcept {
  const std::uint8_t in_order = response[1], block_size = response[2];
  if (in_order > sent_) return SdoStep::abort(sdo_abort::kSequenceNumber);
  confirmed_ += in_order;
  sent_ = 0;
  if (confirmed_ == size) {
    state_ = State::kToEnd;
    return SdoStep::accepted();
  }
  if (block_size == 0 || block_size > kMaxSequence) return SdoStep::abort(sdo_abort::kBlockSize);
  block_size_ = block_size;
  repeats_ = in_order == 0 ? repeats_ + 1 : 0;
  if (repeats_ > kSdoBlockRepeats) return SdoStep::abort(sdo_abort::kSequenceNumber);
  state_ = State::kSending;
  return SdoStep::accepted();
}

}  // namespace nord_driver::canopen

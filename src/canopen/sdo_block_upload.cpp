#include "canopen/sdo_block_upload.h"

#include "canopen/sdo_abort.h"
#include "canopen/sdo_commands.h"
#include "canopen/sdo_crc.h"

namespace nord_driver::canopen {

namespace {

constexpr std::uint8_t kStart = kAskBlockUpload | 0x03;
constexpr std::uint8_t kAcknowledge = kAskBlockUpload | 0x02;
constexpr std::uint8_t kConfirmEnd = kAskBlockUpload | 0x01;
constexpr std::uint8_t kEndOfUpload = kBlockUploadAnswer | 0x01;
constexpr std::uint8_t kEndMask = kCommandMask | 0x03;

}  // namespace

bool BlockUpload::pollTransmit(SdoBytes& request, const SdoBuffer& /*buffer*/) noexcept {
  request = {};
  switch (state_) {
    case State::kToStart:
      request[0] = kStart;
      state_ = State::kReceiving;
      return true;
    case State::kToAcknowledge:
      request[0] = kAcknowledge;
      request[1] = in_order_;
      request[2] = kSdoBlockSize;
      in_order_ = 0;
      heard_ = false;
      state_ = complete_ ? State::kEnding : State::kReceiving;
      return true;
    case State::kReceiving:
    case State::kEnding:
      break;
  }
  return false;
}

SdoStep BlockUpload::handle(const SdoBytes& response, SdoBuffer& buffer) noexcept {
  if (state_ == State::kReceiving) return handleSegment(response, buffer);
  if (state_ == State::kEnding) return handleEnd(response, buffer);
  return SdoStep::stale();
}

SdoStep BlockUpload::handleSegment(const SdoBytes& segment, SdoBuffer& buffer) noexcept {
  const auto number = static_cast<std::uint8_t>(segment[0] & 0x7Fu);
  const bool last = (segment[0] & kLastOfAll) != 0;
  if (number == 0 || number > kSdoBlockSize) return SdoStep::stale();
  // The end of the block before once more: repeated on the bus behind our acknowledgement, or all that arrived of the
  // same block a second time. Silence will tell.
  if (in_order_ == 0 && number == last_of_block_ && segment == last_segment_) {
    heard_ = true;
    return SdoStep::stale();
  }
  if (number <= in_order_) return SdoStep::stale();
  silent_ = false;
  heard_ = true;
  if (number == in_order_ + 1) {
    for (std::size_t i = 0; i < kSdoSegmentLength; ++i) {
      if (!buffer.push_back(segment[1 + i])) return SdoStep::abort(sdo_abort::kMemory);
    }
    in_order_ = number;
    complete_ = last;
    repeats_ = 0;
  }
  if (!last && number < kSdoBlockSize) return SdoStep::accepted();
  last_of_block_ = number;
  last_segment_ = segment;
  return acknowledge();
}

bool BlockUpload::handleSilence() noexcept {
  if (state_ == State::kEnding || silent_) return false;
  silent_ = true;
  // Before the first segment the server may only be slow, and an acknowledgement would send it back a block.
  return state_ != State::kReceiving || !heard_ || acknowledge().kind == SdoStep::Kind::kAccepted;
}

SdoBytes BlockUpload::confirmation() noexcept {
  SdoBytes bytes{};
  bytes[0] = kConfirmEnd;
  return bytes;
}

SdoStep BlockUpload::acknowledge() noexcept {
  if (in_order_ == 0 && ++repeats_ > kSdoBlockRepeats) return SdoStep::abort(sdo_abort::kSequenceNumber);
  state_ = State::kToAcknowledge;
  return SdoStep::accepted();
}

SdoStep BlockUpload::handleEnd(const SdoBytes& response, SdoBuffer& buffer) noexcept {
  if ((response[0] & kEndMask) != kEndOfUpload) return SdoStep::stale();
  const std::size_t unused = response[0] >> 2 & 7u;
  if (unused > buffer.size()) return SdoStep::abort(sdo_abort::kLength);
  buffer.resize(buffer.size() - unused);
  if (size_ && buffer.size() != *size_) return SdoStep::abort(sdo_abort::kLength);
  const unsigned sent = response[1] | static_cast<unsigned>(response[2]) << 8;
  if (crc_ && sdoCrc(buffer) != sent) return SdoStep::abort(sdo_abort::kCrc);
  return SdoStep::done();
}

}  // namespace nord_driver::canopen

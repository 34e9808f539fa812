#include "canopen/sdo_segments.h"

#include "canopen/sdo_abort.h"
#include "canopen/sdo_commands.h"

namespace nord_driver::canopen {

namespace {

/// Two answers in a row differ in the toggle bit, so an equal one was repeated on the bus.
bool isRepeated(bool started, const SdoBytes& response, const SdoBytes& last) noexcept {
  return started && response == last;
}

bool toggleOf(const SdoBytes& response) noexcept {
  return (response[0] & kToggle) != 0;
}

}  // namespace

bool SegmentedUpload::pollTransmit(SdoBytes& request, const SdoBuffer& /*buffer*/) noexcept {
  if (!to_send_) return false;
  request = {};
  request[0] = static_cast<std::uint8_t>(kAskSegment | (toggle_ ? kToggle : 0));
  to_send_ = false;
  return true;
}

SdoStep SegmentedUpload::handle(const SdoBytes& response, SdoBuffer& buffer) noexcept {
  if (to_send_ || command(response) != kUploadSegment || isRepeated(started_, response, last_)) return SdoStep::stale();
  if (toggleOf(response) != toggle_) return SdoStep::abort(sdo_abort::kToggleBit);
  const bool last = (response[0] & kLastSegment) != 0;
  const std::size_t count = kSdoSegmentLength - (response[0] >> 1 & 7u);
  // A server that never gets on would hold the channel for ever.
  if (count == 0 && !last) return SdoStep::abort(sdo_abort::kTooShort);
  if (size_ && buffer.size() + count > *size_) return SdoStep::abort(sdo_abort::kTooLong);
  for (std::size_t i = 0; i < count; ++i) {
    if (!buffer.push_back(response[1 + i])) return SdoStep::abort(sdo_abort::kMemory);
  }
  if (last) return !size_ || buffer.size() == *size_ ? SdoStep::done() : SdoStep::abort(sdo_abort::kTooShort);
  last_ = response;
  started_ = true;
  toggle_ = !toggle_;
  to_send_ = true;
  return SdoStep::accepted();
}

bool SegmentedDownload::pollTransmit(SdoBytes& request, const SdoBuffer& buffer) noexcept {
  if (!to_send_) return false;
  const ByteView segment = ByteView{buffer}.sub(confirmed_, kSdoSegmentLength);
  const std::size_t unused = kSdoSegmentLength - segment.size();
  sent_ = confirmed_ + segment.size();
  request = {};
  request[0] =
      static_cast<std::uint8_t>((toggle_ ? kToggle : 0) | unused << 1 | (sent_ == buffer.size() ? kLastSegment : 0));
  for (std::size_t i = 0; i < segment.size(); ++i) request[1 + i] = segment[i];
  to_send_ = false;
  return true;
}

SdoStep SegmentedDownload::handle(const SdoBytes& response, SdoBuffer& buffer) noexcept {
  if (to_send_ || command(response) != kDownloadSegment) return SdoStep::stale();
  if (toggleOf(response) != toggle_) return started_ ? SdoStep::stale() : SdoStep::abort(sdo_abort::kToggleBit);
  confirmed_ = sent_;
  started_ = true;
  if (confirmed_ == buffer.size()) return SdoStep::done();
  toggle_ = !toggle_;
  to_send_ = true;
  return SdoStep::accepted();
}

}  // namespace nord_driver::canopen

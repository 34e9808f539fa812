#include "canopen/sdo_client.h"

#include "canopen/sdo_abort.h"
#include "canopen/sdo_commands.h"

namespace nord_driver::canopen {

bool SdoClient::start(const SdoRequest& request, Instant now) noexcept {
  return start(request, ByteView{request.data}, now);
}

bool SdoClient::start(const SdoRequest& request, ByteView data, Instant now) noexcept {
  if (busy() || data.size() > kSdoCapacity || (request.write && data.empty())) return false;
  request_ = request;
  buffer_.clear();
  if (request.write) {
    for (const std::uint8_t byte : data) buffer_.push_back(byte);
  }
  size_told_ = true;
  known_to_server_ = false;
  phase_ = Phase::kToAsk;
  arm(now);
  return true;
}

// Half of the time for a missing segment, so that there is time left to get it again.
void SdoClient::arm(Instant now) noexcept {
  deadline_ = now + (phase_ == Phase::kBlockUpload && block_upload_.awaitsSegments() ? timeout_ / 2 : timeout_);
}

bool SdoClient::pollTransmit(CanFrame& frame) noexcept {
  SdoBytes bytes{};
  if (closing_frame_) {
    bytes = *closing_frame_;
    closing_frame_.reset();
  } else if (!pollRequest(bytes)) {
    return false;
  }
  frame = dataFrame(channel_.request_id, bytes);
  return true;
}

bool SdoClient::pollRequest(SdoBytes& bytes) noexcept {
  bool sends = false;
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kAsked:
      break;
    case Phase::kToAsk:
      bytes = initiation(request_, ByteView{buffer_});
      phase_ = Phase::kAsked;
      sends = true;
      break;
    case Phase::kSegmentedUpload:
      sends = segmented_upload_.pollTransmit(bytes, buffer_);
      break;
    case Phase::kSegmentedDownload:
      sends = segmented_download_.pollTransmit(bytes, buffer_);
      break;
    case Phase::kBlockUpload:
      sends = block_upload_.pollTransmit(bytes, buffer_);
      break;
    case Phase::kBlockDownload:
      sends = block_download_.pollTransmit(bytes, buffer_);
      break;
  }
  known_to_server_ = known_to_server_ || sends;
  return sends;
}

void SdoClient::handle(const CanFrame& frame, Instant now) noexcept {
  if (frame.id != channel_.response_id || frame.extended || frame.remote) return;
  if (frame.size != kCanDataLength) {
    ++counters_.malformed;
  } else if (!awaitsAnswer()) {
    ++counters_.stale;
  } else if (frame.data[0] == kAbort) {
    handleAbort(frame.data, now);
  } else {
    apply(handleResponse(frame.data), now);
  }
}

SdoStep SdoClient::handleResponse(const SdoBytes& response) noexcept {
  switch (phase_) {
    case Phase::kSegmentedUpload:
      return segmented_upload_.handle(response, buffer_);
    case Phase::kSegmentedDownload:
      return segmented_download_.handle(response, buffer_);
    case Phase::kBlockUpload: {
      const SdoStep step = block_upload_.handle(response, buffer_);
      if (step.kind == SdoStep::Kind::kDone) closing_frame_ = BlockUpload::confirmation();
      return step;
    }
    case Phase::kBlockDownload:
      return block_download_.handle(response, buffer_);
    case Phase::kAsked:
      return handleInitiated(response);
    case Phase::kIdle:
    case Phase::kToAsk:
      break;
  }
  return SdoStep::stale();
}

SdoStep SdoClient::handleInitiated(const SdoBytes& response) noexcept {
  if (!namesObject(response, request_)) return SdoStep::stale();
  return request_.write ? beginDownload(response) : beginUpload(response);
}

// A server may answer a block request with a segmented transfer (CiA 301 7.2.4.3.13, protocol switch).
SdoStep SdoClient::beginUpload(const SdoBytes& response) noexcept {
  const Initiated initiated = readInitiated(response);
  size_told_ = initiated.size.has_value();
  if (initiated.kind == Initiated::Kind::kExpedited) {
    for (std::size_t i = 0; i < initiated.count; ++i) buffer_.push_back(response[4 + i]);
    return SdoStep::done();
  }
  const bool plain = initiated.kind == Initiated::Kind::kSegmentedUpload;
  if (!plain && !(request_.block && initiated.kind == Initiated::Kind::kBlockUpload)) return SdoStep::stale();
  if (initiated.size && *initiated.size > kSdoCapacity) return SdoStep::abort(sdo_abort::kMemory);
  if (plain) {
    segmented_upload_ = SegmentedUpload{initiated.size};
    phase_ = Phase::kSegmentedUpload;
  } else {
    block_upload_ = BlockUpload{initiated.size, initiated.crc};
    phase_ = Phase::kBlockUpload;
  }
  return SdoStep::accepted();
}

SdoStep SdoClient::beginDownload(const SdoBytes& response) noexcept {
  const Initiated initiated = readInitiated(response);
  if (request_.block) {
    if (initiated.kind != Initiated::Kind::kBlockDownload) return SdoStep::stale();
    if (initiated.block_size == 0 || initiated.block_size > kMaxSequence) return SdoStep::abort(sdo_abort::kBlockSize);
    block_download_ = BlockDownload{initiated.block_size, initiated.crc};
    phase_ = Phase::kBlockDownload;
    segments_seen_ = 0;
    return SdoStep::accepted();
  }
  if (initiated.kind != Initiated::Kind::kDownload) return SdoStep::stale();
  if (buffer_.size() <= kExpeditedLength) return SdoStep::done();
  segmented_download_ = SegmentedDownload{};
  phase_ = Phase::kSegmentedDownload;
  return SdoStep::accepted();
}

void SdoClient::handleAbort(const SdoBytes& response, Instant now) noexcept {
  if (!namesObject(response, request_)) {
    ++counters_.stale;
    return;
  }
  const std::uint32_t code = u32(response);
  if (request_.block && code == sdo_abort::kCommand && phase_ == Phase::kAsked) {
    request_.block = false;
    phase_ = Phase::kToAsk;
    arm(now);
    return;
  }
  finish(SdoEnd::kAbortedByServer, code);
}

void SdoClient::apply(SdoStep step, Instant now) noexcept {
  switch (step.kind) {
    case SdoStep::Kind::kStale:
      ++counters_.stale;
      break;
    case SdoStep::Kind::kAccepted:
      arm(now);
      break;
    case SdoStep::Kind::kDone:
      finish(SdoEnd::kDone, 0);
      break;
    case SdoStep::Kind::kAbort:
      abort(SdoEnd::kAbortedByUs, step.abort_code);
      break;
  }
}

void SdoClient::poll(Instant now) noexcept {
  if (!active() || now < deadline_) return;
  if (goesOnWithoutAnswer()) {
    arm(now);
  } else {
    abort(SdoEnd::kTimedOut, sdo_abort::kTimedOut);
  }
}

bool SdoClient::goesOnWithoutAnswer() noexcept {
  if (phase_ == Phase::kBlockUpload) return block_upload_.handleSilence();
  if (phase_ != Phase::kBlockDownload || block_download_.segmentsSent() == segments_seen_) return false;
  segments_seen_ = block_download_.segmentsSent();
  return true;
}

void SdoClient::cancel() noexcept {
  if (active()) abort(SdoEnd::kAbortedByUs, sdo_abort::kGeneral);
  answer_.reset();
}

void SdoClient::abort(SdoEnd end, std::uint32_t code) noexcept {
  if (known_to_server_) {
    closing_frame_ = objectFrame(kAbort, request_);
    putU32(*closing_frame_, code);
  }
  finish(end, code);
}

void SdoClient::finish(SdoEnd end, std::uint32_t code) noexcept {
  phase_ = Phase::kIdle;
  SdoAnswer answer;
  answer.id = request_.id;
  answer.end = end;
  answer.abort_code = code;
  answer.size_told = size_told_;
  answer_ = answer;
  switch (end) {
    case SdoEnd::kDone:
      ++counters_.done;
      break;
    case SdoEnd::kAbortedByServer:
      ++counters_.aborted_by_server;
      break;
    case SdoEnd::kAbortedByUs:
      ++counters_.aborted_by_us;
      break;
    case SdoEnd::kTimedOut:
      ++counters_.timed_out;
      break;
  }
}

std::optional<SdoAnswer> SdoClient::takeAnswer() noexcept {
  std::optional<SdoAnswer> answer = answer_;
  if (answer && answer->ok() && !request_.write) answer->data = ByteView{buffer_};
  answer_.reset();
  return answer;
}

}  // namespace nord_driver::canopen

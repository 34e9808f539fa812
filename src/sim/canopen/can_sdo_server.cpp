#include "sim/canopen/can_sdo_server.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

// Client command specifiers, bits 5-7 of the first byte.
constexpr unsigned kDownloadSegment = 0;
constexpr unsigned kInitiateDownload = 1;
constexpr unsigned kInitiateUpload = 2;
constexpr unsigned kUploadSegment = 3;
constexpr unsigned kAbort = 4;

constexpr unsigned kToggleBit = 0x10;
constexpr unsigned kSized = 0x01;
constexpr unsigned kExpedited = 0x02;
constexpr unsigned kLastSegment = 0x01;

ByteView dataOf(const SdoBytes& frame) noexcept {
  return ByteView{frame}.sub(4);
}

}  // namespace

std::optional<SdoBytes> CanSdoServer::handle(const SdoBytes& request, CanObjects& objects) noexcept {
  switch (request[0] >> 5) {
    case kInitiateDownload:
      name(request);
      return initiateDownload(request, objects);
    case kDownloadSegment:
      return downloadSegment(request, objects);
    case kInitiateUpload:
      name(request);
      return initiateUpload(objects);
    case kUploadSegment:
      return uploadSegment(request);
    case kAbort:
      reset();
      return std::nullopt;
    default:  // block transfers among them
      name(request);
      return abort(SdoAbort::kCommand);
  }
}

void CanSdoServer::name(const SdoBytes& request) noexcept {
  reset();
  id_.index = static_cast<std::uint16_t>(request[1] | request[2] << 8);
  id_.sub = request[3];
}

SdoBytes CanSdoServer::head(unsigned command) const noexcept {
  return {static_cast<std::uint8_t>(command),
          static_cast<std::uint8_t>(id_.index & 0xFFu),
          static_cast<std::uint8_t>(id_.index >> 8),
          id_.sub,
          0,
          0,
          0,
          0};
}

SdoBytes CanSdoServer::abort(SdoAbort code) noexcept {
  reset();
  SdoBytes answer = head(0x80);
  const ObjectBytes number = objectBytes(static_cast<std::uint32_t>(code), 4);
  std::copy(number.begin(), number.end(), answer.begin() + 4);
  return answer;
}

SdoBytes CanSdoServer::initiateDownload(const SdoBytes& request, CanObjects& objects) noexcept {
  const bool sized = (request[0] & kSized) != 0;
  if ((request[0] & kExpedited) == 0) {
    expected_ = sized ? objectNumber(dataOf(request)) : 0;
    if (expected_ > ObjectBytes::capacity()) return abort(SdoAbort::kMemory);
    transfer_ = Transfer::kDownload;
    toggle_ = false;
    buffer_.clear();
    return head(0x60);
  }
  std::size_t length = 4u - (request[0] >> 2 & 0x03u);
  if (!sized) {  // as many as the object has
    ObjectBytes now;
    length = objects.read(id_, now) == SdoAbort::kNone ? std::min<std::size_t>(now.size(), 4) : 4;
  }
  const SdoAbort refusal = objects.write(id_, dataOf(request).sub(0, length));
  return refusal == SdoAbort::kNone ? head(0x60) : abort(refusal);
}

SdoBytes CanSdoServer::downloadSegment(const SdoBytes& request, CanObjects& objects) noexcept {
  if (transfer_ != Transfer::kDownload) return abort(SdoAbort::kCommand);
  if (((request[0] & kToggleBit) != 0) != toggle_) return abort(SdoAbort::kToggle);
  const std::size_t length = 7u - (request[0] >> 1 & 0x07u);
  for (std::size_t i = 0; i < length; ++i) {
    if (!buffer_.push_back(request[1 + i])) return abort(SdoAbort::kMemory);
  }
  SdoBytes answer{static_cast<std::uint8_t>(0x20u | (toggle_ ? kToggleBit : 0u)), 0, 0, 0, 0, 0, 0, 0};
  toggle_ = !toggle_;
  if ((request[0] & kLastSegment) == 0) return answer;
  transfer_ = Transfer::kNone;
  if (expected_ != 0 && buffer_.size() != expected_) return abort(SdoAbort::kTypeOrLength);
  const SdoAbort refusal = objects.write(id_, buffer_);
  return refusal == SdoAbort::kNone ? answer : abort(refusal);
}

SdoBytes CanSdoServer::initiateUpload(CanObjects& objects) noexcept {
  buffer_.clear();
  const SdoAbort refusal = objects.read(id_, buffer_);
  if (refusal != SdoAbort::kNone) return abort(refusal);
  if (buffer_.size() <= 4) {  // 4Fh, 4Bh, 47h, 43h: one to four bytes
    SdoBytes answer = head(0x40u | static_cast<unsigned>(4 - buffer_.size()) << 2 | kExpedited | kSized);
    std::copy(buffer_.begin(), buffer_.end(), answer.begin() + 4);
    return answer;
  }
  transfer_ = Transfer::kUpload;
  toggle_ = false;
  position_ = 0;
  SdoBytes answer = head(0x40u | kSized);
  const ObjectBytes size = objectBytes(static_cast<std::uint32_t>(buffer_.size()), 4);
  std::copy(size.begin(), size.end(), answer.begin() + 4);
  return answer;
}

SdoBytes CanSdoServer::uploadSegment(const SdoBytes& request) noexcept {
  if (transfer_ != Transfer::kUpload) return abort(SdoAbort::kCommand);
  if (((request[0] & kToggleBit) != 0) != toggle_) return abort(SdoAbort::kToggle);
  const std::size_t length = std::min<std::size_t>(buffer_.size() - position_, 7);
  SdoBytes answer{};
  std::copy_n(buffer_.begin() + position_, length, answer.begin() + 1);
  position_ += length;
  const bool last = position_ == buffer_.size();
  answer[0] = static_cast<std::uint8_t>((toggle_ ? kToggleBit : 0u) | static_cast<unsigned>(7 - length) << 1 |
                                        (last ? kLastSegment : 0u));
  toggle_ = !toggle_;
  if (last) transfer_ = Transfer::kNone;
  return answer;
}

}  // namespace nord_driver::sim

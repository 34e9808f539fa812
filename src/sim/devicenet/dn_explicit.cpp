#include "sim/devicenet/dn_explicit.h"

#include <algorithm>

namespace nord_driver::sim {

namespace {

constexpr std::size_t kInFragment = 6;
constexpr std::size_t kInOneFrame = 7;
constexpr std::uint8_t kGood = 0;
constexpr std::uint8_t kTooMuch = 1;

}  // namespace

DnExplicitReceiver::Heard DnExplicitReceiver::receive(ByteView data) noexcept {
  if (data.size() < 2) return {};
  if ((data[0] & dn::kFragmented) != 0) return fragment(data);
  collecting_ = false;
  request_.header = data[0];
  request_.body.clear();
  for (const std::uint8_t byte : data.sub(1)) request_.body.push_back(byte);
  Heard heard;
  heard.complete = true;
  return heard;
}

// A fragment that comes again was acknowledged in vain: it is acknowledged again and not stored twice.
DnExplicitReceiver::Heard DnExplicitReceiver::fragment(ByteView data) noexcept {
  Heard heard;
  const dn::Fragment kind = dn::kindOf(data[1]);
  const std::uint8_t count = data[1] & dn::kFragmentCount;
  if (kind == dn::Fragment::kAcknowledgement) {
    heard.acknowledged = data.size() >= 3 && data[2] == kGood;
    heard.count = count;
    return heard;
  }
  const auto acknowledge = [&](std::uint8_t status) {
    heard.acknowledge = DnFrameData{data[0], static_cast<std::uint8_t>(0xC0u | count), status};
  };
  if (kind == dn::Fragment::kFirst) {
    if (count != 0) return heard;
    request_.header = data[0] & static_cast<std::uint8_t>(~unsigned{dn::kFragmented});
    request_.body.clear();
    collecting_ = true;
    count_ = 0;
  } else if (collecting_ && count == count_) {
    acknowledge(kGood);
    return heard;
  } else if (!collecting_ || count != ((count_ + 1u) & dn::kFragmentCount)) {
    if (!collecting_ && count == count_ && kind == dn::Fragment::kLast) acknowledge(kGood);
    collecting_ = false;
    return heard;
  }
  count_ = count;
  for (const std::uint8_t byte : data.sub(2)) {
    if (request_.body.push_back(byte)) continue;
    collecting_ = false;
    acknowledge(kTooMuch);
    return heard;
  }
  acknowledge(kGood);
  if (kind == dn::Fragment::kLast) {
    collecting_ = false;
    heard.complete = true;
  }
  return heard;
}

DnFrameData DnExplicitSender::begin(std::uint8_t header, const CipBytes& body) noexcept {
  header_ = header;
  body_ = body;
  offset_ = 0;
  count_ = 0;
  repeated_ = false;
  waited_ = Duration::zero();
  busy_ = body.size() > kInOneFrame;
  return frame();
}

DnFrameData DnExplicitSender::frame() const noexcept {
  DnFrameData data;
  if (body_.size() <= kInOneFrame) {
    data.push_back(header_);
    for (const std::uint8_t byte : body_) data.push_back(byte);
    return data;
  }
  const bool last = offset_ + kInFragment >= body_.size();
  const dn::Fragment kind = offset_ == 0 ? dn::Fragment::kFirst : last ? dn::Fragment::kLast : dn::Fragment::kMiddle;
  data.push_back(header_ | dn::kFragmented);
  data.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(kind) | count_));
  for (const std::uint8_t byte : ByteView{body_}.sub(offset_, kInFragment)) data.push_back(byte);
  return data;
}

std::optional<DnFrameData> DnExplicitSender::acknowledged(std::uint8_t count) noexcept {
  if (!busy_ || count != count_) return std::nullopt;
  offset_ += kInFragment;
  count_ = (count_ + 1u) & dn::kFragmentCount;
  repeated_ = false;
  waited_ = Duration::zero();
  if (offset_ < body_.size()) return frame();
  busy_ = false;
  return std::nullopt;
}

DnExplicitSender::Waited DnExplicitSender::advance(Duration span) noexcept {
  Waited waited;
  if (!busy_) return waited;
  waited_ += span;
  if (waited_ < kAcknowledgeTime) return waited;
  waited_ = Duration::zero();
  waited.missed = true;
  if (repeated_) {
    busy_ = false;
    return waited;
  }
  repeated_ = true;
  waited.again = frame();
  return waited;
}

}  // namespace nord_driver::sim

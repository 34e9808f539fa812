#include "sim/devicenet/dn_io_message.h"

namespace nord_driver::sim {

namespace {

constexpr std::size_t kInFrame = 8;
constexpr std::size_t kInFragment = 7;

}  // namespace

// A gap in the count drops the whole message.
std::optional<DnProcessBytes> DnIoReceiver::receive(ByteView data, std::size_t size) noexcept {
  if (size <= kInFrame) {
    DnProcessBytes whole;
    for (const std::uint8_t byte : data) whole.push_back(byte);
    return whole;
  }
  if (data.empty()) {  // the scanner is idle
    collecting_ = false;
    return DnProcessBytes{};
  }
  const dn::Fragment kind = dn::kindOf(data[0]);
  const std::uint8_t count = data[0] & dn::kFragmentCount;
  const bool only = kind == dn::Fragment::kFirst && count == dn::kOnlyFragment;
  if (kind == dn::Fragment::kFirst && (count == 0 || only)) {
    bytes_.clear();
    collecting_ = true;
  } else if (kind == dn::Fragment::kAcknowledgement || kind == dn::Fragment::kFirst || !collecting_ ||
             count != ((count_ + 1u) & dn::kFragmentCount)) {
    collecting_ = false;
    return std::nullopt;
  }
  count_ = count;
  for (const std::uint8_t byte : data.sub(1)) {
    if (bytes_.push_back(byte)) continue;
    collecting_ = false;
    return std::nullopt;
  }
  if (kind != dn::Fragment::kLast && !only) return std::nullopt;
  collecting_ = false;
  return bytes_;
}

std::optional<FixedBytes<8>> DnIoSender::next() noexcept {
  if (done_) return std::nullopt;
  FixedBytes<8> frame;
  if (!fragmented_) {
    done_ = true;
    for (const std::uint8_t byte : message_) frame.push_back(byte);
    return frame;
  }
  const bool last = offset_ + kInFragment >= message_.size();
  const dn::Fragment kind = offset_ == 0 ? dn::Fragment::kFirst : last ? dn::Fragment::kLast : dn::Fragment::kMiddle;
  frame.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(kind) | count_));
  for (const std::uint8_t byte : message_.sub(offset_, kInFragment)) frame.push_back(byte);
  offset_ += kInFragment;
  count_ = (count_ + 1u) & dn::kFragmentCount;
  done_ = last;
  return frame;
}

}  // namespace nord_driver::sim

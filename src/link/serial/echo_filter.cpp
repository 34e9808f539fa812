#include "link/serial/echo_filter.h"

#include <algorithm>

namespace nord_driver::link {

void EchoFilter::reset(EchoMode mode) noexcept {
  mode_ = mode;
  strangers_ = 0;
  discard();
}

void EchoFilter::discard() noexcept {
  expected_.clear();
  matched_ = 0;
  ready_.clear();
  taken_ = 0;
}

void EchoFilter::sent(ByteView telegram) noexcept {
  if (mode_ == EchoMode::kOff) return;
  if (expects()) {
    if (mode_ == EchoMode::kOn) ++collisions_;
    giveBack();
  }
  expected_.clear();
  matched_ = 0;
  if (telegram.size() > expected_.capacity()) return;  // no telegram
  for (const std::uint8_t byte : telegram) expected_.push_back(byte);
}

void EchoFilter::heard(ByteView bytes) noexcept {
  if (taken_ == ready_.size()) {
    ready_.clear();
    taken_ = 0;
  }
  std::size_t at = 0;
  while (at < bytes.size() && expects() && bytes[at] == expected_[matched_]) {
    ++at;
    ++matched_;
  }
  if (at > 0 && !expects() && mode_ == EchoMode::kAuto) mode_ = EchoMode::kOn;
  if (at < bytes.size() && expects()) {
    if (mode_ == EchoMode::kOn) ++collisions_;
    if (mode_ == EchoMode::kAuto && ++strangers_ == kStrangersToBeOff) mode_ = EchoMode::kOff;
    giveBack();
  }
  for (; at < bytes.size(); ++at) ready_.push_back(bytes[at]);
}

void EchoFilter::giveBack() noexcept {
  for (std::size_t i = 0; i < matched_; ++i) ready_.push_back(expected_[i]);
  expected_.clear();
  matched_ = 0;
}

std::size_t EchoFilter::take(std::uint8_t* buffer, std::size_t capacity) noexcept {
  const std::size_t count = std::min(capacity, ready_.size() - taken_);
  std::copy_n(ready_.data() + taken_, count, buffer);
  taken_ += count;
  return count;
}

}  // namespace nord_driver::link

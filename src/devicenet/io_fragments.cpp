#include "devicenet/io_fragments.h"

#include <algorithm>

namespace nord_driver::devicenet {
namespace {

constexpr std::size_t kPerFragment = 7;

template <std::size_t N>
bool appendAll(FixedBytes<N>& to, ByteView from) noexcept {
  bool fits = true;
  for (const std::uint8_t byte : from) fits = to.push_back(byte) && fits;
  return fits;
}

}  // namespace

std::size_t ioFrames(std::size_t bytes, std::size_t connection_size) noexcept {
  if (connection_size <= kUnfragmented) return 1;
  return std::max<std::size_t>(1, (bytes + kPerFragment - 1) / kPerFragment);
}

void IoSender::start(ByteView message) noexcept {
  message_.clear();
  appendAll(message_, message);
  sent_ = 0;
  count_ = 0;
  pending_ = true;
}

bool IoSender::next(FramePayload& payload) noexcept {
  if (!pending_) return false;
  payload.clear();
  const ByteView rest = ByteView{message_}.sub(sent_);
  if (!fragmented_) {
    appendAll(payload, rest);
    pending_ = false;
    return true;
  }
  const ByteView part = rest.sub(0, kPerFragment);
  const bool first = sent_ == 0;
  const bool last = part.size() == rest.size();
  Fragment fragment{first ? FragmentType::kFirst : FragmentType::kMiddle, count_};
  if (last) fragment = first ? Fragment{FragmentType::kFirst, kOnlyFragment} : Fragment{FragmentType::kLast, count_};
  payload.push_back(fragment.byte());
  appendAll(payload, part);
  sent_ += part.size();
  count_ = fragment.nextCount();
  pending_ = !last;
  return true;
}

IoReceiver::Result IoReceiver::handle(ByteView payload) noexcept {
  if (!fragmented_) {
    message_.clear();
    return append(payload) == Result::kBroken ? Result::kBroken : Result::kComplete;
  }
  if (payload.empty()) {
    // A message of no bytes has nothing to be counted (BU 0280 4.1.3: data length 0).
    reset();
    message_.clear();
    return Result::kComplete;
  }
  const Fragment fragment = Fragment::from(payload[0]);
  if (fragment.type == FragmentType::kFirst) {
    message_.clear();
    const bool only = fragment.count == kOnlyFragment;
    assembling_ = !only;
    expected_ = 1;
    if (fragment.count != 0 && !only) {
      reset();
      return Result::kBroken;
    }
    const Result result = append(payload.sub(1));
    return result == Result::kNeedMore && only ? Result::kComplete : result;
  }
  if (fragment.type == FragmentType::kAcknowledge || !assembling_ || fragment.count != expected_) {
    reset();
    return Result::kBroken;
  }
  expected_ = fragment.nextCount();
  const Result result = append(payload.sub(1));
  if (fragment.type != FragmentType::kLast || result == Result::kBroken) return result;
  reset();
  return Result::kComplete;
}

IoReceiver::Result IoReceiver::append(ByteView data) noexcept {
  if (message_.size() + data.size() > size_ || !appendAll(message_, data)) {
    reset();
    return Result::kBroken;
  }
  return Result::kNeedMore;
}

}  // namespace nord_driver::devicenet

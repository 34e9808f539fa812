#include "devicenet/explicit_receiver.h"

namespace nord_driver::devicenet {

ExplicitReceiver::Result ExplicitReceiver::handle(bool xid, Fragment fragment, ByteView data, bool expected) noexcept {
  const bool first = fragment.type == FragmentType::kFirst;
  // A first fragment that comes again has nothing behind it yet: it is the same as the beginning of a message.
  if (last_ && last_->xid == xid && last_->byte == fragment.byte() && !(first && !assembling_)) {
    return Result::kRepeated;
  }
  if (!expected) return Result::kStray;
  if (first) {
    if (fragment.count != 0) return Result::kStray;
    body_.clear();
    assembling_ = true;
  } else if (!assembling_ || fragment.count != next_count_) {
    return Result::kStray;
  }
  for (const std::uint8_t byte : data) {
    if (body_.push_back(byte)) continue;
    assembling_ = false;
    last_.reset();
    return Result::kTooLong;
  }
  last_ = Accepted{xid, fragment.byte()};
  next_count_ = fragment.nextCount();
  if (fragment.type != FragmentType::kLast) return Result::kAccepted;
  assembling_ = false;
  return Result::kComplete;
}

}  // namespace nord_driver::devicenet

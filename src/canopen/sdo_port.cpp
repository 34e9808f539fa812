#include "canopen/sdo_port.h"

namespace nord_driver::canopen {

bool SdoPort::submit(SdoOwner owner, const SdoRequest& request, Instant now) noexcept {
  if (owner_ == owner || waiting(owner)) return false;
  if (request.write && request.data.empty()) return false;
  waiting(owner) = request;
  startNext(now);
  return true;
}

std::optional<SdoAnswer> SdoPort::take(SdoOwner owner) noexcept {
  if (owner_ != owner) return std::nullopt;
  const std::optional<SdoAnswer> answer = client_.takeAnswer();
  if (answer) {
    last_ = owner_;
    owner_ = SdoOwner::kNobody;
  }
  return answer;
}

void SdoPort::cancel(SdoOwner owner, Instant now) noexcept {
  waiting(owner).reset();
  if (owner_ != owner) return;
  client_.cancel();
  put_back_.reset();
  owner_ = SdoOwner::kNobody;
  startNext(now);
}

void SdoPort::handle(const CanFrame& frame, Instant now) noexcept {
  client_.handle(frame, now);
}

void SdoPort::poll(Instant now) noexcept {
  const std::uint64_t timed_out = client_.counters().timed_out;
  client_.poll(now);
  // A request that waited for the link until it was given up must not reach the server any more.
  if (client_.counters().timed_out != timed_out) put_back_.reset();
  startNext(now);
}

bool SdoPort::pollTransmit(CanFrame& frame) noexcept {
  if (!put_back_) return client_.pollTransmit(frame);
  frame = *put_back_;
  put_back_.reset();
  return true;
}

std::optional<Instant> SdoPort::nextDeadline() const noexcept {
  const bool waiting = boot_.has_value() || user_.has_value();
  // The answer of the one that was taken is still looked at: the other begins with the next `poll()`.
  if (owner_ == SdoOwner::kNobody && waiting) return Instant{};
  return client_.nextDeadline();
}

void SdoPort::startNext(Instant now) noexcept {
  if (owner_ != SdoOwner::kNobody) return;
  const SdoOwner other = last_ == SdoOwner::kUser ? SdoOwner::kBoot : SdoOwner::kUser;
  if (!start(other, now)) start(last_, now);
}

bool SdoPort::start(SdoOwner owner, Instant now) noexcept {
  std::optional<SdoRequest>& request = waiting(owner);
  if (!request || !client_.start(*request, now)) return false;
  request.reset();
  owner_ = owner;
  return true;
}

}  // namespace nord_driver::canopen

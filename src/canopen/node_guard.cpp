#include "canopen/node_guard.h"

#include <algorithm>

#include "canopen/nmt.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint8_t kToggle = 0x80;

}  // namespace

NodeGuard::NodeGuard(std::uint8_t node, Duration guard_time, std::uint8_t life_time_factor, NodeTimers& timers) noexcept
    : node_(node), guard_time_(guard_time), life_time_(guard_time * life_time_factor), timers_(timers) {}

void NodeGuard::start(bool fresh, Instant now) noexcept {
  timers_.set(NodeTimer::kGuardQuestion, now + guard_time_ / 2);
  half_ = true;
  timers_.set(NodeTimer::kGuardLife, now + life_time_);
  over_ = false;
  due_ = true;
  open_ = false;
  surplus_ = false;
  doubled_ = 0;
  expected_toggle_.reset();
  if (fresh) expected_toggle_ = std::uint8_t{0};
}

void NodeGuard::stop() noexcept {
  timers_.stop(NodeTimer::kGuardQuestion);
  timers_.stop(NodeTimer::kGuardLife);
  over_ = false;
  due_ = false;
  open_ = false;
}

GuardAnswer NodeGuard::handle(std::uint8_t value, Instant now) noexcept {
  if (!open_) {
    expected_toggle_.reset();  // the node has toggled in an answer that was not for us
    surplus_ = true;
    return GuardAnswer::kNotAsked;
  }
  open_ = false;
  const std::uint8_t toggle = value & kToggle;
  if (expected_toggle_ && *expected_toggle_ != toggle) return GuardAnswer::kWrongToggle;
  expected_toggle_ = static_cast<std::uint8_t>(toggle ^ kToggle);
  timers_.set(NodeTimer::kGuardLife, now + life_time_);
  over_ = false;
  return GuardAnswer::kAccepted;
}

bool NodeGuard::poll(Instant now) noexcept {
  if (timers_.isOver(NodeTimer::kGuardLife, now)) {
    timers_.stop(NodeTimer::kGuardLife);
    over_ = true;
  }
  if (!timers_.isOver(NodeTimer::kGuardQuestion, now)) return false;
  // A late look asks once, not once for each time that was missed.
  const Instant next = *timers_.at(NodeTimer::kGuardQuestion) + guard_time_ / 2;
  timers_.set(NodeTimer::kGuardQuestion, std::max(next, now + guard_time_ / 4));
  const bool missed = open_;
  if (half_ && !missed) {
    half_ = false;
    return false;
  }
  half_ = true;
  // The node may have toggled in an answer that did not reach us: the next one sets the bit anew.
  if (missed) expected_toggle_.reset();
  open_ = false;
  due_ = true;
  return missed;
}

bool NodeGuard::pollTransmit(CanFrame& frame) noexcept {
  if (!due_) return false;
  due_ = false;
  open_ = true;
  doubled_ = surplus_ ? std::min<std::uint8_t>(doubled_ + 1u, kOfTwoNodes) : 0;
  surplus_ = false;
  frame = remoteFrame(kErrorControlBase + node_, 1);
  return true;
}

}  // namespace nord_driver::canopen
